"""Starts and goals given by the names of places."""

from collections import defaultdict

import attrs
import numpy as np

from mrpbench_core.api.component import option
from mrpbench_core.api.scenario import ScenarioSource
from mrpbench_core.builtin.scenarios.places import places_of_world
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class Named(ScenarioSource):
    """Robots start and end at named vertices of the world's navigation graph."""

    starts: tuple[str, ...] = option(help="name of each robot's start, in order", validator=attrs.validators.min_len(1))
    goals: tuple[str, ...] = option(
        help="name of each task's goal; the assigner `identity` gives goal i to robot i",
        validator=attrs.validators.min_len(1),
    )

    def size(self) -> int:
        """Return the number of starts."""
        return len(self.starts)

    def draw(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> Scenario:  # noqa: ARG002
        """Return the scenario, which is the same for every seed."""
        return places_of_world(world).scenario(_find(world, "starts", self.starts), _find(world, "goals", self.goals))


def _find(world: World, option_name: str, wanted: tuple[str, ...]) -> Int:
    """Indices of the vertices with the `wanted` names.

    Several vertices may share a name only if they share a position: one place in several navigation graphs.
    """
    indices: dict[str, list[int]] = defaultdict(list)
    for index, vertex in enumerate(world.vertices):
        indices[vertex.name].append(index)
    indices.pop("", None)
    if not indices:
        raise InputError(f"scenario.{option_name}: world {world.name} has no named vertices")
    found = []
    for name in wanted:
        if name not in indices:
            hint = did_you_mean(name, indices, f"names are {_listed(list(indices))}")
            raise InputError(f"scenario.{option_name}: world {world.name} has no vertex {name!r}", hint=hint)
        where = {(world.vertices[i].x, world.vertices[i].y, world.vertices[i].level) for i in indices[name]}
        if len(where) > 1:
            listed = _listed([f"({x:.2f}, {y:.2f}) on level {level}" for x, y, level in sorted(where)])
            raise InputError(f"scenario.{option_name}: {name!r} names {len(where)} places: {listed}")
        found.append(indices[name][0])
    return np.array(found, np.int64)


def _listed(words: list[str]) -> str:
    return ", ".join(words[:10]) + (f" and {len(words) - 10} more" if len(words) > 10 else "")
