"""A route as a robot drives it: without its waits, and with all that stays the same on the way worked out once."""

import math
from typing import TYPE_CHECKING

import numpy as np

from mrpbench_core.model.arrays import Float
from mrpbench_core.model.execution import Route

if TYPE_CHECKING:
    from mrpbench_core.builtin.navigators.waypoints import Waypoints

Point = tuple[float, float]

NAN = math.nan
_STRAIGHT = 0.3
"""radians: a corner of less is no bend."""
_SLACK = 1e-6
"""metres."""


class Track:
    """The corners of one route, and what a follower has to know at each. Leg i leads from corner i to corner i + 1.

    Args:
        route: the route.
        options: of the navigator.
        clearance: distance in metres at which this robot leaves room for any other.
    """

    def __init__(self, route: Route, options: "Waypoints", clearance: float) -> None:
        self.level: list[int] = route.level.tolist()
        self.speed: list[float] = [*route.speed.tolist(), math.inf]
        # Waits are segments without length, and in a lift it is the lift that drives. The robot drives along the
        # vertices that differ from the one before.
        moves = (np.diff(route.waypoint[:, :2], axis=0) != 0).any(axis=1) & (np.diff(route.level) == 0)
        self.corners: Float = route.waypoint[np.concatenate([[True], moves]), :2]
        """f8[c,2]: the route without its waits."""
        self.corner: list[int] = np.concatenate([[0], np.cumsum(moves)]).tolist()
        """The corner at which each waypoint lies."""
        self.points: list[Point] = [(x, y) for x, y in self.corners.tolist()]
        ahead = [_direction(*ends) for ends in zip(self.points, self.points[1:], strict=False)]
        self.yaw = self._yaws(route, ahead, stops=options.waypoints == "stop")
        """What is prescribed at each waypoint, NaN = any."""
        self.bend = _next_bends(self.corners)
        """The first bend at or after each corner, or the last corner."""
        self.arrive = self._arrivals(options, ahead)
        """x, y, distance within which each waypoint is reached; direction of the way to it, and how far beside it may
        be passed: NaN at the last, and at waits before the first corner."""
        self.round = [
            (*corner, into[0] + out[0], into[1] + out[1])
            for corner, into, out in zip(self.points[1:], ahead, ahead[1:], strict=False)
        ]
        """x, y of the corner after each leg, and the sum of the directions of this leg and the next."""
        self.clear = [(x, y, clearance - _SLACK) for x, y in self.points[:-1]]
        """x, y of each corner but the last, and how far from it there is room for others."""
        self.is_short = [
            math.dist(*ends) <= clearance + _SLACK for ends in zip(self.points, self.points[1:], strict=False)
        ]
        """Whether each leg is no longer than that."""
        self.leg = [_leg(*ends) for ends in zip(self.points, [*self.points[1:], self.points[-1]], strict=True)]
        """x, y, way in x and y, and the square of its length; the last has none."""

    def _yaws(self, route: Route, ahead: list[Point], stops: bool) -> list[float]:
        """Who stops at each waypoint turns there to where the next one lies."""
        yaws: list[float] = route.waypoint[:, 2].tolist()
        if stops:
            for index, corner in enumerate(self.corner):
                if math.isnan(yaws[index]) and corner < len(ahead):
                    yaws[index] = math.atan2(ahead[corner][1], ahead[corner][0])
        return yaws

    def _arrivals(self, options: "Waypoints", ahead: list[Point]) -> list[tuple[float, ...]]:
        within = options.waypoint_tolerance
        at = [(*self.points[0], within, NAN, NAN, NAN)]
        at += [(*point, within, *into, within) for point, into in zip(self.points[1:], ahead, strict=True)]
        end = (*self.points[-1], options.xy_goal_tolerance, NAN, NAN, NAN)
        return [*(at[corner] for corner in self.corner[:-1]), end]


def _leg(begin: Point, end: Point) -> tuple[float, ...]:
    dx, dy = end[0] - begin[0], end[1] - begin[1]
    return *begin, dx, dy, max(dx * dx + dy * dy, 1e-300)  # no leg has no direction: its point is the nearest


def _next_bends(corners: Float) -> list[int]:
    """The first of the corners f8[k,2], from each on, at which the direction changes by more than `_STRAIGHT`."""
    legs = np.diff(corners, axis=0)
    yaw = np.arctan2(legs[:, 1], legs[:, 0])
    turn = np.abs(np.remainder(np.diff(yaw) + np.pi, 2 * np.pi) - np.pi)
    bends = np.append(np.flatnonzero(turn > _STRAIGHT) + 1, len(corners) - 1)
    following: list[int] = bends[np.searchsorted(bends, np.arange(len(corners)))].tolist()
    return following


def _direction(a: Point, b: Point) -> Point:
    length = math.dist(a, b)
    return ((b[0] - a[0]) / length, (b[1] - a[1]) / length) if length else (0.0, 0.0)
