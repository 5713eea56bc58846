"""One robot on its route: what it has reached and cleared, what lies ahead, and whether it makes progress."""

import math
from typing import TYPE_CHECKING

import numpy as np

from mrpbench_core.model.arrays import Float
from mrpbench_core.model.execution import Mode, Route

if TYPE_CHECKING:
    from mrpbench_core.builtin.navigators.waypoints import Waypoints

_SETTLED = 0.02
"""metres before the end of what is released at which a robot that has reached it need not be driven any more."""
_STANDING = 0.01
"""m/s."""
_STRAIGHT = 0.3
"""radians: a corner of less is no bend."""
_SLACK = 1e-6
"""metres."""


class Follower:
    """Follows one route. `clearance` is the distance in metres at which this robot leaves room for any other."""

    def __init__(self, route: Route, options: "Waypoints", clearance: float) -> None:
        self._options = options
        self._stops = options.waypoints == "stop"
        self._clearance = clearance
        self.reached = self.cleared = 0
        self.yaw = math.nan
        """Yaw to take at the end of the last `path`, NaN = any."""
        self._leg = 0  # the robot drives from corner `_leg` of its route to the next
        self.adopt(route)

    def adopt(self, route: Route) -> None:
        """Continue with a route that begins with what was released of the old one; a robot that gave up tries again."""
        self._yaw: list[float] = route.waypoint[:, 2].tolist()
        self._speed: list[float] = [*route.speed.tolist(), math.inf]
        # Waits are segments without length: the robot drives along the vertices that differ from the one before.
        moves = (np.diff(route.waypoint[:, :2], axis=0) != 0).any(axis=1)
        self._corners = route.waypoint[np.concatenate([[True], moves]), :2]
        self._corner: list[int] = np.concatenate([[0], np.cumsum(moves)]).tolist()
        self._bends: list[bool] = _bends(self._corners)
        self._points: list[tuple[float, float]] = [(x, y) for x, y in self._corners.tolist()]
        self._end = self._corner[self.reached]
        self._released = self.reached
        self._halting = self._at_goal = False
        self._baseline: tuple[float, float, float] | None = None
        self._recoveries = 0
        self.mode = Mode.WAITING

    @property
    def speed(self) -> float:
        """Speed limit of the segment under way, m/s."""
        return self._speed[self.reached]

    def update(self, now: float, x: float, y: float, yaw: float, speed: float, released: int) -> tuple[str, ...]:
        """Take note of an estimated pose; returns the kinds of the events that follow from it."""
        before = self.reached
        self._halting = self._halting and abs(speed) > _STANDING
        while self.reached < released and not self._halting and self._has_arrived(x, y, yaw):
            self.reached += 1
            self._halting = self._stops and abs(speed) > _STANDING
        self._released = min(self.reached + 1, released) if self._stops else released
        self._end = self._corner[self._released]
        while self._leg + 1 < self._end and self._is_round_the_corner(x, y):
            self._leg += 1
        while self.cleared < released and self._has_cleared(x, y):
            self.cleared += 1
        if self.reached > before:
            self._recoveries = 0
        return self._check_progress(now, x, y, self.reached < released)

    def path(self, x: float, y: float, yaw: float) -> Float | None:
        """What lies ahead, f8[k,2]: the nearest point of the route, then released waypoints; None = stand still.

        It ends at the first bend not yet reached, so that no controller cuts a corner by more than the tolerance.
        """
        if self.mode == Mode.ABORTED or self._halting or self._end == 0:
            return None
        foot = _nearest(x, y, *self._points[self._leg], *self._points[self._leg + 1])
        settled = self._leg + 1 == self._end and math.dist(foot, self._points[self._end]) <= _SETTLED
        if settled and self.reached == self._released and self._faces(yaw, self._released):
            return None
        end = min(max(self._corner[self.reached], self._leg) + 1, self._end)
        while end < self._end and not self._bends[end]:
            end += 1
        self.yaw = self._yaw[self._released] if end == self._end else math.nan
        ahead = np.empty((end - self._leg + 1, 2))
        ahead[0] = foot
        ahead[1:] = self._corners[self._leg + 1 : end + 1]
        return ahead

    def _has_arrived(self, x: float, y: float, yaw: float) -> bool:
        """Tell whether the robot is at the end of the first segment not yet reached."""
        goal = self.reached + 1
        corner = self._corner[goal]
        px, py = self._points[corner]
        distance = math.hypot(x - px, y - py)
        if goal == len(self._corner) - 1:
            self._at_goal = self._at_goal or distance <= self._options.xy_goal_tolerance
            return self._at_goal and self._faces(yaw, goal)
        if corner == self._corner[self.reached] or distance <= self._options.waypoint_tolerance:
            return True
        qx, qy = self._points[corner - 1]
        length = math.hypot(px - qx, py - qy)
        past = ((x - px) * (px - qx) + (y - py) * (py - qy)) / length
        beside = ((px - qx) * (y - py) - (py - qy) * (x - px)) / length
        return past >= 0 and abs(beside) <= self._options.waypoint_tolerance

    def _faces(self, yaw: float, waypoint: int) -> bool:
        """Tell whether `yaw` is the one that a waypoint prescribes, if it prescribes any."""
        wanted = self._yaw[waypoint]
        return math.isnan(wanted) or abs(math.remainder(yaw - wanted, math.tau)) <= self._options.yaw_goal_tolerance

    def _is_round_the_corner(self, x: float, y: float) -> bool:
        """Tell whether the robot reached the next corner and is nearer to the leg behind it than to this one."""
        here, corner, behind = self._points[self._leg : self._leg + 3]
        if self._corner[self.reached] <= self._leg:
            return False
        return math.dist((x, y), _nearest(x, y, *corner, *behind)) <= math.dist((x, y), _nearest(x, y, *here, *corner))

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

    def _check_progress(self, now: float, x: float, y: float, under_way: bool) -> tuple[str, ...]:
        if self.mode == Mode.ABORTED:
            return ()
        self.mode = Mode.FOLLOWING if under_way else Mode.WAITING
        if not under_way:
            self._baseline = None
            return ()
        since = self._baseline
        if since is None or math.dist((x, y), since[1:]) > self._options.required_movement_radius:
            self._baseline = (now, x, y)
        elif now - since[0] > self._options.movement_time_allowance:
            self._baseline = (now, x, y)
            self._recoveries += 1
            if self._recoveries > self._options.max_recoveries:
                self.mode = Mode.ABORTED
                return ("no_progress", "aborted")
            return ("no_progress",)
        return ()


def _bends(corners: Float) -> list[bool]:
    """At which corners f8[k,2] the direction changes by more than `_STRAIGHT`."""
    legs = np.diff(corners, axis=0)
    yaw = np.arctan2(legs[:, 1], legs[:, 0])
    turn = np.abs(np.remainder(np.diff(yaw) + np.pi, 2 * np.pi) - np.pi)
    return [False, *(turn > _STRAIGHT).tolist(), False]


def _nearest(x: float, y: float, ax: float, ay: float, bx: float, by: float) -> tuple[float, float]:
    """The point of the segment a-b nearest to a point."""
    dx, dy = bx - ax, by - ay
    share = min(max(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0), 1.0)
    return ax + share * dx, ay + share * dy
