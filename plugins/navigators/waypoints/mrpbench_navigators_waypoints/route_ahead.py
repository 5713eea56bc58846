"""The next waypoints of each robot, as named arrays that are refreshed when its progress changes."""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_navigators_waypoints.route_checks import FleetChecks, Legs
from mrpbench_navigators_waypoints.route_progress import RouteProgress


class RouteAhead:
    """The values to check for each of n robots until it reaches, rounds or clears a waypoint.

    Args:
        progress: how far the robots are.
        beyond_bends: the path of a robot ends where its released part ends or it turns back, not at the next bend.
    """

    def __init__(self, progress: RouteProgress, beyond_bends: bool) -> None:
        self._progress, self._beyond_bends = progress, beyond_bends
        count = len(progress.reached)
        self.checks = FleetChecks(count)
        """Whether each robot reaches the next waypoint that is released, rounds the corner at the end of its leg, which
        it has reached, and clears the next vertex."""
        self.leg = Legs.unset(count)
        self.begin: Int = np.zeros(count, np.int64)
        """i8[n]: the waypoints of the path that a controller gets are `corners[begin[i]:end[i]]`."""
        self.end: Int = np.zeros(count, np.int64)
        self.path_ends: Float = np.zeros((count, 2))
        """f8[n,2] where that path ends."""
        self.yaw: Float = np.zeros(count)
        """f8[n] to take at the end of that path, NaN = any."""
        self.speed: Float = np.zeros(count)
        """f8[n] m/s allowed on the segment under way."""
        self.is_busy: Bool = np.zeros(count, bool)
        """bool[n]: progress has to be counted in every control period."""
        self.uses_lift: Bool = np.zeros(count, bool)
        """bool[n]: a lift carries the robot on its next segment."""
        self.may_drive: Bool = np.zeros(count, bool)
        """bool[n]: something is released that the robot may have to drive or turn to."""
        self.is_finishing: Bool = np.zeros(count, bool)
        """bool[n]: the robot has reached all that is released, and only drives on to its very end."""

    def refresh(self, robots: Int) -> None:
        """Read everything but the clearance anew for robots i8[k]."""
        progress, tables = self._progress, self._progress.tables
        reached, released = progress.reached[robots], progress.released[robots]
        leg, last = progress.leg[robots], progress.end[robots]
        halting = progress.halting[robots]
        first, first_corner = tables.first[robots], tables.first_corner[robots]
        here, goal = first + reached, first + np.minimum(reached + 1, tables.last[robots])
        corner, row = tables.corner[here], first_corner + leg
        # No controller cuts a corner by more than the tolerance, or turns back before it is there.
        stop = tables.reversal if self._beyond_bends else tables.bend
        end = np.minimum(stop[first_corner + np.minimum(np.maximum(corner, leg) + 1, last)], last)
        is_open = reached < released
        checks, arrival = self.checks, tables.arrival_terms.take(goal, 2)
        checks.replace(checks.WAYPOINT, robots, arrival, is_open & ~halting)
        rounding = tables.rounding_terms.take(row, 1)
        checks.replace(checks.CORNER, robots, rounding, (leg + 1 < last) & (corner > leg))
        self.leg.copy(robots, tables.legs, row)
        self.begin[robots] = first_corner + np.minimum(leg + 1, end)
        end_row = first_corner + end
        self.end[robots] = end_row + 1
        self.path_ends[:, 0][robots], self.path_ends[:, 1][robots] = tables.corners.take(end_row, 0).T
        until = first + released
        yaw = np.where(is_open, tables.yaw[until], tables.waiting_yaw[until])
        self.yaw[robots] = np.where(end == last, yaw, np.nan)
        self.speed[robots] = tables.speed[here]
        uses_lift = is_open & (tables.level[here] != tables.level[goal])
        self.uses_lift[robots] = uses_lift
        self.is_busy[robots] = halting | (progress.at_goal[robots] & is_open) | uses_lift
        self.may_drive[robots] = ~halting & ((last > 0) | ~np.isnan(yaw))
        self.is_finishing[robots] = (leg + 1 >= last) & ~is_open

    def refresh_clearance(self, robots: Int) -> None:
        """Read the vertices that robots i8[k] clear next anew."""
        progress, tables = self._progress, self._progress.tables
        first = tables.first[robots]
        corner = tables.corner[first + progress.cleared[robots]]
        at = tables.corner[first + progress.reached[robots]]
        clears = (corner < tables.last_corner[robots]) & (at >= corner)
        clearing = tables.clearing_terms.take(tables.first_corner[robots] + corner, 1)
        self.checks.replace(self.checks.VERTEX, robots, clearing, clears)

    def path_end(self, robot: int) -> int:
        """The corner of its route at which the path of a robot ends."""
        return int(self.end[robot] - 1 - self._progress.tables.first_corner[robot])
