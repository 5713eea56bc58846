"""The path of one robot, as a navigator needs it."""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int16, array


@attrs.frozen(kw_only=True)
class Route:
    """One robot's path in metres, as a navigator needs it."""

    waypoint: Float = array("f8", 3)
    """f8[k+1,3]: x, y, yaw (NaN = any): the start, then the end of each path segment."""
    level: Int16 = array("i2")
    """i2[k+1]."""
    speed: Float = array("f8")
    """f8[k] m/s: upper limit on each segment, inf = none."""

    @property
    def is_move(self) -> Bool:
        """bool[k]: the segment leads to another place or level; the others are waits."""
        moved: Bool = (np.diff(self.waypoint[:, :2], axis=0) != 0).any(axis=1) | (np.diff(self.level) != 0)
        return moved

    @property
    def last_move(self) -> int:
        """Number of leading segments up to the last move, 0 = none: the robot arrives when it has completed these.

        The waits after it do not count, because a new plan may add some: it begins with what was released and then
        lets robots wait until it takes effect.
        """
        moves = np.flatnonzero(self.is_move)
        return int(moves[-1]) + 1 if len(moves) else 0


def last_moves(routes: Sequence[Route]) -> Int:
    """`Route.last_move` of each of n routes, i8[n], for all at once."""
    size = [len(route.level) for route in routes]
    place = np.concatenate([np.empty((0, 2)), *(route.waypoint[:, :2] for route in routes)])
    level = np.concatenate([np.empty(0, np.int16), *(route.level for route in routes)])
    robot = np.repeat(np.arange(len(size)), size)
    moved = (np.diff(place, axis=0) != 0).any(axis=1) | (np.diff(level) != 0)
    at = np.flatnonzero(moved & (robot[1:] == robot[:-1]))
    last: Int = np.zeros(len(size), np.int64)
    last[robot[at]] = at + 1 - (np.cumsum(size) - size)[robot[at]]  # of equal robots the last one counts
    return last
