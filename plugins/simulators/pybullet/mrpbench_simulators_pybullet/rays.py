"""Lidars by Bullet's ray tests, which take a hundred times as long as the native caster, to check it."""

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int32
from mrpbench_core.model.common.fleet import Lidar
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

    Robots are their outlines at the height of the lidar, raised, which nothing can touch. They are placed just before a
    scan, and that of the scanning robot is moved away. They are triangles, since a ray test of a Bullet cylinder takes
    several times as long.
    """

    def __init__(self, bullet: Bullet, outlines: dict[Lidar, list[Float]]) -> None:
        self._bullet = bullet
        self._robots = {
            lidar: [self._silhouette(sides) for sides in of_robots] for lidar, of_robots in outlines.items()
        }
        self._movers: list[int] = []
        self._mover_radius: Float = np.empty(0)

    def scan(self, lidar: Lidar, robots: Int32, pose: Float, movers: MoverDiscs) -> Float:
        """Ranges f8[k,beams] of `robots`, while all stand at `pose` f8[n,3]; inf = no return."""
        self._place_movers(movers)
        shown = self._robots[lidar]
        for robot, body in enumerate(shown):
            self._place(body, pose[robot])
        ranges = np.empty((len(robots), lidar.beams))
        for row, robot in enumerate(robots):
            self._hide(shown[robot])
            ranges[row] = self._cast(lidar, pose[robot])
            self._place(shown[robot], pose[robot])
        for body in shown:  # lidars at other heights do not see them
            self._hide(body)
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
        if not np.array_equal(movers.scan_radius, self._mover_radius):
            for disc in self._movers:
                self._bullet.removeBody(disc)
            self._mover_radius = movers.scan_radius
            discs = (polygon_outline(radius * _CIRCLE) for radius in movers.scan_radius.tolist())
            self._movers = [body for sides in discs if (body := self._silhouette(sides)) is not None]
        for body, (x, y) in zip(self._movers, movers.scan_discs.tolist(), strict=True):
            if np.isfinite(x):
                self._place(body, np.array([x, y, 0.0]))
            else:
                self._hide(body)

    def _silhouette(self, sides: Float) -> int | None:
        """A body that only rays hit; None if there is nothing to see."""
        return self._bullet.body(Group.SILHOUETTES, build_mesh(self._bullet, sides), _AWAY) if len(sides) else None

    def _place(self, body: int | None, pose: Float) -> None:
        x, y, yaw = pose.tolist()
        if body is not None:
            turn = (0.0, 0.0, np.sin(yaw / 2), np.cos(yaw / 2))
            self._bullet.resetBasePositionAndOrientation(body, (x, y, 0.0), turn)

    def _hide(self, body: int | None) -> None:
        if body is not None:
            self._bullet.resetBasePositionAndOrientation(body, _AWAY, _UPRIGHT)
