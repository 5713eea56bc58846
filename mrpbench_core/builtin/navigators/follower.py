"""One robot on its route: what it has reached and cleared, and what lies ahead."""

import math
from typing import TYPE_CHECKING

import numpy as np

from mrpbench_core.model.arrays import Float
from mrpbench_core.model.execution import Route

if TYPE_CHECKING:
    from mrpbench_core.builtin.navigators.waypoints import Waypoints

_STANDING = 0.01
"""m/s."""
_STRAIGHT = 0.3
"""radians: a corner of less is no bend."""
_SLACK = 1e-6
"""metres."""

WATCHED = (
    *("arrive_x", "arrive_y", "arrive_within", "arrive_ahead_x", "arrive_ahead_y", "arrive_beside"),
    *("round_x", "round_y", "round_ahead_x", "round_ahead_y", "clear_x", "clear_y", "clear_beyond"),
    *("leg_x", "leg_y", "leg_dx", "leg_dy", "leg_squared", "end_x", "end_y", "yaw", "speed"),
)
"""What a fleet has to watch for each robot, see `Follower.watched`. NaN = nothing of that kind."""


class Follower:
    """Follows one route.

    Between the moments at which something changes (a waypoint is reached, a corner rounded, a vertex cleared, more is
    released) only `watched` has to be looked at, which a fleet does for all robots at once.

    Args:
        route: its route.
        options: of the navigator.
        clearance: distance in metres at which this robot leaves room for any other.
        first: the row of the fleet's table of corners at which this route's begin.
    """

    def __init__(self, route: Route, options: "Waypoints", clearance: float, first: int = 0) -> None:
        self._options = options
        self._stops = options.waypoints == "stop"
        self._clearance = clearance
        self.reached = self.cleared = 0
        self._leg = 0  # the robot drives from corner `_leg` of its route to the next
        self.adopt(route, first)

    def adopt(self, route: Route, first: int = 0) -> None:
        """Continue with a route that begins with what was released of the old one."""
        self._level: list[int] = route.level.tolist()
        self._speed: list[float] = [*route.speed.tolist(), math.inf]
        # Waits are segments without length, and in a lift it is the lift that drives. The robot drives along the
        # vertices that differ from the one before.
        moves = (np.diff(route.waypoint[:, :2], axis=0) != 0).any(axis=1) & (np.diff(route.level) == 0)
        self.corners: Float = route.waypoint[np.concatenate([[True], moves]), :2]
        """f8[c,2]: the route without its waits."""
        self._corner: list[int] = np.concatenate([[0], np.cumsum(moves)]).tolist()
        self._bends: list[bool] = _bends(self.corners)
        self._points: list[tuple[float, float]] = [(x, y) for x, y in self.corners.tolist()]
        self._yaw = self._yaws(route)
        self._first = first
        self._end = self._corner[self.reached]
        self._released = self.reached
        self._halting = self._at_goal = False

    def _yaws(self, route: Route) -> list[float]:
        """What is prescribed at each waypoint. Who stops at each turns there to where the next one lies."""
        yaws: list[float] = route.waypoint[:, 2].tolist()
        if self._stops:
            for index, corner in enumerate(self._corner):
                if math.isnan(yaws[index]) and corner + 1 < len(self._points):
                    ahead = _direction(self._points[corner], self._points[corner + 1])
                    yaws[index] = math.atan2(ahead[1], ahead[0])
        return yaws

    def update(self, x: float, y: float, yaw: float, speed: float, released: int, level: int = 0) -> None:
        """Take note of an estimated pose, of how many leading segments are released, and of the robot's level."""
        self._halting = self._halting and abs(speed) > _STANDING
        while self.reached < released and not self._halting and self._has_arrived(x, y, yaw, level):
            self.reached += 1
            self._at_goal = False
            self._halting = self._stops and abs(speed) > _STANDING
        self._released = min(self.reached + 1, released) if self._stops else released
        self._end = self._corner[self._released]
        while self._leg + 1 < self._end and self._is_round_the_corner(x, y):
            self._leg += 1
        while self.cleared < released and self._has_cleared(x, y):
            self.cleared += 1

    def rejoin(self, x: float, y: float) -> None:
        """Continue from a point of the released route, as if all before it had been reached."""
        legs = range(self._leg, max(self._end, self._leg + 1))
        self._leg = min(legs, key=lambda leg: math.dist((x, y), _nearest(x, y, *self._leg_ends(leg))))
        while self.reached < self._released and self._corner[self.reached + 1] <= self._leg:
            self.reached += 1

    def skip(self) -> None:
        """Count the end of the path as reached, from wherever the robot is: it is occupied."""
        _, end = self._span()
        while self.reached < self._released and self._corner[self.reached + 1] <= end:
            self.reached += 1
        self._leg = max(self._leg, min(end, len(self._points) - 2))
        self._at_goal = False

    def left_behind(self, x: float, y: float) -> tuple[tuple[float, float] | None, float]:
        """The vertex that this robot has left to others last, and how far from it a robot at (x, y) must stay."""
        if self.cleared == 0:
            return None, 0.0
        vertex = self._points[self._corner[self.cleared - 1]]
        return vertex, min(self._clearance, math.dist((x, y), vertex)) - _SLACK

    @property
    def is_busy(self) -> bool:
        """Tell whether `update` is needed in every period."""
        return self._halting or self.rides or self.only_turns

    @property
    def only_turns(self) -> bool:
        """Tell whether the robot is where it is to go next, and only its yaw is wrong."""
        return self._at_goal and self.reached < self._released

    @property
    def rides(self) -> bool:
        """Tell whether the robot is, or is to be, carried by a lift."""
        return self.reached < self._released and self._level[self.reached] != self._level[self.reached + 1]

    @property
    def may_drive(self) -> bool:
        """Tell whether anything is released that could have to be driven to, or turned to."""
        return not self._halting and (self._end > 0 or not math.isnan(self._yaw[self._released]))

    @property
    def is_last(self) -> bool:
        """Tell whether all that is released is reached and the robot only drives on to its very end."""
        return self._leg + 1 >= self._end and self.reached == self._released

    @property
    def path(self) -> tuple[int, int]:
        """Rows of the fleet's table of corners that lie ahead.

        They end at the first bend not yet reached, so that no controller cuts a corner by more than the tolerance.
        """
        begin, end = self._span()
        return self._first + begin, self._first + end + 1

    def watched(self) -> tuple[float, ...]:
        """The values of `WATCHED`."""
        nan = math.nan
        arrive = arriving = (nan, nan, nan)
        if self.reached < self._released and not self._halting:
            corner = self._corner[self.reached + 1]
            at_end = self.reached + 2 == len(self._corner)
            tolerance = self._options.xy_goal_tolerance if at_end else self._options.waypoint_tolerance
            arrive = (*self._points[corner], tolerance)
            if not at_end and corner > 0:
                arriving = (*_direction(self._points[corner - 1], self._points[corner]), tolerance)
        round_ = rounding = (nan, nan)
        if self._leg + 1 < self._end and self._corner[self.reached] > self._leg:
            round_, rounding = self._points[self._leg + 1], self._bisector()
        clear = (nan, nan, nan)
        corner = self._corner[self.cleared]
        if corner + 1 < len(self._points) and self._corner[self.reached] >= corner:
            clear = (*self._points[corner], self._clearance - _SLACK)
        _, end = self._span()
        (ax, ay), (bx, by) = self._leg_ends(self._leg)
        dx, dy = bx - ax, by - ay
        yaw = self._yaw[self._released] if end == self._end else nan
        leg = (ax, ay, dx, dy, max(dx * dx + dy * dy, 1e-300))  # no leg has no direction: its point is the nearest
        return (
            *arrive,
            *arriving,
            *round_,
            *rounding,
            *clear,
            *leg,
            *self._points[end],
            yaw,
            self._speed[self.reached],
        )

    def _span(self) -> tuple[int, int]:
        """First and last corner of the path."""
        begin = min(self._leg + 1, len(self._points) - 1)
        end = min(max(self._corner[self.reached], self._leg) + 1, self._end)
        while end < self._end and not self._bends[end]:
            end += 1
        return min(begin, end), end

    def _leg_ends(self, leg: int) -> tuple[tuple[float, float], tuple[float, float]]:
        return self._points[leg], self._points[min(leg + 1, len(self._points) - 1)]

    def _has_arrived(self, x: float, y: float, yaw: float, level: int) -> bool:
        """Tell whether the robot is at the end of the first segment not yet reached."""
        goal = self.reached + 1
        if level != self._level[goal]:
            return False
        corner = self._corner[goal]
        px, py = self._points[corner]
        distance = math.hypot(x - px, y - py)
        if goal == len(self._corner) - 1:
            near = distance <= self._options.xy_goal_tolerance
        else:
            near = corner == self._corner[self.reached] or distance <= self._options.waypoint_tolerance
            if not near:
                ux, uy = _direction(self._points[corner - 1], self._points[corner])
                past = (x - px) * ux + (y - py) * uy
                beside = ux * (y - py) - uy * (x - px)
                near = past >= 0 and abs(beside) <= self._options.waypoint_tolerance
            if not self._stops:
                return near
        self._at_goal = near or (self._at_goal and self._options.stateful)
        return self._at_goal and self._faces(yaw, goal)

    def _faces(self, yaw: float, waypoint: int) -> bool:
        """Tell whether `yaw` is the one that a waypoint prescribes, if it prescribes any."""
        wanted = self._yaw[waypoint]
        return math.isnan(wanted) or abs(math.remainder(yaw - wanted, math.tau)) <= self._options.yaw_goal_tolerance

    def _is_round_the_corner(self, x: float, y: float) -> bool:
        """Tell whether the robot reached the next corner and is on the far side of the line that halves its angle."""
        if self._corner[self.reached] <= self._leg:
            return False
        corner, ahead = self._points[self._leg + 1], self._bisector()
        return (x - corner[0]) * ahead[0] + (y - corner[1]) * ahead[1] >= -_SLACK

    def _bisector(self) -> tuple[float, float]:
        """The sum of the directions of this leg and the next."""
        here, corner, behind = self._points[self._leg : self._leg + 3]
        into, out = _direction(here, corner), _direction(corner, behind)
        return into[0] + out[0], into[1] + out[1]

    def _has_cleared(self, x: float, y: float) -> bool:
        """Tell whether the footprint has left the start of the first segment not yet cleared.

        A segment no longer than the clearance is cleared when it is reached: the robot may have to wait at its end, and
        the problem's own rules say what may stand that close. Waits are cleared with the move that ends them.
        """
        corner = self._corner[self.cleared]
        if corner + 1 >= len(self._points) or self._corner[self.reached] < corner:
            return False
        left = math.dist((x, y), self._points[corner]) >= self._clearance - _SLACK
        short = math.dist(self._points[corner], self._points[corner + 1]) <= self._clearance + _SLACK
        return left or (short and self._corner[self.reached] > corner)


def _bends(corners: Float) -> list[bool]:
    """At which corners f8[k,2] the direction changes by more than `_STRAIGHT`."""
    legs = np.diff(corners, axis=0)
    yaw = np.arctan2(legs[:, 1], legs[:, 0])
    turn = np.abs(np.remainder(np.diff(yaw) + np.pi, 2 * np.pi) - np.pi)
    return [False, *(turn > _STRAIGHT).tolist(), False]


def _direction(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    length = math.dist(a, b)
    return (b[0] - a[0]) / length, (b[1] - a[1]) / length


def _nearest(x: float, y: float, a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    """The point of the segment a-b nearest to a point."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    squared = dx * dx + dy * dy
    share = min(max(((x - a[0]) * dx + (y - a[1]) * dy) / squared, 0.0), 1.0) if squared else 0.0
    return a[0] + share * dx, a[1] + share * dy
