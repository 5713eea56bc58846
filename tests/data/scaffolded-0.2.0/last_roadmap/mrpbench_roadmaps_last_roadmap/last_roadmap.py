"""LastRoadmap: a lattice on which robots also drive diagonally."""

import math

import attrs
import numpy as np
from mrpbench_core.api import RoadmapBuilder, option
from mrpbench_core.checking.clearance import has_clearance
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.world import Level, Vertex, World

NEIGHBOURS = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)]


@attrs.frozen(kw_only=True)
class LastRoadmap(RoadmapBuilder):
    """Joins each point of a lattice on the ground floor to its eight neighbours wherever the largest robot fits."""

    spacing: float = option(0.6, help="distance of the points", unit="m", validator=attrs.validators.gt(0))
    tick: float = option(0.5, help="time step of durations", unit="s", validator=attrs.validators.gt(0))

    def build(self, world: World, fleet: Fleet) -> Roadmap:
        """Return the lattice within the bounds of the walls and obstacles of the first level.

        Raises:
            InputError: no robot fits anywhere, or the level has no walls.
        """
        level, radius = world.levels[0], float(fleet.radii.max())
        point = self.lattice(level)
        point = point[has_clearance(level, point, point, radius)]
        vertex = {(x, y): index for index, (x, y) in enumerate(np.rint(point / self.spacing).astype(int).tolist())}
        pairs = [
            (index, vertex[x + dx, y + dy])
            for (x, y), index in vertex.items()
            for dx, dy in NEIGHBOURS
            if (x + dx, y + dy) in vertex
        ]
        edges = np.array(pairs, "i4").reshape(-1, 2)
        edges = edges[has_clearance(level, point[edges[:, 0]], point[edges[:, 1]], radius)]
        if not len(edges):
            raise InputError(f"no robot fits between the walls of {world.name}", hint="choose another spacing")
        length = np.hypot(*(point[edges[:, 1]] - point[edges[:, 0]]).T)
        profiles, _ = fleet.profiles
        return Roadmap(
            position=point,
            level=np.zeros(len(point), "i2"),
            heading=np.full(len(point), np.nan),
            edges=edges,
            duration=np.ceil([length / robot.max_speed / self.tick for robot in profiles]).astype("i4"),
            tick=self.tick,
            place=np.array([self.nearest(point, place) for place in world.vertices], "i4"),
        )

    def lattice(self, level: Level) -> Float:
        """Return all points f8[k,2] within the bounds of a level.

        Raises:
            InputError: the level has neither walls nor obstacles, which bound it.
        """
        solid = np.concatenate([level.walls.reshape(-1, 2), *(obstacle.polygon for obstacle in level.obstacles)])
        if not len(solid):
            raise InputError(f"level {level.name} has neither walls nor obstacles, which bound the lattice")
        low, high = solid.min(axis=0) / self.spacing, solid.max(axis=0) / self.spacing
        x, y = (np.arange(math.ceil(a), math.floor(b) + 1) for a, b in zip(low, high, strict=True))
        return self.spacing * np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)

    def nearest(self, point: Float, place: Vertex) -> int:
        """Return the point that stands for a place of the world, -1 if none is near."""
        away = np.hypot(*(point - (place.x, place.y)).T)
        return int(away.argmin()) if place.level == 0 and away.min() < self.spacing else -1
