"""Collects what happens during an execution and hands it on in chunks."""

from collections import defaultdict
from collections.abc import Callable, Sequence
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.engine.execution.evaluations import POSES, RecordedEvaluation
from mrpbench_core.engine.execution.task_board import TaskEvent
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.execution.motion import Event, Motion
from mrpbench_core.model.execution.movers import Movers
from mrpbench_core.model.execution.observation import Estimate, Odometry, ScanBatch
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.execution.route import Route, Routes
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.planning.plan import Paths, Plan
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.runs.recording import Chunk

SAMPLES = 256
"""Periodic samples per chunk."""
WAYPOINTS = 1 << 18
"""Waypoints of new plans per chunk, at least: a thousand robots that plan every second get as many in some seconds."""
TRAJECTORIES = 4096
"""Trajectories per chunk, nearly a megabyte."""
SCANS = 4096
"""Scans per chunk: a thousand robots take that many in a second."""

IRREGULAR: dict[str, tuple[str, tuple[int, ...]]] = {
    "contact_time": ("f8", ()),
    "contact": ("i4", (2,)),
    "contact_force": ("f8", ()),
    "route_time": ("f8", ()),
    "route_revision": ("i4", ()),
    "route_robot": ("i4", ()),
    "route_segment": ("i4", ()),
    "route_waypoint": ("f8", (3,)),
    "route_level": ("i2", ()),
    "route_speed": ("f8", ()),
    "route_edge": ("i4", ()),
    "route_leave": ("i8", ()),
    "event_time": ("f8", ()),
    "event_kind": ("U1", ()),
    "event_robot": ("i4", ()),
    "event_detail": ("U1", ()),
}
"""Channels that may stay empty, which is not the same as missing."""


TASKS: dict[str, tuple[str, tuple[int, ...]]] = {
    "errand_time": ("f8", ()),
    "errand_task": ("i4", ()),
    "errand_number": ("i4", ()),
    "errand_goal": ("f8", (3,)),
    "errand_level": ("i2", ()),
    "errand_service": ("f8", ()),
    "errand_deadline": ("f8", ()),
    "errand_priority": ("i4", ()),
    "task_time": ("f8", ()),
    "task_index": ("i4", ()),
    "task_event": ("U1", ()),
    "task_robot": ("i4", ()),
    "task_errand": ("i4", ()),
}
"""The same, where tasks come over time."""

TRAJECTORY: dict[str, tuple[str, tuple[int, ...]]] = {
    "trajectory_time": ("f8", ()),
    "trajectory_robot": ("i4", ()),
    "trajectory_chosen": ("u1", ()),
    "trajectory_cost": ("f8", ()),
    "trajectory_pose": ("f4", (POSES, 3)),
    "critic_time": ("f8", ()),
    "critic_robot": ("i4", ()),
    "critic_name": ("U1", ()),
    "critic_score": ("f8", ()),
}
"""The same, where the trajectories of controllers are recorded."""

INTEGERS = dict.fromkeys(
    (
        *("contact", "scan_robot", "event_robot", "critic_robot"),
        *("errand_task", "errand_number", "errand_priority", "task_index", "task_robot", "task_errand"),
    ),
    "i4",
)
"""Channels whose rows come as Python's integers."""


@attrs.frozen(kw_only=True)
class Sample:
    """The values of the periodic channels in one control period; see `mrpbench_core.model.runs.recording`."""

    now: float
    """Simulated seconds."""
    state: State
    orders: Orders
    motion: Motion
    waits_for: Int32
    estimate: Estimate | None = None
    """None without physics, as `odometry`; then nothing commands the robots either."""
    odometry: Odometry | None = None
    facility: Sequence[float] = ()
    movers: Movers | None = None


