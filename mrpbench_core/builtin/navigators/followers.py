"""All robots on their routes: what moves is looked at in every period, what changes rarely when it does."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from mrpbench_core.builtin.navigators.advance import AHEAD, BEHIND, Advance
from mrpbench_core.model.arrays import Bool, Float, Int, Int16, Int32, frozen_array
from mrpbench_core.model.execution import Route

if TYPE_CHECKING:
    from mrpbench_core.builtin.navigators.waypoints import Waypoints

_SETTLED = 0.02
"""metres before the end of what is released at which a robot that has reached it need not be driven any more."""
_SLACK = 1e-6
"""metres."""


class Followers:
    """Follows one route per robot.

    Args:
        routes: one per robot.
        options: of the navigator.
        clearances: f8[n] metres at which each robot leaves room for any other.
    """

    def __init__(self, routes: Sequence[Route], options: "Waypoints", clearances: Float) -> None:
        count = len(routes)
        self._options = options
        self._advance = Advance(routes, options, clearances)
        self._released: Int32 = np.zeros(count, np.int32)
        self._ahead: Float = np.full((len(AHEAD), count), np.nan)
        self._behind: Float = np.full((len(BEHIND), count), np.nan)
        self._of: dict[str, Float] = dict(zip(AHEAD + BEHIND, (*self._ahead, *self._behind), strict=True))
        self._busy: Bool = np.zeros(count, bool)
        self._rides: Bool = np.zeros(count, bool)
        self._may_drive: Bool = np.zeros(count, bool)
        self._is_last: Bool = np.zeros(count, bool)
        self.reached: Int32 = self._released
        """i4[n], as `FleetView` has it."""
        self.cleared: Int32 = self._released
        """i4[n], as `FleetView` has it."""
        self.begin: Int = np.zeros(count, np.int64)
        """i8[n]: what lies ahead of robot i is `corners[begin[i]:end[i]]`."""
        self.end: Int = np.zeros(count, np.int64)
        self.adopt(routes)

    def __len__(self) -> int:
        return len(self.begin)

    def adopt(self, routes: Sequence[Route]) -> None:
        """Continue with routes that begin with what was released of the old ones."""
        self._advance.adopt(routes)
        self.corners = self._advance.tracks.corners
        self._wants_yaw = any(not np.isnan(route.waypoint[:, 2]).all() for route in routes)
        self._watch(np.arange(len(routes)))
        self._released = np.full(len(routes), -1, np.int32)  # all are looked at in the next period

    def update(self, pose: Float, speed: Float, released: Int32, level: Int16) -> None:
        """Take note of estimated poses f8[n,3], speeds f8[n], how many leading segments are released i4[n], and levels
        i2[n].
        """
        x, y = pose[:, 0], pose[:, 1]
        of = self._of
        ax, ay = x - of["arrive_x"], y - of["arrive_y"]
        ux, uy, within = of["arrive_ahead_x"], of["arrive_ahead_y"], of["arrive_within"]
        # Whether it is so is decided later; here it may only be asked too often.
        arrives = ax * ax + ay * ay <= within * within + _SLACK
        arrives |= (ax * ux + ay * uy >= -_SLACK) & (np.abs(ux * ay - uy * ax) <= of["arrive_beside"] + _SLACK)
        arrives |= self._busy
        arrives |= released != self._released
        forward = (x - of["round_x"]) * of["round_ahead_x"] + (y - of["round_y"]) * of["round_ahead_y"]
        cx, cy, beyond = x - of["clear_x"], y - of["clear_y"], of["clear_beyond"]
        self._released = released
        arriving = arrives.nonzero()[0]
        if len(arriving):
            changed = self._advance.arrive(arriving, pose, speed, released, level)
            arrives[:] = False
            arrives[changed] = True
            if len(changed):
                self.reached = frozen_array(self._advance.reached, "i4")
        rounding = (arrives | (forward >= -_SLACK)).nonzero()[0]
        if len(rounding):
            self._advance.go_round(rounding, pose)
            self._look_ahead(rounding)
        leaving = (arrives | (cx * cx + cy * cy >= beyond * beyond)).nonzero()[0]
        if len(leaving):
            self._advance.leave_behind(leaving, pose, released)
            self._look_behind(leaving)

    def rejoin(self, robot: int, x: float, y: float) -> None:
        """Let a robot continue from a point of its released route."""
        self._advance.rejoin(robot, x, y)
        self._watch(np.array([robot]))

    def skip(self, robot: int) -> None:
        """Count the end of a robot's path as reached."""
        self._advance.skip(robot)
        self._watch(np.array([robot]))
        self._busy[robot] = True  # it is looked at in the next period

    def only_turns(self, robot: int) -> bool:
        """Tell whether a robot is where it is to go next, and only its yaw is wrong."""
        return bool(self._advance.only_turn(np.array([robot]))[0])

    def left_behind(self, robot: int, x: float, y: float) -> tuple[tuple[float, float] | None, float]:
        """The vertex that a robot has left to others last, and how far from it a robot at (x, y) must stay."""
        return self._advance.left_behind(robot, x, y)

    def foot(self, pose: Float) -> Float:
        """The nearest point f8[n,2] of each robot's leg of its route."""
        of = self._of
        x, y, dx, dy = of["leg_x"], of["leg_y"], of["leg_dx"], of["leg_dy"]
        along = (pose[:, 0] - x) * dx + (pose[:, 1] - y) * dy
        share = np.minimum(np.maximum(along / of["leg_squared"], 0.0), 1.0)
        foot = np.empty((len(pose), 2))
        foot[:, 0] = x + share * dx
        foot[:, 1] = y + share * dy
        return foot

    def driven(self, pose: Float, foot: Float) -> Bool:
        """Tell bool[n] which robots are to be driven, or turned, on the way to the end of what is released."""
        at_end = np.abs(foot[:, 0] - self._of["end_x"]) <= _SETTLED
        at_end &= np.abs(foot[:, 1] - self._of["end_y"]) <= _SETTLED
        settled = self._is_last & at_end & ~self._is_turned_away(pose)
        driven: Bool = self._may_drive & ~settled & ~self._rides
        return driven

    def under_way(self, pose: Float) -> Bool:
        """Tell bool[n] which robots are to drive on, or to take a yaw; who rides in a lift is not."""
        away: Bool = (self.reached < self._released) | (self._may_drive & self._is_last & self._is_turned_away(pose))
        away &= ~self._rides
        return away

    def _is_turned_away(self, pose: Float) -> Bool:
        if not self._wants_yaw:
            return np.zeros(len(pose), bool)
        error = np.abs(np.remainder(pose[:, 2] - self._of["yaw"] + np.pi, 2 * np.pi) - np.pi)
        away: Bool = error > self._options.yaw_goal_tolerance  # never where any yaw will do, which is NaN
        return away

    @property
    def yaw(self) -> Float:
        """f8[n] to take at the end of what lies ahead, NaN = any."""
        return self._of["yaw"]

    @property
    def speed(self) -> Float:
        """f8[n] m/s allowed on the segment under way."""
        return self._of["speed"]

    def _watch(self, robots: Int) -> None:
        """Look again at robots that something has been told about."""
        self.reached = frozen_array(self._advance.reached, "i4")
        self._look_ahead(robots)
        self._look_behind(robots)

    def _look_ahead(self, robots: Int) -> None:
        advance = self._advance
        first, end = advance.tracks.first_corner[robots], advance.path_end(robots)
        self.begin[robots] = first + np.minimum(advance.leg[robots] + 1, end)
        self.end[robots] = first + end + 1
        self._ahead[:, robots] = advance.ahead(robots, end)
        rides = advance.rides(robots)
        self._rides[robots] = rides
        self._busy[robots] = advance.is_busy(robots) | rides
        self._may_drive[robots] = advance.may_drive(robots)
        self._is_last[robots] = advance.is_last(robots)

    def _look_behind(self, robots: Int) -> None:
        self._behind[:, robots] = self._advance.behind(robots)
        self.cleared = frozen_array(self._advance.cleared, "i4")
