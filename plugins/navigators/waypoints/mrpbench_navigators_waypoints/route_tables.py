"""The routes of a fleet as robots drive them: without waits, and with all that stays the same on the way in tables."""

from collections.abc import Sequence
from typing import Any

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.execution.route import Route, Routes, last_moves

SLACK = 1e-6
"""metres."""
BACK = 2.4
"""Radians; a path that turns by more leads back along itself, as where a robot makes room for another one."""
USUAL = 0.10
"""metres: the default of the tolerance of waypoints."""
FINE = 0.02
"""metres: a smaller tolerance is not asked of controllers."""
STRAIGHT = 0.3
"""radians: a corner at which the direction changes by less is not a bend."""


_TABLES = (
    *("first", "last", "goal", "first_corner", "last_corner", "corner", "level", "speed", "yaw", "waiting_yaw"),
    *("is_wait", "arrival", "corners", "step", "normal", "clearance", "distance", "is_short", "stop", "lift"),
)


@attrs.frozen(kw_only=True)
class ArrivalRules:
    """When a waypoint counts as reached; the options of the navigator `waypoints`, by their names."""

    stops: bool
    """Robots stop at every waypoint and turn to the next one."""
    waypoint_tolerance: float
    passing_tolerance: float
    """metres from a waypoint at which a robot passes it."""
    xy_goal_tolerance: float
    yaw_goal_tolerance: float
    stateful: bool
    trans_stopped_velocity: float = np.inf
    """m/s, and below rad/s, up to which a robot stands at the end of its path; inf = it may move."""
    rot_stopped_velocity: float = np.inf
    turn_ahead: bool = False
    """Robots that wait turn to the next waypoint."""


