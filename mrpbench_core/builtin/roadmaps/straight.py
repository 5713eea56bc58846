"""The roadmap `straight`: every place of the world is joined with every other by a straight line."""

from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api.roadmap import RoadmapBuilder
from mrpbench_core.builtin.roadmaps.motion import driving_ticks
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.world import World

_TICK = 0.5
"""seconds."""


@attrs.frozen(kw_only=True)
class Straight(RoadmapBuilder):
    """Edges are straight lines between the places of a level, through everything that is in the way.

    A plan on it says only where a robot has to go. It is for the study of navigation alone: the way is left to the
    controller, above all to `global_planner`.
    """

    clears_walls: ClassVar[bool] = False

    def build(self, world: World, fleet: Fleet) -> Roadmap:
        """Join the places of each level, from each to each.

        Raises:
            InputError: the world has no places.
        """
        if not world.vertices:
            raise InputError(f"world {world.name!r} has no places", hint="try roadmap: grid")
        position = np.array([(vertex.x, vertex.y) for vertex in world.vertices])
        level = np.array([vertex.level for vertex in world.vertices], np.int16)
        apart = np.hypot(*(position[:, None] - position[None]).transpose(2, 0, 1))
        edges = np.argwhere((level[:, None] == level[None]) & (apart > 0))
        length = apart[edges[:, 0], edges[:, 1]]
        models, _ = fleet.profiles
        return Roadmap(
            position=position,
            level=level,
            heading=np.full(len(position), np.nan),
            edges=edges.astype(np.int32),
            duration=np.stack([driving_ticks(length, robot.max_speed, _TICK) for robot in models]).astype(np.int32),
            tick=_TICK,
            place=np.arange(len(position), dtype=np.int32),
        )
