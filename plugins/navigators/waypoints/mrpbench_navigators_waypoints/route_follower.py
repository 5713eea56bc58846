"""All robots on their routes, in C++: how far each has come, what lies ahead of it, and which robots are stuck."""

import math
from collections.abc import Sequence
from typing import Any

import attrs
import numpy as np
from mrpbench_native.navigation import Navigation

from mrpbench_core.model.common.arrays import Bool, Byte, Float, Int, Int16, Int32, read_only
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.execution.route import Route, Routes
from mrpbench_navigators_waypoints.route_tables import SLACK, USUAL, ArrivalRules, RouteTables

_NO_LIMITS: Float = np.zeros(0)
_AHEAD = 0.3
"""metres along the path at which its direction is measured."""
_MODES = np.array([Mode.WAITING, Mode.FOLLOWING], np.uint8)
"""The mode of a robot that neither recovers nor has given up, by whether it is under way."""


@attrs.frozen(kw_only=True)
class ProgressRules:
    """When a robot is stuck, and when it asks for a detour."""

    required_movement_radius: float = 0.5
    """metres: a robot makes progress when it has moved this far."""
    movement_time_allowance: float = 10.0
    """simulated seconds within which it has to."""
    required_movement_angle: float = np.inf
    """radians: it makes progress, too, when it has turned this far; inf = turning is not progress."""
    detours_every: int = 0
    """Control periods between two requests of the same robot for a detour; 0 = robots never ask."""
    detours_always: bool = False
    """Robots also ask while they drive."""


@attrs.frozen(kw_only=True)
class Activities:
    """bool[n] each: robots that are not driven along their routes, by what they do, and those on a detour."""

    aborted: Bool
    recovering: Bool
    rotating: Bool
    detouring: Bool


@attrs.frozen(kw_only=True)
class Targets:
    """What `RouteFollower.survey` finds. Arrays are views, valid until its next call."""

    rows: dict[str, Any]
    """Of the k robots that a controller has to drive, in order: `robot`, `pose`, `twist`, `foot` f8[k,2], `begin` and
    `end` of the paths in `RouteFollower.corners`, `yaw` f8[k] at their ends (NaN = any), `speed` f8[k] m/s allowed."""
    stuck: Bool | None
    """bool[n] robots that have made no progress for too long; None: no robot. Their time begins anew."""
    due: list[int]
    """Rows whose turn it is to ask for a detour, and those of them that have not moved, or are on one."""
    blocked: list[int]


