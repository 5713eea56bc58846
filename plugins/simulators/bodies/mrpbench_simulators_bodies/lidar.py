"""Lidars among walls, leaves of doors, movers, and the robots as they are at the height of the sensor; in C++."""

from collections.abc import Sequence

import numpy as np
from mrpbench_native.sim import Caster

from mrpbench_core.model.common.arrays import Float, Int32
from mrpbench_core.model.common.fleet import Lidar
from mrpbench_simulators_bodies.body import RobotBody
from mrpbench_simulators_bodies.sections import outline_at


class Casters:
    """Takes the scans of a fleet. No robot sees itself."""

    def __init__(self, lidars: Sequence[Lidar], segments: Float, bodies: Sequence[RobotBody], radii: Float) -> None:
        self._radii = radii
        self._casters = {lidar: Caster(segments=segments, lidar=lidar) for lidar in lidars}
        self.outlines = {lidar: outlines(bodies, lidar.mount[2]) for lidar in lidars}
        """For each lidar, the outline f8[S,4] of each robot in its base frame."""
        self._flat = {lidar: _flat(sides) for lidar, sides in self.outlines.items()}

    def scan(self, lidar: Lidar, robots: Int32, pose: Float, movers: Float, radius: Float, leaves: Float) -> Float:
        """Ranges f8[k,beams] of `robots`, while all stand at `pose` f8[n,3] and leaves at f8[S,4]; inf = no return.

        `movers` f8[m,2] are the centres of discs of `radius` f8[m].
        """
        side, first = self._flat[lidar]
        return self._casters[lidar].scan(
            robots,
            pose,
            np.ascontiguousarray(movers),
            np.concatenate([self._radii, radius]),
            leaves,
            side,
            first,
        )


def outlines(bodies: Sequence[RobotBody], height: float) -> list[Float]:
    """The outline f8[S,4] of each body at a height."""
    outline_of: dict[int, Float] = {}
    for body in bodies:
        if id(body) not in outline_of:
            outline_of[id(body)] = outline_at(body, height)
    return [outline_of[id(body)] for body in bodies]


def _flat(sides: Sequence[Float]) -> tuple[Float, np.ndarray[tuple[int], np.dtype[np.int32]]]:
    """All sides f8[K,4], and i4[n+1] the first of each robot."""
    first = np.cumsum([0, *map(len, sides)]).astype(np.int32)
    return np.concatenate([np.empty((0, 4)), *sides]), first
