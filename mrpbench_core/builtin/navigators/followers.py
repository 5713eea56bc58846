"""All robots on their routes: what changes rarely is left to each `Follower`, what moves is computed at once."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from mrpbench_core.builtin.navigators.follower import WATCHED, Follower
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
        self.all = [Follower(route, options, clear) for route, clear in zip(routes, clearances.tolist(), strict=True)]
        self._counts: Int32 = np.zeros((2, count), np.int32)
        self._released: Int32 = np.zeros(count, np.int32)
        self._values: Float = np.full((len(WATCHED), count), np.nan)
        self._of: dict[str, Float] = dict(zip(WATCHED, self._values, strict=True))
        self._busy: Bool = np.zeros(count, bool)
        self._rides: Bool = np.zeros(count, bool)
        self._may_drive: Bool = np.zeros(count, bool)
        self._is_last: Bool = np.zeros(count, bool)
        self.begin: Int = np.zeros(count, np.int64)
        """i8[n]: what lies ahead of robot i is `corners[begin[i]:end[i]]`."""
        self.end: Int = np.zeros(count, np.int64)
        self.adopt(routes)

    def adopt(self, routes: Sequence[Route]) -> None:
        """Continue with routes that begin with what was released of the old ones."""
        first = 0
        for follower, route in zip(self.all, routes, strict=True):
            follower.adopt(route, first)
            first += len(follower.corners)
        self.corners: Float = np.concatenate([np.empty((0, 2)), *(follower.corners for follower in self.all)])
        self._wants_yaw = any(not np.isnan(route.waypoint[:, 2]).all() for route in routes)
        self._watch(range(len(self.all)))
        self._released = np.full(len(self.all), -1, np.int32)  # all are looked at in the next period

    def update(self, pose: Float, speed: Float, released: Int32, level: Int16) -> None:
        """Take note of estimated poses f8[n,3], speeds f8[n], how many leading segments are released i4[n], and levels
        i2[n].
        """
        x, y = pose[:, 0], pose[:, 1]
        of = self._of
        ax, ay = x - of["arrive_x"], y - of["arrive_y"]
        ux, uy, within = of["arrive_ahead_x"], of["arrive_ahead_y"], of["arrive_within"]
        changes = ax * ax + ay * ay <= within * within + _SLACK  # `update` decides; here it may only be asked too often
        changes |= (ax * ux + ay * uy >= -_SLACK) & (np.abs(ux * ay - uy * ax) <= of["arrive_beside"] + _SLACK)
        forward = (x - of["round_x"]) * of["round_ahead_x"] + (y - of["round_y"]) * of["round_ahead_y"]
        changes |= forward >= -_SLACK
        cx, cy, beyond = x - of["clear_x"], y - of["clear_y"], of["clear_beyond"]
        changes |= cx * cx + cy * cy >= beyond * beyond
        changes |= self._busy
        changes |= released != self._released
        self._released = released
        changed = changes.nonzero()[0].tolist()
        for robot in changed:
            px, py, yaw = pose[robot].tolist()
            self.all[robot].update(px, py, yaw, float(speed[robot]), int(released[robot]), int(level[robot]))
        if changed:
            self._watch(changed)

    def rejoin(self, robot: int, x: float, y: float) -> None:
        """Let a robot continue from a point of its released route."""
        self.all[robot].rejoin(x, y)
        self._watch([robot])

    def skip(self, robot: int) -> None:
        """Count the end of a robot's path as reached."""
        self.all[robot].skip()
        self._watch([robot])
        self._busy[robot] = True  # it is looked at in the next period

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

    def _watch(self, robots: Iterable[int]) -> None:
        for robot in robots:
            follower = self.all[robot]
            self._values[:, robot] = follower.watched()
            self._busy[robot], self._rides[robot] = follower.is_busy, follower.rides
            self._may_drive[robot] = follower.may_drive
            self._is_last[robot] = follower.is_last
            self.begin[robot], self.end[robot] = follower.path
            self._counts[:, robot] = follower.reached, follower.cleared
        self.reached: Int32 = frozen_array(self._counts[0], "i4")
        """i4[n], as `FleetView` has it."""
        self.cleared: Int32 = frozen_array(self._counts[1], "i4")