class RouteFollower:
    """Follows one route per robot.

    Args:
        routes: one per robot.
        rules: when a waypoint counts as reached.
        clearances: f8[n] metres at which each robot leaves room for any other.
        beyond_bends: what lies ahead of a robot ends where its released part ends, not at the next bend. Robots then
            cut corners and pass waypoints from some distance.
        progress: when robots are stuck.
    """

    def __init__(
        self,
        routes: Sequence[Route],
        rules: ArrivalRules,
        clearances: Float,
        beyond_bends: bool = False,
        progress: ProgressRules | None = None,
    ) -> None:
        count = len(routes)
        self._rules, self._clearances, self._beyond_bends = rules, clearances, beyond_bends
        self.activities = Activities(
            aborted=np.zeros(count, bool),
            recovering=np.zeros(count, bool),
            rotating=np.zeros(count, bool),
            detouring=np.zeros(count, bool),
        )
        """Those who drive robots otherwise write into these arrays."""
        all_rules = attrs.asdict(rules) | attrs.asdict(progress or ProgressRules()) | {"beyond_bends": beyond_bends}
        self._native = Navigation(rules=all_rules, activities=attrs.asdict(self.activities))
        self._rows, state = self._native.rows, self._native.state
        self._count, self._targets = -1, self._rows
        """The number of rows of the last survey, and views of them."""
        self.begin: Int = state["begin"]
        """i8[n]: the waypoints ahead of robot i are `corners[begin[i]:end[i]]`."""
        self.end: Int = state["end"]
        """i8[n], see `begin`."""
        self.yaw: Float = state["yaw"]
        """f8[n] to take at the end of what lies ahead, NaN = any."""
        self.speed: Float = state["speed"]
        """f8[n] m/s allowed on the segment under way."""
        self.foot: Float = state["foot"]
        """f8[n,2]: the nearest point of each robot's leg of its route."""
        self.under_way: Byte = state["under_way"]
        """u1[n]: robots that have to drive on, or to take a yaw; a robot in a lift has not."""
        self.following: Bool = state["following"].view(bool)
        """bool[n]: robots that a controller has to drive."""
        self._did, self._modes = (b"", b"", b""), self.under_way
        self._counts, self._stuck = (state["reached"], state["cleared"]), state["stuck"].view(bool)
        self.adopt(routes)

    def __len__(self) -> int:
        return len(self.begin)

    def adopt(self, routes: Sequence[Route], cut: Int32 | None = None) -> None:
        """Continue with routes that begin with the released parts of the old ones, but for `cut` i4[n] segments."""
        joined = Routes.of(routes)
        self.tables = RouteTables(joined, self._rules, self._clearances, self._beyond_bends)
        self.corners: Float = self.tables.corners
        tables = self.tables.arrays()
        tables["any_yaw"] = self._rules.turn_ahead or not np.isnan(joined.waypoint[:, 2]).all()
        self._native.adopt(tables, cut)
        self._read_progress()

    def update(self, pose: Float, twist: Float, released: Int32, level: Int16) -> None:
        """Count what robots have reached, rounded and cleared.

        Args:
            pose: f8[n,3] estimated.
            twist: f8[n,2] m/s, rad/s.
            released: i4[n] number of leading segments released.
            level: i2[n].
        """
        if self._native.update(pose, twist, released, level):
            self._read_progress()

    def survey(self, now: float, pose: Float, twist: Float, limits: Float = _NO_LIMITS) -> Targets:
        """Look at all robots once in each control period, after `update`.

        Args:
            now: simulated seconds.
            pose: f8[n,3] estimated.
            twist: f8[n,2] m/s, rad/s.
            limits: f8[n] m/s allowed by others, or empty.
        """
        count, is_stuck, due, blocked = self._native.survey(now, pose, twist, limits)
        if count != self._count:
            self._count, self._targets = count, {name: values[:count] for name, values in self._rows.items()}
        return Targets(rows=self._targets, stuck=self._stuck if is_stuck else None, due=due, blocked=blocked)

    def modes(self) -> Byte:
        """The modes u1[n]; the same array while none changes."""
        recovering, aborted = self.activities.recovering, self.activities.aborted
        doing = self.under_way.tobytes(), recovering.tobytes(), aborted.tobytes()
        if doing != self._did:
            modes = _MODES.take(self.under_way)
            modes[recovering], modes[aborted] = Mode.RECOVERING, Mode.ABORTED
            self._did, self._modes = doing, read_only(modes)
        return self._modes

    def ask_at_once(self, robot: int) -> None:
        """Let a robot ask for a detour when it is driven next."""
        self._native.hurry(robot)

    def rejoin(self, robot: int, x: float, y: float) -> None:
        """Let a robot continue from a point of its released route."""
        self._native.rejoin(robot, x, y)
        self._read_progress()

    def skip_path_end(self, robot: int) -> None:
        """Count the end of a robot's path as reached."""
        self._native.skip_path_end(robot)
        self._read_progress()

    def is_near_path_end(self, robot: int, x: float, y: float) -> bool:
        """Tell whether a robot is within the stated tolerance of the end of its path, but has to come nearer to clear
        the place before.
        """
        if self.activities.detouring[robot]:
            return False
        stated = min(self._rules.waypoint_tolerance, self._rules.xy_goal_tolerance)
        return self.tables.tolerance < math.dist(self.path_end(robot), (x, y)) <= stated

    def path_end(self, robot: int) -> tuple[float, float]:
        """x, y of the end of what lies ahead of a robot."""
        x, y = self.corners[self.end[robot] - 1].tolist()
        return x, y

    def heading(self, robot: int, x: float, y: float) -> float:
        """The yaw from x, y to the path ahead of a robot, radians; NaN where it has hardly any way left."""
        path = np.vstack([self.foot[robot], self.corners[self.begin[robot] : self.end[robot]]])
        along = np.append(0.0, np.cumsum(np.hypot(*np.diff(path, axis=0).T)))
        dx, dy = (np.interp(_AHEAD, along, path[:, axis]) - here for axis, here in enumerate((x, y)))
        return math.atan2(dy, dx) if math.hypot(dx, dy) > USUAL else math.nan

    def segment_ends(self, robots: Int, segments: Int) -> tuple[Float, Float]:
        """The places f8[k,2] at which segments i8[k] of robots i8[k] start and end."""
        row = self.tables.first[robots] + segments
        place = self.tables.arrival[:, :2]
        return place[row], place[row + 1]

    def only_turns(self, robot: int) -> bool:
        """Tell whether a robot is at the place to go to next, and has only to turn there."""
        return self._native.only_turns(robot)

    def cleared_vertex(self, robot: int, x: float, y: float) -> tuple[tuple[float, float] | None, float]:
        """The vertex that a robot cleared last, and the distance that it must keep from there when it is at x, y."""
        if not self.cleared[robot]:
            return None, 0.0
        at = self.tables.first[robot] + self.cleared[robot] - 1
        vertex = tuple(self.tables.arrival[at, :2].tolist())
        return vertex, min(float(self._clearances[robot]), float(np.hypot(x - vertex[0], y - vertex[1]))) - SLACK

    def held_way(self, robot: int) -> Float:
        """The waypoints f8[k,2] that a robot has not cleared, up to the one that it drives to; at least one."""
        first = self.tables.first[robot]
        end = min(self.reached[robot] + 1, self.tables.last[robot])
        held: Float = self.tables.arrival[first + self.cleared[robot] : first + end + 1, :2]
        return held

    def _read_progress(self) -> None:
        """Take read-only copies of the counts, which others may keep."""
        self.reached, self.cleared = (read_only(counts.copy()) for counts in self._counts)
        """i4[n] each, as in `FleetView`."""
