"""The built-in office and a roadmap on it, for what needs a real map."""

import functools

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.builtin.worlds.shipped import Office
from mrpbench_core.model.roadmap import Roadmap
from mrpbench_core.model.world import World
from mrpbench_core.testing.room import fleet


@functools.cache
def office() -> World:
    """Ten rooms and a corridor."""
    return Office().load()


@functools.cache
def office_roadmap() -> Roadmap:
    """Its navigation graph."""
    return Graph().build(office(), fleet(1))
