"""The routes of a fleet as robots drive them: without waits, and with all that stays the same on the way in tables."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from mrpbench_core.model.arrays import Bool, Float, Int
from mrpbench_core.model.execution import Route

if TYPE_CHECKING:
    from mrpbench_core.builtin.navigators.waypoints import Waypoints

STRAIGHT = 0.3
"""radians: a corner of less is no bend."""
SLACK = 1e-6
"""metres."""


class Tracks:
    """Tables of W waypoints and C corners, robot after robot.

    A robot drives along its corners: the waypoints that differ from the one before. Waits are segments without length,
    and in a lift it is the lift that drives. Leg i leads from corner i to corner i + 1.

    Args:
        routes: one per robot.
        options: of the navigator.
        clearances: f8[n] metres at which each robot leaves room for any other.
    """

    def __init__(self, routes: Sequence[Route], options: "Waypoints", clearances: Float) -> None:
        sizes = np.array([len(route.waypoint) for route in routes], np.int64)
        waypoint = np.concatenate([np.empty((0, 3)), *(route.waypoint for route in routes)])
        self.first = np.cumsum(sizes) - sizes
        """i8[n]: robot i's waypoints are the rows from `first[i]` on."""
        self.last = sizes - 1
        """i8[n]: and the last of them is `first[i] + last[i]`."""
        self.level = np.concatenate([np.empty(0, np.int16), *(route.level for route in routes)])
        """i2[W]."""
        self.speed: Float = np.concatenate([np.empty(0), *(np.append(route.speed, np.inf) for route in routes)])
        """f8[W] m/s allowed from each waypoint on."""
        begins = np.zeros(len(waypoint), bool)
        begins[self.first] = True
        moves = np.append(True, (waypoint[1:, :2] != waypoint[:-1, :2]).any(axis=1))[: len(waypoint)]
        stays = np.append(True, self.level[1:] == self.level[:-1])[: len(waypoint)]
        is_corner = begins | (moves & stays)
        row = np.cumsum(is_corner) - 1
        self.corners: Float = waypoint[is_corner, :2]
        """f8[C,2]."""
        self.first_corner: Int = row[self.first]
        """i8[n]: robot i's corners are the rows from `first_corner[i]` on."""
        self.last_corner: Int = row[self.first + self.last] - self.first_corner
        """i8[n]: and the last of them is `first_corner[i] + last_corner[i]`."""
        self.corner: Int = row - np.repeat(self.first_corner, sizes)
        """i8[W]: which of its robot's corners each waypoint is at."""
        self.is_wait: Bool = ~is_corner
        """bool[W]: the waypoint is where the one before is, and not the last of its route."""
        self.is_wait[self.first + self.last] = False
        self._lay_legs(np.repeat(clearances, self.last_corner + 1))
        ahead = np.column_stack([self._ahead, self._ahead[:, 0] * 0])
        into = np.concatenate([np.full((1, 3), np.nan), ahead[:-1]])[: len(ahead)]  # NaN at the first corner of each
        into[:, 2] += options.waypoint_tolerance
        within = np.full((len(waypoint), 1), options.waypoint_tolerance)
        within[self.first + self.last] = options.xy_goal_tolerance
        self.arrive: Float = np.column_stack([waypoint[:, :2], within, into[row]])
        """f8[W,6]: x, y, distance within which each waypoint is reached; direction of the way to it, and how far beside
        it may be passed: NaN at the last, and at waits before the first corner."""
        self.arrive[self.first + self.last, 3:] = np.nan
        self.yaw: Float = waypoint[:, 2].copy()
        """f8[W] prescribed at each waypoint, NaN = any. Who stops at each turns there to where the next one lies."""
        if options.waypoints == "stop":
            free = np.isnan(self.yaw)
            self.yaw[free] = np.arctan2(self._ahead[row[free], 1], self._ahead[row[free], 0])  # NaN at the last

    def _lay_legs(self, clearance: Float) -> None:
        corners, count = self.corners, len(self.corners)
        is_last = np.zeros(count, bool)
        is_last[self.first_corner + self.last_corner] = True
        step = np.zeros((count, 2))
        step[:-1] = np.diff(corners, axis=0)
        step[is_last] = 0
        length = np.hypot(step[:, 0], step[:, 1])
        self._ahead = step / np.where(is_last, np.nan, length)[:, None]
        self.leg: Float = np.column_stack([corners, step, np.maximum((step * step).sum(axis=1), 1e-300)])
        """f8[C,5]: x, y, way in x and y, and the square of its length; the last has none: its point is the nearest."""
        after = np.roll(np.arange(count), -1)
        self.round: Float = np.column_stack([corners[after], self._ahead + self._ahead[after]])
        """f8[C,4]: x, y of the corner after each leg, and the sum of the directions of this leg and the next."""
        self.clear: Float = np.column_stack([corners, clearance - SLACK])
        """f8[C,3]: x, y of each corner, and how far from it there is room for others."""
        self.is_short: Bool = length <= clearance + SLACK
        """bool[C]: each leg is no longer than that."""
        yaw = np.arctan2(self._ahead[:, 1], self._ahead[:, 0])
        turn = np.abs(np.remainder(yaw - np.roll(yaw, 1) + np.pi, 2 * np.pi) - np.pi)
        bends = np.where((turn > STRAIGHT) | is_last, np.arange(count), count)  # no turn is NaN at either end
        following = np.minimum.accumulate(bends[::-1])[::-1]
        self.bend: Int = following - np.repeat(self.first_corner, self.last_corner + 1)
        """i8[C]: the first of its robot's corners, from each on, at which the direction changes, or the last."""