class Recorder:
    """Samples the periodic channels every `1 / rate` simulated seconds; contacts, scans and events as they come.

    `sink` gets every chunk; memory does not grow with the run. Scans are recorded only on request.
    """

    def __init__(
        self,
        rate: float,
        period: float,
        sink: Callable[[Chunk], None],
        scans: bool = True,
        tasks: bool = False,
        trajectories: bool = False,
    ) -> None:
        self._keeps_scans = scans
        self._every = max(1, round(1 / (rate * period)))
        self._sink = sink
        channels = IRREGULAR | (TASKS if tasks else {}) | (TRAJECTORY if trajectories else {})
        sink({name: np.empty((0, *shape), kind) for name, (kind, shape) in channels.items()})
        self._rows: dict[str, list[Any]] = defaultdict(list)
        self._waypoints = self._trajectories = 0
        self._touching: set[tuple[int, int]] = set()

    def is_due(self, step: int) -> bool:
        """Tell whether control period `step` is one of those that are recorded."""
        return step % self._every == 0

    def sample(self, step: int, sample: Sample, last: bool) -> None:
        """Record control period `step` if it is due; the `last` always is."""
        if not (last or self.is_due(step)):
            return
        rows, state, motion = self._rows, sample.state, sample.motion
        rows["time"].append(sample.now)
        rows["truth"].append(state.pose)
        rows["truth_twist"].append(state.twist)
        rows["level"].append(state.level)
        if sample.estimate is not None and sample.odometry is not None:
            rows["estimate"].append(sample.estimate.pose)
            rows["odometry"].append(np.concatenate([sample.odometry.pose, sample.odometry.twist], axis=1))
            rows["command"].append(motion.twist)
        rows["released"].append(sample.orders.released)
        if len(sample.orders.speed):
            rows["speed_limit"].append(sample.orders.speed)
        rows["reached"].append(motion.reached)
        rows["cleared"].append(motion.cleared)
        rows["mode"].append(motion.mode)
        rows["waits_for"].append(sample.waits_for)
        if sample.facility:
            rows["facility"].append(sample.facility)
        if sample.movers is not None:
            rows["mover"].append(np.hstack([sample.movers.pose, sample.movers.velocity]))
            rows["mover_level"].append(sample.movers.level)
            rows["mover_arrivals"].append(sample.movers.arrivals)
        if len(rows["time"]) >= SAMPLES:
            self.flush()

    def contacts(self, now: float, state: State) -> None:
        """Record contacts during the period that ends at `now`; the beginning of a contact is also an event."""
        if not len(state.contacts) and not self._touching:
            return
        robots = len(state.pose)
        forces = np.full(len(state.contacts), np.nan) if state.contact_force is None else state.contact_force
        touching = dict(zip(map(tuple, state.contacts.tolist()), forces.tolist(), strict=True))
        for (robot, other), force in sorted(touching.items()):
            self._rows["contact_time"].append(now)
            self._rows["contact"].append((robot, other))
            self._rows["contact_force"].append(force)
            if (robot, other) not in self._touching:
                detail = "wall" if other < 0 else f"robot_{other}" if other < robots else f"mover_{other - robots}"
                self.events([Event(stamp=now, kind="contact", robot=robot, detail=detail)])
        self._touching = set(touching)

    def scans(self, batches: Sequence[ScanBatch]) -> None:
        """Record scans, one row per robot; rows of different lidars are padded with NaN."""
        if not self._keeps_scans:
            return
        for batch in batches:
            for robot, ranges in zip(batch.robot, batch.ranges, strict=True):
                self._rows["scan_time"].append(batch.stamp)
                self._rows["scan_robot"].append(robot)
                self._rows["scan_ranges"].append(ranges)
        if len(self._rows.get("scan_time", ())) >= SCANS:
            self.flush()

    def maps(self, changes: Chunk) -> None:
        """Record what has changed on the maps of robots."""
        if changes:
            self._sink(changes)

    def evaluations(self, now: float, evaluations: Sequence[RecordedEvaluation]) -> None:
        """Record what controllers weighed: one row per trajectory, and one per critic and chosen trajectory."""
        rows = self._rows
        for each in evaluations:
            count = len(each.pose)
            rows["trajectory_time"].append(np.full(count, now))
            rows["trajectory_robot"].append(np.full(count, each.robot, "i4"))
            rows["trajectory_chosen"].append(each.chosen.astype("u1"))
            rows["trajectory_cost"].append(each.cost)
            rows["trajectory_pose"].append(each.pose)
            self._trajectories += count
            for name, score in each.scores.items():
                rows["critic_time"].append(now)
                rows["critic_robot"].append(each.robot)
                rows["critic_name"].append(name)
                rows["critic_score"].append(score)
        if self._trajectories >= TRAJECTORIES:
            self.flush()

    def events(self, events: Sequence[Event]) -> None:
        """Record events."""
        for event in events:
            self._rows["event_time"].append(event.stamp)
            self._rows["event_kind"].append(event.kind)
            self._rows["event_robot"].append(event.robot)
            self._rows["event_detail"].append(event.detail)

    def tasks(self, tasks: Sequence[Task], events: Sequence[TaskEvent]) -> None:
        """Record tasks that were released, one row per place of each errand, and what happened to tasks."""
        rows = self._rows
        for task in tasks:
            count = len(task.goals)
            rows["errand_time"] += [task.release] * count
            rows["errand_task"] += [task.index] * count
            rows["errand_number"] += task.errand.tolist()
            rows["errand_goal"] += [*task.goals]
            rows["errand_level"] += [*task.levels]
            rows["errand_service"] += [*task.service[task.errand]]
            rows["errand_deadline"] += [task.deadline] * count
            rows["errand_priority"] += [task.priority] * count
        for event in events:
            rows["task_time"].append(event.stamp)
            rows["task_index"].append(event.task)
            rows["task_event"].append(event.kind)
            rows["task_robot"].append(event.robot)
            rows["task_errand"].append(event.errand)

    def routes(
        self, now: float, revision: int, routes: Sequence[Route], plan: Plan, recorded: Int32, driven: Int32
    ) -> None:
        """Record a new plan and its routes: one row per waypoint, with the segment that leads there and its limit.

        Args:
            now: simulated seconds.
            revision: its number.
            routes: one per robot.
            plan: the same.
            recorded: i4[n] leading waypoints of each route that are known already, and left out.
            driven: i4[n] segments of each robot that are not part of the plan any more.
        """
        paths, joined = Paths.of(plan.paths), Routes.of(routes)
        size = joined.size - recorded
        rows = int(size.sum())
        new = np.arange(len(joined.level)) >= np.repeat(joined.first[:-1] + recorded, joined.size)
        speed = np.append(np.inf, joined.speed[:-1])  # of the segment that leads to each waypoint
        speed[joined.first[:-1]] = np.inf
        within = np.arange(rows) - np.repeat(np.cumsum(size) - size, size)
        for name, values in {
            "time": np.full(rows, now),
            "revision": np.full(rows, revision, np.int32),
            "robot": np.repeat(np.arange(len(routes), dtype=np.int32), size),
            "segment": (within + np.repeat(recorded + driven, size)).astype(np.int32),
            "waypoint": joined.waypoint[new],
            "level": joined.level[new],
            "speed": speed[new],
            **_segments(paths, recorded),
        }.items():
            self._rows[f"route_{name}"].append(values)
        self._waypoints += rows
        if self._waypoints >= WAYPOINTS:
            self.flush()

    def flush(self) -> None:
        """Hand on what has been collected."""
        if self._rows:
            self._sink({name: _stack(name, rows) for name, rows in self._rows.items()})
            self._rows.clear()
            self._waypoints = self._trajectories = 0


