"""How far each robot is on its route: what it has reached and cleared, and what it may do next."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from mrpbench_core.builtin.navigators.tracks import SLACK, Tracks
from mrpbench_core.model.arrays import Bool, Float, Int, Int16, Int32
from mrpbench_core.model.execution import Route

if TYPE_CHECKING:
    from mrpbench_core.builtin.navigators.waypoints import Waypoints

_STANDING = 0.01
"""m/s."""

AHEAD = (
    *("arrive_x", "arrive_y", "arrive_within", "arrive_ahead_x", "arrive_ahead_y", "arrive_beside"),
    *("round_x", "round_y", "round_ahead_x", "round_ahead_y"),
    *("leg_x", "leg_y", "leg_dx", "leg_dy", "leg_squared", "end_x", "end_y", "yaw", "speed"),
)
"""What has to be watched for each robot on its way, see `Advance.ahead`. NaN = nothing of that kind."""
BEHIND = ("clear_x", "clear_y", "clear_beyond")
"""And where it has to leave room next, see `Advance.behind`."""


class Advance:
    """Moves robots on along their routes.

    Between the moments at which something changes for a robot (a waypoint is reached, a corner rounded, a vertex
    cleared, more is released) only what `ahead` and `behind` tell has to be looked at.

    Args:
        routes: one per robot.
        options: of the navigator.
        clearances: f8[n] metres at which each robot leaves room for any other.
    """

    def __init__(self, routes: Sequence[Route], options: "Waypoints", clearances: Float) -> None:
        self._options, self._clearances = options, clearances
        self._stops = options.waypoints == "stop"
        count = len(routes)
        self.reached: Int = np.zeros(count, np.int64)
        self.cleared: Int = np.zeros(count, np.int64)
        self.leg: Int = np.zeros(count, np.int64)
        """i8[n]: each robot drives from this corner of its own to the next."""
        self.adopt(routes)

    def adopt(self, routes: Sequence[Route]) -> None:
        """Continue with routes that begin with what was released of the old ones."""
        self.tracks = Tracks(routes, self._options, self._clearances)
        self.released: Int = self.reached.copy()
        """i8[n]: as far as each robot may go now; who stops at each waypoint goes to the next one first."""
        self.end: Int = self._corner(slice(None), self.released)
        """i8[n]: the corner where that ends."""
        self.halting: Bool = np.zeros(len(routes), bool)
        self._at_goal: Bool = np.zeros(len(routes), bool)

    def arrive(self, robots: Int, pose: Float, speed: Float, released: Int32, level: Int16) -> Int:
        """Count what robots have reached, given the fleet's estimated poses f8[n,3], speeds f8[n], how many leading
        segments are released i4[n], and levels i2[n]; returns the robots for which anything changed.
        """
        before = self._state(robots)
        moving = np.abs(speed) > _STANDING
        self.halting[robots] &= moving[robots]
        some = robots
        while len(some):
            some = some[(self.reached[some] < released[some]) & ~self.halting[some]]
            if not len(some):
                break
            some = some[self._have_arrived(some, pose, level)]
            self.reached[some] += 1
            self._at_goal[some] = False
            self.halting[some] = moving[some] & self._stops
        allowed = released[robots].astype(np.int64)
        self.released[robots] = np.minimum(self.reached[robots] + 1, allowed) if self._stops else allowed
        self.end[robots] = self._corner(robots, self.released[robots])
        changed: Int = robots[(self._state(robots) != before).any(axis=0)]
        return changed

    def go_round(self, robots: Int, pose: Float) -> None:
        """Count the corners that robots have rounded."""
        some = robots[self.leg[robots] + 1 < self.end[robots]]
        while len(some):
            some = some[self._are_round_the_corner(some, pose)]
            self.leg[some] += 1
            some = some[self.leg[some] + 1 < self.end[some]]

    def leave_behind(self, robots: Int, pose: Float, released: Int32) -> None:
        """Count what robots have cleared: nothing beyond the segment that each is on."""
        furthest = np.minimum(released, self.reached + 1)
        some = robots[self.cleared[robots] < furthest[robots]]
        while len(some):
            some = some[self._have_cleared(some, pose)]
            self.cleared[some] += 1
            some = some[self.cleared[some] < furthest[some]]

    def rejoin(self, robot: int, x: float, y: float) -> None:
        """Let a robot continue from a point of its released route, as if it had reached all before."""
        leg, end = int(self.leg[robot]), int(self.end[robot])
        legs = range(leg, max(end, leg + 1))
        rows = self.tracks.leg[self.tracks.first_corner[robot] + np.array(legs)].tolist()
        gaps = [math.dist((x, y), _nearest(x, y, *row[:4])) for row in rows]
        self.leg[robot] = legs[gaps.index(min(gaps))]
        self._count_up_to(robot, int(self.leg[robot]))

    def skip(self, robot: int) -> None:
        """Count the end of a robot's path as reached, from wherever it is: it is occupied."""
        end = int(self.path_end(np.array([robot]))[0])
        self._count_up_to(robot, end)
        self.leg[robot] = max(int(self.leg[robot]), min(end, int(self.tracks.last_corner[robot]) - 1))
        self._at_goal[robot] = False

    def left_behind(self, robot: int, x: float, y: float) -> tuple[tuple[float, float] | None, float]:
        """The vertex that a robot has left to others last, and how far from it a robot at (x, y) must stay."""
        if not self.cleared[robot]:
            return None, 0.0
        vertex = self.tracks.arrive[self.tracks.first[robot] + self.cleared[robot] - 1, :2].tolist()
        return (vertex[0], vertex[1]), min(float(self._clearances[robot]), math.dist((x, y), vertex)) - SLACK

    def path_end(self, robots: Int) -> Int:
        """The last corner of what lies ahead of some robots: a bend not yet reached, so that no controller cuts a
        corner by more than the tolerance, or the end of what is released.
        """
        last = self.end[robots]
        end = np.minimum(np.maximum(self._corner(robots, self.reached[robots]), self.leg[robots]) + 1, last)
        nearest: Int = np.minimum(self.tracks.bend[self.tracks.first_corner[robots] + end], last)
        return nearest

    def ahead(self, robots: Int, path_end: Int) -> Float:
        """The values of `AHEAD`, f8[19,k], for some robots whose paths end at `path_end`."""
        tracks, values = self.tracks, np.empty((len(AHEAD), len(robots)))
        waypoint, corner = tracks.first[robots], tracks.first_corner[robots]
        reached, released, leg = self.reached[robots], self.released[robots], self.leg[robots]
        end = self.end[robots]
        under_way = (reached < released) & ~self.halting[robots]
        goal = waypoint + np.minimum(reached + 1, tracks.last[robots])
        values[:6] = np.where(under_way, tracks.arrive[goal].T, np.nan)
        rounds = (leg + 1 < end) & (tracks.corner[waypoint + reached] > leg)
        values[6:10] = np.where(rounds, tracks.round[corner + leg].T, np.nan)
        values[10:15] = tracks.leg[corner + leg].T
        values[15:17] = tracks.corners[corner + path_end].T
        values[17] = np.where(path_end == end, tracks.yaw[waypoint + released], np.nan)
        values[18] = tracks.speed[waypoint + reached]
        return values

    def behind(self, robots: Int) -> Float:
        """The values of `BEHIND`, f8[3,k], for some robots."""
        tracks = self.tracks
        corner = self._corner(robots, self.cleared[robots])
        clears = (corner < tracks.last_corner[robots]) & (self._corner(robots, self.reached[robots]) >= corner)
        values: Float = np.where(clears, tracks.clear[tracks.first_corner[robots] + corner].T, np.nan)
        return values

    def rides(self, robots: Int) -> Bool:
        """Tell bool[k] who is, or is to be, carried by a lift."""
        here = self.tracks.first[robots] + self.reached[robots]
        there = np.minimum(self.reached[robots] + 1, self.tracks.last[robots]) + self.tracks.first[robots]
        rides: Bool = self.tracks.level[here] != self.tracks.level[there]
        return rides & (self.reached[robots] < self.released[robots])

    def is_busy(self, robots: Int) -> Bool:
        """Tell bool[k] for whom `arrive` is needed in every period, besides those who ride."""
        return self.halting[robots] | self.only_turn(robots)

    def only_turn(self, robots: Int) -> Bool:
        """Tell bool[k] who is where it is to go next, and only its yaw is wrong."""
        return self._at_goal[robots] & (self.reached[robots] < self.released[robots])

    def may_drive(self, robots: Int) -> Bool:
        """Tell bool[k] for whom anything is released that could have to be driven to, or turned to."""
        turns = ~np.isnan(self.tracks.yaw[self.tracks.first[robots] + self.released[robots]])
        may: Bool = ~self.halting[robots] & ((self.end[robots] > 0) | turns)
        return may

    def is_last(self, robots: Int) -> Bool:
        """Tell bool[k] who has reached all that is released and only drives on to its very end."""
        last: Bool = (self.leg[robots] + 1 >= self.end[robots]) & (self.reached[robots] == self.released[robots])
        return last

    def _state(self, robots: Int) -> Int:
        state: Int = np.array([table[robots] for table in (self.reached, self.released, self.halting, self._at_goal)])
        return state

    def _corner(self, robots: Int | slice, waypoint: Int) -> Int:
        """The corners i8[k] at which waypoints i8[k] of some robots lie."""
        corner: Int = self.tracks.corner[self.tracks.first[robots] + waypoint]
        return corner

    def _count_up_to(self, robot: int, corner: int) -> None:
        """Count what is released up to a corner as reached."""
        first = int(self.tracks.first[robot])
        ahead = self.tracks.corner[first + int(self.reached[robot]) + 1 : first + int(self.released[robot]) + 1]
        self.reached[robot] += int(np.searchsorted(ahead, corner, side="right"))

    def _have_arrived(self, robots: Int, pose: Float, level: Int16) -> Bool:
        """Tell bool[k] who is at the end of the first segment not yet reached."""
        tracks = self.tracks
        goal = tracks.first[robots] + self.reached[robots] + 1
        px, py, within, ux, uy, beside = tracks.arrive[goal].T
        x, y = pose[robots, 0] - px, pose[robots, 1] - py
        near = np.hypot(x, y) <= within
        near |= (x * ux + y * uy >= 0) & (np.abs(ux * y - uy * x) <= beside)
        near |= tracks.is_wait[goal]
        here = level[robots] == tracks.level[goal]
        ends = here & (self.reached[robots] + 1 == tracks.last[robots]) if not self._stops else here
        if ends.any():
            near[ends] |= self._at_goal[robots[ends]] & self._options.stateful
            self._at_goal[robots[ends]] = near[ends]
            near[ends] &= self._face(pose[robots[ends], 2], tracks.yaw[goal[ends]])
        arrived: Bool = near & here
        return arrived

    def _face(self, yaw: Float, wanted: Float) -> Bool:
        """Tell bool[k] whose `yaw` is the one that is wanted, if any is."""
        error = np.abs(np.remainder(yaw - wanted + np.pi, 2 * np.pi) - np.pi)
        faces: Bool = np.isnan(wanted) | (error <= self._options.yaw_goal_tolerance)
        return faces

    def _are_round_the_corner(self, robots: Int, pose: Float) -> Bool:
        """Tell bool[k] who reached the next corner and is on the far side of the line that halves its angle."""
        leg = self.leg[robots]
        px, py, ahead_x, ahead_y = self.tracks.round[self.tracks.first_corner[robots] + leg].T
        round_: Bool = (pose[robots, 0] - px) * ahead_x + (pose[robots, 1] - py) * ahead_y >= -SLACK
        return round_ & (self._corner(robots, self.reached[robots]) > leg)

    def _have_cleared(self, robots: Int, pose: Float) -> Bool:
        """Tell bool[k] whose footprint has left the start of the first segment not yet cleared.

        A segment no longer than the clearance is cleared when it is reached: the robot may have to wait at its end, and
        the problem's own rules say what may stand that close. Waits are cleared with the move that ends them.
        """
        tracks, corner = self.tracks, self._corner(robots, self.cleared[robots])
        at, row = self._corner(robots, self.reached[robots]), tracks.first_corner[robots] + corner
        px, py, beyond = tracks.clear[row].T
        left = np.hypot(pose[robots, 0] - px, pose[robots, 1] - py) >= beyond
        left |= tracks.is_short[row] & (at > corner)
        cleared: Bool = left & (corner < tracks.last_corner[robots]) & (at >= corner)
        return cleared


def _nearest(x: float, y: float, ax: float, ay: float, dx: float, dy: float) -> tuple[float, float]:
    """The point of the segment from a along d that is nearest to a point."""
    squared = dx * dx + dy * dy
    share = min(max(((x - ax) * dx + (y - ay) * dy) / squared, 0.0), 1.0) if squared else 0.0
    return ax + share * dx, ay + share * dy
