"""The paths of robots, as a navigator needs them."""

from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import pairwise
from typing import overload

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


@attrs.frozen(kw_only=True)
class Routes(Sequence[Route]):
    """The routes of all robots in flat arrays, which are copied as a whole; items are made when asked for."""

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
            first=np.cumsum([0, *(len(route.level) for route in routes)]),
            waypoint=np.concatenate([np.empty((0, 3)), *(route.waypoint for route in routes)]),
            level=np.concatenate([np.empty(0, np.int16), *(route.level for route in routes)]),
            speed=np.concatenate([np.empty(0), *(np.append(route.speed, np.inf) for route in routes)]),
        )

    def __len__(self) -> int:
        return len(self.first) - 1

    @overload
    def __getitem__(self, robot: int) -> Route: ...
    @overload
    def __getitem__(self, robot: slice) -> tuple[Route, ...]: ...
    def __getitem__(self, robot: int | slice) -> Route | tuple[Route, ...]:
        return self._items[robot]

    def __iter__(self) -> Iterator[Route]:
        return iter(self._items)

    @cached_property
    def _items(self) -> tuple[Route, ...]:
        return tuple(
            Route(waypoint=self.waypoint[begin:end], level=self.level[begin:end], speed=self.speed[begin : end - 1])
            for begin, end in pairwise(self.first.tolist())
        )

    @property
    def size(self) -> Int:
        """Number i8[n] of waypoints of each route."""
        return np.diff(self.first)


def last_moves(routes: Sequence[Route]) -> Int:
    """`Route.last_move` of each of n routes, i8[n], for all at once."""
    joined = Routes.of(routes)
    first, size, place, level = joined.first[:-1], joined.size, joined.waypoint[:, :2], joined.level
    robot = np.repeat(np.arange(len(size)), size)
    moved = (place[1:] != place[:-1]).any(axis=1) | (level[1:] != level[:-1])
    at = np.flatnonzero(moved & (robot[1:] == robot[:-1]))
    last: Int = np.zeros(len(size), np.int64)
    last[robot[at]] = at + 1 - first[robot[at]]  # of equal robots the last one counts
    return last