def _segments(paths: Paths, recorded: Int32) -> dict[str, NDArray[Any]]:
    """The edge that leads to each waypoint and the tick at which its robot comes there, but for the `kept` i4[n] first.

    The first waypoint of a route is where the path begins: no edge leads there. Times before tick 0 are recorded as 0.
    """
    begin, at = paths.first[:-1], np.arange(len(paths.edge)) + paths.robot + 1
    edge, leave = np.full(len(paths.edge) + len(paths), -1, np.int32), np.zeros(len(paths.edge) + len(paths), np.int64)
    edge[at], leave[at] = paths.edge, paths.leave
    starts = begin + np.arange(len(paths))
    some = paths.size > 0
    leave[starts[some]] = paths.enter[begin[some]]
    new = np.arange(len(edge)) - np.repeat(starts + recorded, paths.size + 1) >= 0
    return {"edge": edge[new], "leave": np.maximum(leave[new], 0)}


def _stack(name: str, rows: list[Any]) -> np.ndarray:
    if name.startswith(("route_", "trajectory_")):
        return np.concatenate(rows)
    if name == "scan_ranges":
        beams = max(len(row) for row in rows)
        padded = np.full((len(rows), beams), np.nan, "f4")
        for index, row in enumerate(rows):
            padded[index, : len(row)] = row
        return padded
    return np.array(rows, dtype=INTEGERS.get(name))
