"""The paths of a plan as an execution without physics needs them: durations, places, and where robots have cleared."""

import numpy as np

from mrpbench_core.engine.execution.faults import FaultEvent, approaches
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int16
from mrpbench_core.model.runs.run import RunContext


class ScheduledPaths:
    """The segments of all paths, one path after another, each with one more entry for its end."""

    def __init__(self, context: RunContext) -> None:
        problem, plan = context.problem, context.result.plan
        assert plan is not None
        sizes = [len(path) + 1 for path in plan.paths]
        self.first = np.cumsum([0, *sizes[:-1]]).astype(np.int64)
        """The row i8[n] of the tables at which the path of each robot begins."""
        self.last_move: Int = np.array([route.last_move for route in context.routes], np.int64)
        self._point = np.concatenate([route.waypoint[:, :2] for route in context.routes]).reshape(-1, 2)
        self.level: Int16 = np.concatenate([route.level for route in context.routes]).astype(np.int16)
        """The level i2[s] of each segment."""
        durations, settled, clearing, paces = [], [], [], []
        reach = problem.radius + problem.radius.max(initial=0.0)
        for robot, (path, route) in enumerate(zip(plan.paths, context.routes, strict=True)):
            is_move = path.edge >= 0
            own_ticks = problem.duration(robot)[path.edge] if len(path) else np.empty(0, np.int32)
            duration = np.where(is_move, own_ticks, 0) * problem.roadmap.tick
            length = np.hypot(*np.diff(route.waypoint[:, :2], axis=0).T)
            paces.append(np.append(np.where(length > 0, duration / np.maximum(length, 1e-9), np.inf), np.inf))
            share = np.minimum(1.0, reach[robot] / np.maximum(length, 1e-9))
            durations.append(np.append(duration, 0.0))
            clearing.append(np.append(duration * share, np.inf))
            settled.append(np.maximum.accumulate(np.append(0, np.where(is_move, np.arange(1, len(path) + 1), 0))))
        self.duration: Float = np.concatenate(durations)
        """Planned seconds f8[s] of each segment, 0 for waits and ends."""
        self._clearing: Float = np.concatenate(clearing)
        """Planned seconds f8[s] after which a robot has cleared the start of each segment."""
        self._settled: Int = np.concatenate(settled)
        """The segments i8[s] of its path that a robot at the beginning of each segment has cleared."""
        self.pace: Float = np.concatenate(paces)
        """Planned seconds per metre f8[s] of each segment, inf for turns, waits and ends."""
        ahead = np.diff(self._point, axis=0, append=self._point[-1:])
        ahead[self.first[1:] - 1] = 0.0
        self._ahead = ahead
        self._blocked: dict[FaultEvent, Int] = {}
        """The segments, of all robots one after another, that lead to a blocked place."""
        starts = context.scenario.start[:, 2]
        self._yaw = _yaws(ahead, self.first, np.where(np.isnan(starts), 0.0, starts))

    def rows(self, segment: Int) -> Int:
        """The rows i8[n] of the tables for each robot's `segment` i8[n]."""
        row: Int = self.first + segment
        return row

    def cleared(self, row: Int, segment: Int, done: Float) -> Int:
        """The number i8[k] of segments that each robot has cleared.

        Args:
            row: i8[k] of the tables, of the segment of each robot.
            segment: i8[k] that each robot is on.
            done: f8[k] planned seconds that each robot has made of it.
        """
        on_way = (done >= self._clearing[row]) & (done > 0)
        return np.where(on_way, segment + 1, self._settled[row])

    def before(self, blockage: FaultEvent, segment: Int, under_way: Bool, radius: Float) -> Int:
        """The first segment i8[n] of each robot, after the one `under_way`, that leads it to a blocked place."""
        if blockage not in self._blocked:
            owner = np.repeat(np.arange(len(self.first)), np.diff(np.append(self.first, len(self._point))))
            place, reach = np.array(blockage.place), radius[owner] + blockage.radius
            blocked = approaches(place, self._point, self._point + self._ahead, reach)
            rows = np.flatnonzero(blocked & (self.level == blockage.level))
            self._blocked[blockage] = np.append(rows, np.iinfo(np.int64).max)
        rows = self._blocked[blockage]
        segments: Int = rows[np.searchsorted(rows, self.rows(segment) + under_way)] - self.first
        return segments

    def pose(self, segment: Int, done: Float) -> Float:
        """The pose f8[n,3] of each robot that has made `done` f8[n] planned seconds of its `segment`."""
        at = self.rows(segment)
        share = done / np.maximum(self.duration[at], 1e-9)
        return np.column_stack([self._point[at] + share[:, None] * self._ahead[at], self._yaw[at]])


def _yaws(ahead: Float, first: Int, start: Float) -> Float:
    """The yaw f8[s] of each segment: along it, or as before where the robot does not move."""
    yaw = np.where((ahead != 0).any(axis=1), np.arctan2(ahead[:, 1], ahead[:, 0]), np.nan)
    begins = yaw[first]
    yaw[first] = np.where(np.isnan(begins), start, begins)
    known = np.maximum.accumulate(np.where(np.isnan(yaw), 0, np.arange(len(yaw))))
    held: Float = yaw[known]
    return held