class RouteTables:
    """Tables of W waypoints and C corners, robot after robot.

    A robot drives along its corners: the waypoints that differ from the one before. Waits are segments without length,
    and between two levels the lift drives. Leg i leads from corner i to corner i + 1.

    Args:
        routes: one per robot.
        rules: when a waypoint counts as reached.
        clearances: f8[n] metres at which each robot leaves room for any other.
        beyond_bends: paths end where they turn back, not at bends.
    """

    def __init__(self, routes: Sequence[Route], rules: ArrivalRules, clearances: Float, beyond_bends: bool) -> None:
        self._least_turn = BACK if beyond_bends else STRAIGHT
        joined = Routes.of(routes)
        sizes, waypoint = joined.size, joined.waypoint
        self.first = joined.first[:-1]
        """i8[n]: the waypoints of robot i are the rows from `first[i]` on."""
        self.last = sizes - 1
        """i8[n]: the last waypoint of robot i is the row `first[i] + last[i]`."""
        last_move = last_moves(joined)
        self.goal: Int = np.maximum(last_move, np.minimum(self.last, 1))
        """i8[n]: robot i arrives at the row `first[i] + goal[i]`. Only waits follow, which are reached at once, so that
        a new plan that only adds waits changes nothing."""
        self.level = joined.level
        """i2[W]."""
        self.speed: Float = joined.speed.copy()
        self.speed[self.first + self.last] = np.inf
        """f8[W] m/s allowed from each waypoint on."""
        begins = np.zeros(len(waypoint), bool)
        begins[self.first] = True
        x, y, _ = waypoint.T
        moves = np.append(True, (x[1:] != x[:-1]) | (y[1:] != y[:-1]))[: len(waypoint)]
        same_level = np.append(True, self.level[1:] == self.level[:-1])[: len(waypoint)]
        is_corner = begins | (moves & same_level)
        row = np.cumsum(is_corner) - 1
        self.corners: Float = waypoint[:, :2].take(is_corner.nonzero()[0], axis=0)
        """f8[C,2] x, y."""
        self.first_corner: Int = row[self.first]
        """i8[n]: the corners of robot i are the rows from `first_corner[i]` on."""
        self.last_corner: Int = row[self.first + self.last] - self.first_corner
        """i8[n]: the last corner of robot i is the row `first_corner[i] + last_corner[i]`."""
        self.corner: Int = row - np.repeat(self.first_corner, sizes)
        """i8[W]: the corner of its robot at which each waypoint lies."""
        self.is_wait: Bool = ~is_corner
        """bool[W]: the waypoint is at the place of the one before, and is not the goal of its route."""
        self.is_wait[self.first + self.goal] = False
        enters_lift = np.zeros(len(self.corners), bool)
        enters_lift[row[:-1][~same_level[1:] & ~begins[1:]]] = True
        heading = self._add_legs(np.repeat(clearances, self.last_corner + 1), enters_lift)
        rests = np.append(self.is_wait[1:], False) & is_corner
        self.arrival = self._arrival(waypoint, row, heading, rests, rules)
        """f8[W,6] x, y, tolerance, direction of the way there (NaN: passing does not count) and tolerance of passing:
        when each waypoint is reached. The goal, and a wait before the first corner, are
        not reached by passing them."""
        self.tolerance: float = float(self.arrival[:, 2].min())
        """The least of these tolerances: controllers have to come as near to the ends of paths."""
        self.yaw: Float = waypoint[:, 2].copy()
        """f8[W] prescribed at each waypoint, NaN = any. A robot that stops at each turns there to the next one."""
        self.yaw[self.first + self.goal] = self.yaw[self.first + self.last]  # where it rests, not as it drives there
        self.waiting_yaw = self.yaw
        """f8[W] for a robot that waits at a waypoint, NaN = any."""
        if rules.stops or rules.turn_ahead:
            onward = np.arctan2(heading[1], heading[0])[row]  # NaN at the last
            self.waiting_yaw = np.where(np.isnan(self.yaw), onward, self.yaw)
        if rules.stops:
            self.yaw = self.waiting_yaw

    def arrays(self) -> dict[str, Any]:
        """The tables by name, as `mrpbench_native.navigation` takes them."""
        return {name: np.ascontiguousarray(getattr(self, name)) for name in _TABLES}

    def _add_legs(self, clearance: Float, enters_lift: Bool) -> Float:
        """Fill the tables of the corners, given the clearance f8[C] there, and whether bool[C] a robot enters a lift;
        returns the direction f8[2,C] of each leg, NaN after the last corner of a robot.
        """
        corners, count = self.corners.T, len(self.corners)
        is_last = np.zeros(count, bool)
        is_last[self.first_corner + self.last_corner] = True
        after = np.roll(np.arange(count), -1)
        following = corners.take(after, axis=1)
        step = np.where(is_last, 0, following - corners)
        length = np.hypot(*step)
        heading: Float = step / np.where(is_last, np.nan, length)
        self.step: Float = _table(*step)
        """f8[C,2] from each corner along its leg; a robot's last one has no length."""
        self.normal: Float = _table(*(heading + heading.take(after, axis=1)))
        """f8[C,2] the direction in which a robot rounds the corner at the end of each leg, NaN = it does not."""
        self.clearance: Float = clearance - SLACK
        """f8[C] the distance at which each corner is cleared."""
        self.distance: Float = np.cumsum(length) - length
        """f8[C] metres along the legs of all robots up to each corner."""
        self.is_short: Bool = length <= clearance + FINE
        """bool[C]: the leg is hardly longer than the clearance."""
        cosine = (heading * np.roll(heading, 1, axis=1)).sum(axis=0)  # of the turn at each corner, NaN at both ends
        self.stop: Int = self._first_from_each((cosine < np.cos(self._least_turn)) | is_last)
        """i8[C]: the first corner of its robot, from each on, at which its path ends, or the last."""
        self.lift: Int = self._first_from_each(enters_lift | is_last)
        """i8[C]: the first corner of its robot, from each on, at which it enters a lift, or the last."""
        return heading

    def _first_from_each(self, is_one: Bool) -> Int:
        """The first corner i8[C] of its robot, from each on, where `is_one` bool[C]."""
        count = len(is_one)
        following = np.minimum.accumulate(np.where(is_one, np.arange(count), count)[::-1])[::-1]
        corner: Int = following - np.repeat(self.first_corner, self.last_corner + 1)
        return corner

    def _arrival(self, waypoint: Float, row: Int, heading: Float, rests: Bool, rules: ArrivalRules) -> Float:
        """The table `arrival`; `rests` bool[W]: a robot waits at the waypoint."""
        goal = self.first + self.goal
        leaving = self._leaving(rules.waypoint_tolerance)[row]
        into = np.roll(heading, 1, axis=1).take(row, axis=1)  # NaN at each first corner
        arrival = _table(*waypoint[:, :2].T, rules.waypoint_tolerance, *into, into[0] * 0 + rules.passing_tolerance)
        arrival[rests, 2] = np.minimum(rules.waypoint_tolerance, leaving[rests])
        arrival[goal, 2] = np.minimum(rules.xy_goal_tolerance, leaving[goal])
        arrival[goal, 3:] = np.nan
        return arrival

    def _leaving(self, stated: float) -> Float:
        """Metres f8[C] from each corner within which a robot has cleared the corner before: others may wait for that,
        and a robot that rests there would let them wait for ever. A tolerance `stated` beyond the usual one is kept.
        """
        least = stated if stated > USUAL else FINE
        room = np.roll(np.where(self.is_short, np.inf, np.sqrt((self.step**2).sum(axis=1)) - self.clearance), 1)
        room[self.first_corner] = np.inf
        return np.maximum(room, least)


def _table(first: Float, *others: Float | float) -> Float:
    """An array f8[k,c] of c columns; k values of a column are written faster than c values of a row."""
    columns = (first, *others)
    table: Float = np.empty((len(first), len(columns)))
    for index, column in enumerate(columns):
        table[:, index] = column
    return table
