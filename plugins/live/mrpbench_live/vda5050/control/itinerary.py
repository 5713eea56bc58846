"""The route of one robot as nodes of orders, counted in moves since the beginning of the run."""

import attrs
import numpy as np

from mrpbench_core.api import Float, Int, Route

SLACK = 1e-6
"""metres."""


@attrs.frozen(kw_only=True)
class Stop:
    """A node of a route."""

    x: float
    """metres."""
    y: float
    """metres."""
    yaw: float
    """radians; NaN = any."""
    level: int
    speed: float
    """m/s allowed on the way there; inf = no limit."""


class Itinerary:
    """Counts moves for segments, and segments for moves.

    A move leads to another place, level or yaw; the other segments of a route are waits, which no order mentions. Moves
    keep their numbers when a new plan leaves out segments.

    Args:
        route: of the first plan.
    """

    def __init__(self, route: Route) -> None:
        self._take(0, route)

    def adopt(self, route: Route, cut: int) -> None:
        """Continue with a route that leaves out the first `cut` segments, and begins with what was released."""
        self._take(self.moves_after(cut), route)

    def _take(self, base: int, route: Route) -> None:
        place = route.waypoint
        other = (place[1:, :2] != place[:-1, :2]).any(axis=1) | (route.level[1:] != route.level[:-1])
        turned = place[1:, 2] != place[:-1, 2]
        turned &= np.isfinite(place[1:, 2]) & np.isfinite(place[:-1, 2])
        moves = other | turned
        self._count: Int = base + np.concatenate([[0], np.cumsum(moves)])
        """i8[k+1]: moves made after each number of segments."""
        self._row: Int = np.concatenate([[0], np.flatnonzero(moves) + 1])
        """i8[m+1]: the waypoint of each node."""
        self._base, self._route = base, route
        ends: Float = place[self._row, :2]
        same = np.append((ends[1:] == ends[:-1]).all(axis=1), False) & np.append(~other[self._row[1:] - 1], False)
        after = np.where(same, len(same), np.arange(len(same)))
        self._leaves: Int = np.minimum.accumulate(after[::-1])[::-1]
        """i8[m+1]: the last node in a row at the same place, from each on."""
        self._legs: Float = np.append(np.hypot(*np.diff(ends, axis=0).T), 0.0)
        """f8[m+1]: metres from each node to the next one."""

    @property
    def first(self) -> int:
        """The moves before the first node that is known."""
        return self._base

    @property
    def length(self) -> int:
        """Moves of the whole route."""
        return self._base + len(self._row) - 1

    def moves_after(self, segments: int) -> int:
        """Return the moves that are made after some segments."""
        return int(self._count[segments])

    def segments_after(self, moves: int, released: int) -> int:
        """Return the segments, of those released, that are over after some moves; waits are over at once."""
        return min(released, int(np.searchsorted(self._count, moves, "right")) - 1)

    def stop(self, moves: int) -> Stop:
        """Return where a robot is after some moves."""
        row = int(self._row[moves - self._base])
        x, y, yaw = self._route.waypoint[row].tolist()
        speed = float(self._route.speed[row - 1]) if row else float("inf")
        return Stop(x=x, y=y, yaw=yaw, level=int(self._route.level[row]), speed=speed)

    def has_left(self, segment: int, moves: int, x: float, y: float, clearance: float) -> bool:
        """Tell whether a robot has left the start of a segment, so that another one fits there.

        Args:
            segment: that it has come to.
            moves: that it has made.
            x: metres.
            y: metres; where it is.
            clearance: metres at which it leaves room for any other.
        """
        node = int(self._leaves[int(self._count[segment]) - self._base])
        if node >= len(self._row) - 1 or moves < self._base + node:
            return False
        if self._legs[node] <= clearance + SLACK and moves > self._base + node:
            return True
        there = self._route.waypoint[self._row[node], :2]
        return bool(np.hypot(x - there[0], y - there[1]) >= clearance - SLACK)
