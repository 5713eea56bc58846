"""All robots on their routes: a cheap check of the fleet in every control period, more work only where it holds."""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int16, Int32, read_only
from mrpbench_core.model.execution.route import Route, Routes
from mrpbench_navigators_waypoints.route_ahead import RouteAhead
from mrpbench_navigators_waypoints.route_progress import RouteProgress
from mrpbench_navigators_waypoints.route_tables import ArrivalRules

_SETTLED = 0.02
"""metres from the end of the released part within which a robot that has reached it need not drive on."""


class RouteFollower:
    """Follows one route per robot.

    Args:
        routes: one per robot.
        rules: when a waypoint counts as reached.
        clearances: f8[n] metres at which each robot leaves room for any other.
        beyond_bends: what lies ahead of a robot ends where its released part ends, not at the next bend. Robots then
            cut corners and pass waypoints from some distance.
    """

    def __init__(
        self, routes: Sequence[Route], rules: ArrivalRules, clearances: Float, beyond_bends: bool = False
    ) -> None:
        count = len(routes)
        self._yaw_goal_tolerance, self._turn_ahead = rules.yaw_goal_tolerance, rules.turn_ahead
        self._progress = RouteProgress(routes, rules, clearances)
        self._ahead = RouteAhead(self._progress, beyond_bends)
        self._beyond_bends = beyond_bends
        self._released: Int32 = np.zeros(count, np.int32)
        self.reached: Int32 = self._released
        """i4[n], as in `FleetView`."""
        self.cleared: Int32 = self._released
        """i4[n], as in `FleetView`."""
        self._away = self._drives = np.zeros(count, bool)
        """bool[n]: robots that have not reached all that is released, and those that may have to drive or turn."""
        self._finish = False
        """Whether any robot has reached all that is released, and drives on to its very end."""
        self.adopt(routes)

    def __len__(self) -> int:
        return len(self.reached)

    def adopt(self, routes: Sequence[Route], cut: Int32 | None = None) -> None:
        """Continue with routes that begin with the released parts of the old ones, but for `cut` i4[n] segments."""
        self._progress.adopt(routes, cut)
        self.corners = self._progress.tables.corners
        self._wants_yaw = self._turn_ahead or not np.isnan(Routes.of(routes).waypoint[:, 2]).all()
        self._refresh(np.arange(len(routes)))
        self._released = np.full(len(routes), -1, np.int32)  # so that the next `update` looks at all robots

    def update(self, pose: Float, twist: Float, released: Int32, level: Int16) -> None:
        """Count what robots have reached, rounded and cleared.

        Args:
            pose: f8[n,3] estimated.
            twist: f8[n,2] m/s, rad/s.
            released: i4[n] number of leading segments released.
            level: i2[n].
        """
        due, rounded, cleared = self._ahead.checks.hold(pose[:, 0], pose[:, 1])
        due |= self._ahead.is_busy
        if released is not self._released:
            due |= released != self._released
            self._released = released
        some = due | rounded | cleared
        if not np.count_nonzero(some) and not self._beyond_bends:  # the usual case in every control period
            return
        reaching = due.nonzero()[0]
        if len(reaching):
            changed = self._progress.count_reached(reaching, pose, twist, released, level)
            due[:] = False
            due[changed] = True
            if len(changed):
                self.reached = _int32(self._progress.reached)
        if self._beyond_bends:
            passed = self._progress.count_passed(pose)
            due[passed] = True
            if len(passed):
                self.reached = _int32(self._progress.reached)
        rounding = (due | rounded).nonzero()[0]
        if len(rounding):
            self._progress.count_corners(rounding, pose)
            self._ahead.refresh(rounding)
        clearing = (due | cleared).nonzero()[0]
        if len(clearing):
            self._progress.count_cleared(clearing, pose, released)
            self._ahead.refresh_clearance(clearing)
            self.cleared = _int32(self._progress.cleared)
        if len(reaching) or len(rounding):
            self._settle()

    def rejoin(self, robot: int, x: float, y: float) -> None:
        """Let a robot continue from a point of its released route."""
        self._progress.rejoin(robot, x, y)
        self._refresh(np.array([robot]))

    def skip_path_end(self, robot: int) -> None:
        """Count the end of a robot's path as reached."""
        self._progress.skip_to(robot, self._ahead.path_end(robot))
        self._refresh(np.array([robot]))
        self._ahead.is_busy[robot] = True  # so that the next `update` looks at it

    def segment_ends(self, robots: Int, segments: Int) -> tuple[Float, Float]:
        """The places f8[k,2] at which segments i8[k] of robots i8[k] start and end."""
        tables = self._progress.tables
        row = tables.first[robots] + segments
        start, end = (np.column_stack([tables.arrival.x[at], tables.arrival.y[at]]) for at in (row, row + 1))
        return start, end

    def only_turns(self, robot: int) -> bool:
        """Tell whether a robot is at the place to go to next, and has only to turn there."""
        return self._progress.only_turns(robot)

    def only_turn(self) -> Bool:
        """Tell bool[n] which robots are at the place to go to next, and have only to turn there."""
        return self._progress.only_turn()

    def cleared_vertex(self, robot: int, x: float, y: float) -> tuple[tuple[float, float] | None, float]:
        """The vertex that a robot cleared last, and the distance that it must keep from there when it is at x, y."""
        return self._progress.cleared_vertex(robot, x, y)

    def foot(self, pose: Float) -> Float:
        """The nearest point f8[n,2] of each robot's leg of its route."""
        return self._ahead.leg.nearest_points(pose[:, 0], pose[:, 1])

    def driven(self, pose: Float, foot: Float) -> Bool:
        """Tell bool[n] which robots a controller has to drive, or turn, on the way to the end of the released part.

        As `under_way`, it may return the same array again.
        """
        if not self._finish:
            return self._drives
        gap = np.abs(foot - self._ahead.path_ends) <= _SETTLED
        settled = self._ahead.is_finishing & gap[:, 0] & gap[:, 1]
        if self._wants_yaw:
            settled &= ~self._is_turned_away(pose)
        driven: Bool = self._drives & ~settled
        return driven

    def under_way(self, pose: Float) -> Bool:
        """Tell bool[n] which robots have to drive on, or to take a yaw; a robot in a lift has not.

        The same array is returned again while nothing has changed; it must not be written to.
        """
        if not (self._wants_yaw and self._finish):
            return self._away
        away: Bool = self._away | (self._drives & self._ahead.is_finishing & self._is_turned_away(pose))
        return away

    def _is_turned_away(self, pose: Float) -> Bool:
        error = np.abs(np.remainder(pose[:, 2] - self.yaw + np.pi, 2 * np.pi) - np.pi)
        away: Bool = error > self._yaw_goal_tolerance  # false for NaN, where any yaw will do
        return away

    @property
    def begin(self) -> Int:
        """i8[n]: the waypoints ahead of robot i are `corners[begin[i]:end[i]]`."""
        return self._ahead.begin

    @property
    def end(self) -> Int:
        """i8[n], see `begin`."""
        return self._ahead.end

    @property
    def yaw(self) -> Float:
        """f8[n] to take at the end of what lies ahead, NaN = any."""
        return self._ahead.yaw

    @property
    def speed(self) -> Float:
        """f8[n] m/s allowed on the segment under way."""
        return self._ahead.speed

    def _refresh(self, robots: Int) -> None:
        """Read all about robots whose progress was changed from outside."""
        self._ahead.refresh(robots)
        self._ahead.refresh_clearance(robots)
        self.reached, self.cleared = _int32(self._progress.reached), _int32(self._progress.cleared)
        self._settle()

    def _settle(self) -> None:
        """Note what follows from progress alone, and not from poses."""
        ahead, drives = self._ahead, ~self._ahead.uses_lift
        self._away = (self.reached < self._released) & drives
        self._drives = ahead.may_drive & drives
        self._finish = bool(np.count_nonzero(ahead.is_finishing))


def _int32(counts: Int) -> Int32:
    """A read-only copy of counts of segments."""
    return read_only(counts.astype(np.int32))
