"""Lidars: by Bullet's ray tests, or by the native caster, which is about a hundred times as fast.

Lidars see vertical walls, and each robot as the disc of its circumscribed radius, which planners use too, at any height
of the sensor. So both give the same ranges.
"""

from collections.abc import Sequence

import numpy as np
from mrpbench_native.sim import Caster

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet, Lidar
from mrpbench_core.model.execution.movers import MoverDiscs
from mrpbench_core.model.worlds.solids import polygon_outline
from mrpbench_simulators_pybullet.bullet import SEEN, Bullet, Group
from mrpbench_simulators_pybullet.walls import build_mesh

_BATCH = 16_383
"""Rays per call: with one more, PyBullet returns nothing."""
_SIDES = 64
"""Sides of the prism that stands for a disc, whose error is at most a thousandth of the radius."""
_AWAY = (0.0, 0.0, -100.0)
_TURN = np.arange(_SIDES) * (2 * np.pi / _SIDES)
_CIRCLE = np.column_stack([np.cos(_TURN), np.sin(_TURN)]) * (2 / (1 + np.cos(np.pi / _SIDES)))
_UPRIGHT = (0.0, 0.0, 0.0, 1.0)


class RayTests:
    """Takes the scans of a fleet among the bodies of a Bullet world.

    Robots are discs that nothing can touch. They are placed just before a scan, and the disc of the scanning robot is
    moved away. They are prisms of triangles, since a ray test of a Bullet cylinder takes several times as long.
    """

    def __init__(self, bullet: Bullet, fleet: Fleet) -> None:
        self._bullet = bullet
        self._discs = [self._disc(robot.radius) for robot in fleet.robots]
        self._movers: list[int] = []
        self._mover_radius: Float = np.empty(0)

    def scan(self, lidar: Lidar, robots: Sequence[int], pose: Float, movers: MoverDiscs) -> Float:
        """Ranges f8[k,beams] of `robots`, while all stand at `pose` f8[n,3]; inf = no return."""
        self._place_movers(movers)
        for disc, (x, y, _) in zip(self._discs, pose.tolist(), strict=True):
            self._place(disc, (x, y, 0.0))
        ranges = np.empty((len(robots), lidar.beams))
        for row, robot in enumerate(robots):
            self._place(self._discs[robot], _AWAY)
            ranges[row] = self._cast(lidar, pose[robot])
            self._place(self._discs[robot], (pose[robot, 0], pose[robot, 1], 0.0))
        ranges[(ranges < lidar.min_range) | (ranges > lidar.range)] = np.inf
        return ranges

    def _cast(self, lidar: Lidar, pose: Float) -> Float:
        cosine, sine = np.cos(pose[2]), np.sin(pose[2])
        forward, leftward, height = lidar.mount
        angle = pose[2] + np.arange(lidar.beams) * (2 * np.pi / lidar.beams)
        start = np.empty((lidar.beams, 3))
        start[:] = pose[0] + cosine * forward - sine * leftward, pose[1] + sine * forward + cosine * leftward, height
        end = start + lidar.range * np.column_stack([np.cos(angle), np.sin(angle), np.zeros(lidar.beams)])
        hits = []
        for first in range(0, lidar.beams, _BATCH):
            part = slice(first, first + _BATCH)
            hits += self._bullet.rayTestBatch(start[part], end[part], collisionFilterMask=int(SEEN))
        share = np.fromiter((hit[2] if hit[0] >= 0 else np.inf for hit in hits), float, lidar.beams)
        ranges: Float = share * lidar.range
        return ranges

    def _place_movers(self, movers: MoverDiscs) -> None:
        """Put the discs of movers where lidars see them; their radii change at most once, when they get legs."""
        if not np.array_equal(movers.seen_radius, self._mover_radius):
            for disc in self._movers:
                self._bullet.removeBody(disc)
            self._mover_radius = movers.seen_radius
            self._movers = [self._disc(radius) for radius in movers.seen_radius.tolist()]
        for disc, (x, y) in zip(self._movers, movers.seen.tolist(), strict=True):
            self._place(disc, (x, y, 0.0) if np.isfinite(x) else _AWAY)

    def _disc(self, radius: float) -> int:
        mesh = build_mesh(self._bullet, polygon_outline(radius * _CIRCLE))
        return self._bullet.body(Group.SILHOUETTES, mesh, _AWAY)

    def _place(self, disc: int, position: tuple[float, float, float]) -> None:
        self._bullet.resetBasePositionAndOrientation(disc, position, _UPRIGHT)


class Casters:
    """Takes the scans of a fleet among segments and discs, in C++."""

    def __init__(self, lidars: Sequence[Lidar], segments: Float) -> None:
        self._casters = {lidar: Caster(segments=segments, lidar=lidar) for lidar in lidars}

    def scan(
        self, lidar: Lidar, robots: Sequence[int], pose: Float, seen: Float, radius: Float, leaves: Float
    ) -> Float:
        """Ranges f8[k,beams] of `robots`, while all stand at `pose` f8[n,3] and leaves at f8[S,4].

        `seen` f8[m,2] are the discs of movers, and `radius` f8[n+m] the radii of robots and those.
        """
        return self._casters[lidar].scan(np.array(robots, np.int32), pose, seen, radius, leaves)
