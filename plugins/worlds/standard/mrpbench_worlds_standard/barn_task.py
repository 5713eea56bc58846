"""The task of the BARN and DynaBARN challenges."""

import math

import attrs
import numpy as np

from mrpbench_core.api.scenario import ScenarioSource
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.model.worlds.world import Vertex, World


@attrs.frozen(kw_only=True)
class BarnTask(ScenarioSource):
    """One robot drives from the place `start` of a BARN world to the place `goal`.

    At the start it faces north, or as the parameter `yaw` of the place says.
    """

    def size(self) -> int:
        """Return one robot."""
        return 1

    def draw(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> Scenario:  # noqa: ARG002
        """Return the scenario, which is the same for every seed."""
        start, goal = _place(world, "start"), _place(world, "goal")
        yaw = start.parameters.get("yaw", math.pi / 2)
        goals, level = np.array([(goal.x, goal.y, np.nan)]), np.array([goal.level], np.int16)
        return Scenario(
            start=np.array([(start.x, start.y, yaw)]),
            start_level=np.array([start.level], np.int16),
            start_names=("start",),
            tasks=(Task(goals=goals, levels=level, name="goal"),),
        )


def _place(world: World, name: str) -> Vertex:
    for vertex in world.vertices:
        if vertex.name == name:
            return vertex
    raise InputError(f"scenario: world {world.name} has no place {name!r}", hint="worlds of BARN have it")
