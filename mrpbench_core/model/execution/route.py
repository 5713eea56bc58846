"""The paths of robots, as a navigator needs them."""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int16, array
from mrpbench_core.model.common.flat_sequence import FlatSequence, firsts, joined, rows


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


@attrs.frozen(kw_only=True)
class Routes(FlatSequence[Route]):
    """The routes of all robots."""

    first: Int = array("i8")
    """i8[n+1]: the waypoints of robot i are `first[i]:first[i + 1]`, at least one."""
    waypoint: Float = array("f8", 3)
    """f8[w,3] as in `Route`, like the other columns."""
    level: Int16 = array("i2")
    """i2[w]."""
    speed: Float = array("f8")
    """f8[w] upper limit on the segment that begins at each waypoint; that at the last one of a robot means nothing."""

    @classmethod
    def of(cls, routes: Sequence[Route]) -> "Routes":
        """Join routes; `Routes` are returned as they are."""
        if isinstance(routes, Routes):
            return routes
        return cls(
            first=firsts(len(route.level) for route in routes),
            waypoint=joined((route.waypoint for route in routes), "f8", 3),
            level=joined((route.level for route in routes), "i2"),
            speed=joined((np.append(route.speed, np.inf) for route in routes), "f8"),
        )

    def __len__(self) -> int:
        return len(self.first) - 1

    def _item(self, index: int) -> Route:
        here = rows(self.first, index)
        return Route(waypoint=self.waypoint[here], level=self.level[here], speed=self.speed[here][:-1])

    @property
    def size(self) -> Int:
        """Number i8[n] of waypoints of each route."""
        return np.diff(self.first)


def last_moves(routes: Sequence[Route]) -> Int:
    """`Route.last_move` of each of n routes, i8[n], for all at once."""
    flat = Routes.of(routes)
    first, size, (x, y, _), level = flat.first[:-1], flat.size, flat.waypoint.T, flat.level
    robot = np.repeat(np.arange(len(size)), size)
    moved = (x[1:] != x[:-1]) | (y[1:] != y[:-1]) | (level[1:] != level[:-1])
    at = np.flatnonzero(moved & (robot[1:] == robot[:-1]))
    last: Int = np.zeros(len(size), np.int64)
    last[robot[at]] = at + 1 - first[robot[at]]  # of equal robots the last one counts
    return last
