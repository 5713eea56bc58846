"""The progress of each robot on its route: the waypoints reached, the vertices cleared, and the current leg."""

import math
from collections.abc import Sequence

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int16, Int32
from mrpbench_core.model.execution.route import Route
from mrpbench_navigators_waypoints.route_checks import SLACK
from mrpbench_navigators_waypoints.route_tables import ArrivalRules, RouteTables

_STANDING = 0.01
"""m/s below which a robot stands still."""
_LEGS_AHEAD = np.arange(6)
"""Legs of a route among which the nearest to a robot is looked for, its own first."""
_SEARCH = 1.5
"""metres along the route up to which it is looked for (Nav2: half the width of the costmap)."""
_NEARER = 0.01
"""metres by which a leg ahead has to be nearer than the robot's own."""


class RouteProgress:
    """Counts the progress of robots along their routes.

    Nothing changes for a robot until it reaches a waypoint, rounds a corner, clears a vertex, or more is released to
    it: only then have these methods to be called.

    Args:
        routes: one per robot.
        rules: when a waypoint counts as reached.
        clearances: f8[n] metres at which each robot leaves room for any other.
    """

    def __init__(self, routes: Sequence[Route], rules: ArrivalRules, clearances: Float) -> None:
        self._rules, self._clearances = rules, clearances
        count = len(routes)
        self.reached: Int = np.zeros(count, np.int64)
        """i8[n]: number of leading segments that each robot has completed."""
        self.cleared: Int = np.zeros(count, np.int64)
        """i8[n]: number of leading segments whose start each robot has left."""
        self.leg: Int = np.zeros(count, np.int64)
        """i8[n]: each robot drives from this corner of its route to the next one."""
        self.adopt(routes)

    def adopt(self, routes: Sequence[Route], cut: Int32 | None = None) -> None:
        """Continue with routes that begin with the released parts of the old ones, but for `cut` i4[n] segments."""
        if cut is not None:
            self.leg = np.maximum(self.leg - self._corner(slice(None), cut.astype(np.int64)), 0)
            self.reached = np.maximum(self.reached - cut, 0)
            self.cleared = np.maximum(self.cleared - cut, 0)
        self.tables = RouteTables(routes, self._rules, self._clearances)
        self.released: Int = self.reached.copy()
        """i8[n]: as far as each robot may go now. A robot that stops at waypoints goes to the next one first."""
        self.end: Int = self._corner(slice(None), self.released)
        """i8[n]: the corner at which that ends."""
        self.halting: Bool = np.zeros(len(routes), bool)
        """bool[n]: the robot has reached a waypoint to stop at, and still moves."""
        self.at_goal: Bool = np.zeros(len(routes), bool)
        """bool[n]: the robot is at a place where it may have to turn before that counts as reached."""

    def count_reached(self, robots: Int, pose: Float, twist: Float, released: Int32, level: Int16) -> Int:
        """Count the waypoints that some robots have reached.

        Args:
            robots: i8[k].
            pose: f8[n,3] estimated, of the fleet.
            twist: f8[n,2] m/s, rad/s.
            released: i4[n] number of leading segments released.
            level: i2[n].

        Returns:
            The robots for which anything has changed.
        """
        before, some, stops = self._state(robots), robots, self._rules.stops
        if stops:
            moving = np.abs(twist[:, 0]) > _STANDING
            self.halting[robots] &= moving[robots]
            some = robots[~self.halting[robots]]
        while len(some):
            some = some[self.reached[some] < released[some]]
            if not len(some):
                break
            some = some[self._have_arrived(some, pose, twist, level)]
            self.reached[some] += 1
            self.at_goal[some] = False
            if stops:
                self.halting[some] = moving[some]
                some = some[~moving[some]]
        allowed = released[robots].astype(np.int64)
        self.released[robots] = np.minimum(self.reached[robots] + 1, allowed) if stops else allowed
        self.end[robots] = self._corner(robots, self.released[robots])
        changed: Int = robots[(self._state(robots) != before).any(axis=0)]
        return changed

    def count_corners(self, robots: Int, pose: Float) -> None:
        """Let some robots go on to the next leg for each corner that they have rounded."""
        some = robots[self.leg[robots] + 1 < self.end[robots]]
        while len(some):
            some = some[self._have_rounded(some, pose)]
            self.leg[some] += 1
            some = some[self.leg[some] + 1 < self.end[some]]

    def count_passed(self, pose: Float) -> Int:
        """Let robots go on to the nearest leg of those ahead, if they are within the tolerance of it.

        Waypoints before that leg are passed, as Nav2 prunes a path up to its nearest pose. So a robot that has cut
        corners misses nothing. The end of the released part is never passed, nor is a lift.

        Args:
            pose: f8[n,3] estimated, of the fleet.

        Returns:
            The robots for which anything has changed.
        """
        tables = self.tables
        last = np.minimum(self.end, tables.lift[tables.first_corner + self.leg]) - 1
        robots = (self.leg < last).nonzero()[0]
        legs = self.leg[robots, None] + _LEGS_AHEAD
        known = np.minimum(legs, last[robots, None])
        row = (tables.first_corner[robots, None] + known).ravel()
        place, begin = np.repeat(pose[robots, :2], len(_LEGS_AHEAD), axis=0), tables.legs.take(row)
        nearest = begin.nearest_points(*place.T)
        along = (tables.distance[row] + np.hypot(*(nearest.T - (begin.x, begin.y)))).reshape(legs.shape)
        gap = np.hypot(*(place - nearest).T).reshape(legs.shape)
        gap[:, 1:] += _NEARER
        gap[(legs > known) | (along - along[:, :1] > _SEARCH)] = np.inf
        choice = gap.argmin(axis=1)
        passed = (choice > 0) & (gap.min(axis=1, initial=np.inf) <= self._rules.passing_tolerance)
        for robot, leg in zip(robots[passed].tolist(), (self.leg[robots] + choice)[passed].tolist(), strict=True):
            self._count_up_to(robot, leg)
            self.leg[robot] = leg
            self.at_goal[robot] = False
        changed: Int = robots[passed]
        return changed

    def count_cleared(self, robots: Int, pose: Float, released: Int32) -> None:
        """Count the vertices that some robots have cleared, up to the segment that each is on."""
        furthest = np.minimum(released, self.reached + 1)
        some = robots[self.cleared[robots] < furthest[robots]]
        while len(some):
            some = some[self._have_cleared(some, pose)]
            self.cleared[some] += 1
            some = some[self.cleared[some] < furthest[some]]

    def rejoin(self, robot: int, x: float, y: float) -> None:
        """Let a robot continue from a point of its released route, as if it had reached all before."""
        leg, end = int(self.leg[robot]), int(self.end[robot])
        legs = np.arange(leg, max(end, leg + 1))
        nearest = self.tables.legs.take(self.tables.first_corner[robot] + legs).nearest_points(x, y)
        gaps = [math.dist((x, y), point) for point in nearest.tolist()]
        self.leg[robot] = legs[gaps.index(min(gaps))]
        self._count_up_to(robot, int(self.leg[robot]))

    def skip_to(self, robot: int, corner: int) -> None:
        """Count a corner of a robot's route as reached, from wherever the robot is."""
        self._count_up_to(robot, corner)
        self.leg[robot] = max(int(self.leg[robot]), min(corner, int(self.tables.last_corner[robot]) - 1))
        self.at_goal[robot] = False

    def cleared_vertex(self, robot: int, x: float, y: float) -> tuple[tuple[float, float] | None, float]:
        """The vertex that a robot cleared last, and the distance that it must keep from there when it is at x, y."""
        if not self.cleared[robot]:
            return None, 0.0
        at = self.tables.first[robot] + self.cleared[robot] - 1
        vertex = float(self.tables.arrival.x[at]), float(self.tables.arrival.y[at])
        return vertex, min(float(self._clearances[robot]), math.dist((x, y), vertex)) - SLACK

    def only_turns(self, robot: int) -> bool:
        """Tell whether a robot is at the place to go to next, and has only to turn there."""
        return bool(self.at_goal[robot] and self.reached[robot] < self.released[robot])

    def only_turn(self) -> Bool:
        """Tell bool[n] which robots are at the place to go to next, and have only to turn there."""
        turn: Bool = self.at_goal & (self.reached < self.released)
        return turn

    def _state(self, robots: Int) -> Int:
        state: Int = np.array([table[robots] for table in (self.reached, self.released, self.halting, self.at_goal)])
        return state

    def _corner(self, robots: Int | slice, waypoint: Int) -> Int:
        """The corners i8[k] at which waypoints i8[k] of some robots lie."""
        corner: Int = self.tables.corner[self.tables.first[robots] + waypoint]
        return corner

    def _count_up_to(self, robot: int, corner: int) -> None:
        """Count the released segments up to a corner as reached."""
        first = int(self.tables.first[robot])
        ahead = self.tables.corner[first + int(self.reached[robot]) + 1 : first + int(self.released[robot]) + 1]
        self.reached[robot] += int(np.searchsorted(ahead, corner, side="right"))

    def _have_arrived(self, robots: Int, pose: Float, twist: Float, level: Int16) -> Bool:
        """Tell bool[k] which robots are at the end of the first segment that they have not yet completed."""
        tables, rules = self.tables, self._rules
        goal = tables.first[robots] + self.reached[robots] + 1
        near = tables.arrival.take(goal).holds(pose[robots, 0], pose[robots, 1])
        near |= tables.is_wait[goal]
        here = level[robots] == tables.level[goal]
        ends = here & (self.reached[robots] + 1 == tables.goal[robots]) if not rules.stops else here
        if ends.any():
            near[ends] |= self.at_goal[robots[ends]] & rules.stateful
            self.at_goal[robots[ends]] = near[ends]
            near[ends] &= self._face(pose[robots[ends], 2], tables.yaw[goal[ends]])
            stopped = np.array([rules.trans_stopped_velocity, rules.rot_stopped_velocity])
            near[ends] &= (np.abs(twist[robots[ends]]) <= stopped).all(axis=1)
        arrived: Bool = near & here
        return arrived

    def _face(self, yaw: Float, wanted: Float) -> Bool:
        """Tell bool[k] whether each yaw is the wanted one, within the tolerance; NaN = any yaw is."""
        error = np.abs(np.remainder(yaw - wanted + np.pi, 2 * np.pi) - np.pi)
        faces: Bool = np.isnan(wanted) | (error <= self._rules.yaw_goal_tolerance)
        return faces

    def _have_rounded(self, robots: Int, pose: Float) -> Bool:
        """Tell bool[k] which robots have reached the next corner and rounded it."""
        leg = self.leg[robots]
        corner = self.tables.rounding.take(self.tables.first_corner[robots] + leg)
        rounded = corner.holds(pose[robots, 0], pose[robots, 1])
        return rounded & (self._corner(robots, self.reached[robots]) > leg)

    def _have_cleared(self, robots: Int, pose: Float) -> Bool:
        """Tell bool[k] which robots' footprints have left the start of the first segment that is not yet cleared.

        A segment no longer than the clearance is cleared when it is reached: the robot may have to wait at its end, and
        the rules of the problem say what may stand that close. Waits are cleared with the move that ends them.
        """
        tables, corner = self.tables, self._corner(robots, self.cleared[robots])
        at, row = self._corner(robots, self.reached[robots]), tables.first_corner[robots] + corner
        left = tables.clearing.take(row).holds(pose[robots, 0], pose[robots, 1])
        left |= tables.is_short[row] & (at > corner)
        cleared: Bool = left & (corner < tables.last_corner[robots]) & (at >= corner)
        return cleared
