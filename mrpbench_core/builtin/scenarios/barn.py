"""The task of the BARN and DynaBARN challenges."""

import math

import attrs

from mrpbench_core.api.scenario import ScenarioSource
from mrpbench_core.builtin.scenarios.named import Named
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class BarnTask(ScenarioSource):
    """One robot drives from the place `start` of a BARN world to the place `goal`.

    At the start it faces north, or as the parameter `yaw` of the place says.
    """

    def size(self) -> int:
        """Return one robot."""
        return 1

    def draw(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> Scenario:
        """Return the scenario, which is the same for every seed."""
        scenario = Named(starts=("start",), goals=("goal",)).draw(world, roadmap, fleet, seed)
        start = scenario.start.copy()
        place = next(vertex for vertex in world.vertices if vertex.name == "start")
        start[:, 2] = place.parameters.get("yaw", math.pi / 2)
        return attrs.evolve(scenario, start=start)
