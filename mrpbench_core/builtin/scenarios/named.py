"""Starts and goals given by the names of places."""

import attrs
import numpy as np

from mrpbench_core.api.component import option
from mrpbench_core.api.scenario import ScenarioSource
from mrpbench_core.builtin.scenarios.names import Names
from mrpbench_core.builtin.scenarios.places import places_of_world
from mrpbench_core.files.errors import InputError
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
    """Indices of the vertices with the `wanted` names."""
    names = Names(world)
    try:
        return np.array([names.find(name) for name in wanted], np.int64)
    except InputError as error:
        raise InputError(f"scenario.{option_name}: {error.message}", hint=error.hint) from None
