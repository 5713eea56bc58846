"""Collects what happens during an execution and hands it on in chunks."""

from collections import defaultdict
from collections.abc import Callable, Sequence
from typing import Any

import attrs
import numpy as np

from mrpbench_core.engine.execution.task_board import TaskEvent
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.execution.motion import Event, Motion
from mrpbench_core.model.execution.movers import Movers
from mrpbench_core.model.execution.observation import Estimate, Odometry, ScanBatch
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.runs.recording import Chunk

SAMPLES = 256
"""Periodic samples per chunk."""
SCANS = 4096
"""Scans per chunk: a thousand robots take that many in a second."""

IRREGULAR: dict[str, tuple[str, tuple[int, ...]]] = {
    "contact_time": ("f8", ()),
    "contact": ("i4", (2,)),
    "route_time": ("f8", ()),
    "route_revision": ("i4", ()),
    "route_robot": ("i4", ()),
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

INTEGERS = dict.fromkeys(
    (
        *("contact", "scan_robot", "event_robot", "route_revision", "route_robot", "route_edge"),
        *("errand_task", "errand_priority", "task_index", "task_robot", "task_errand"),
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
        self, rate: float, period: float, sink: Callable[[Chunk], None], scans: bool = True, tasks: bool = False
    ) -> None:
        self._keeps_scans = scans
        self._every = max(1, round(1 / (rate * period)))
        self._sink = sink
        channels = IRREGULAR | (TASKS if tasks else {})
        sink({name: np.empty((0, *shape), kind) for name, (kind, shape) in channels.items()})
        self._rows: dict[str, list[Any]] = defaultdict(list)
        self._touching: set[tuple[int, int]] = set()

    def sample(self, step: int, sample: Sample, last: bool) -> None:
        """Record control period `step` if it is due; the `last` always is."""
        if step % self._every and not last:
            return
        rows, state, motion = self._rows, sample.state, sample.motion
        rows["time"].append(sample.now)
        rows["truth"].append(state.pose)
        rows["truth_twist"].append(state.twist)
        rows["level"].append(state.level)
        if sample.estimate is not None and sample.odometry is not None:
            rows["estimate"].append(sample.estimate.pose)
            rows["odometry"].append(np.column_stack([sample.odometry.pose, sample.odometry.twist]))
            rows["command"].append(motion.twist)
        rows["released"].append(sample.orders.released)
        rows["reached"].append(motion.reached)
        rows["cleared"].append(motion.cleared)
        rows["mode"].append(motion.mode)
        rows["waits_for"].append(sample.waits_for)
        if sample.facility:
            rows["facility"].append(sample.facility)
        if sample.movers is not None:
            rows["mover"].append(np.hstack([sample.movers.pose, sample.movers.velocity]))
            rows["mover_level"].append(sample.movers.level)
        if len(rows["time"]) >= SAMPLES:
            self.flush()

    def contacts(self, now: float, state: State) -> None:
        """Record contacts during the period that ends at `now`; the beginning of a contact is also an event."""
        robots = len(state.pose)
        touching = {(robot, other) for robot, other in state.contacts.tolist()}
        for robot, other in sorted(touching):
            self._rows["contact_time"].append(now)
            self._rows["contact"].append((robot, other))
            if (robot, other) not in self._touching:
                detail = "wall" if other < 0 else f"robot_{other}" if other < robots else f"mover_{other - robots}"
                self.events([Event(stamp=now, kind="contact", robot=robot, detail=detail)])
        self._touching = touching

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

    def events(self, events: Sequence[Event]) -> None:
        """Record events."""
        for event in events:
            self._rows["event_time"].append(event.stamp)
            self._rows["event_kind"].append(event.kind)
            self._rows["event_robot"].append(event.robot)
            self._rows["event_detail"].append(event.detail)

    def tasks(self, tasks: Sequence[Task], events: Sequence[TaskEvent]) -> None:
        """Record tasks that were released, one row per errand, and what happened to tasks."""
        rows = self._rows
        for task in tasks:
            count = len(task.goals)
            rows["errand_time"] += [task.release] * count
            rows["errand_task"] += [task.index] * count
            rows["errand_goal"] += [*task.goals]
            rows["errand_level"] += [*task.levels]
            rows["errand_service"] += [*task.service]
            rows["errand_deadline"] += [task.deadline] * count
            rows["errand_priority"] += [task.priority] * count
        for event in events:
            rows["task_time"].append(event.stamp)
            rows["task_index"].append(event.task)
            rows["task_event"].append(event.kind)
            rows["task_robot"].append(event.robot)
            rows["task_errand"].append(event.errand)

    def routes(self, now: float, revision: int, routes: Sequence[Route], plan: Plan) -> None:
        """Record a new plan and its routes: one row per waypoint, with the segment that leads there and its limit."""
        for robot, (route, path) in enumerate(zip(routes, plan.paths, strict=True)):
            self._rows["route_time"] += [now] * len(route.waypoint)
            self._rows["route_revision"] += [revision] * len(route.waypoint)
            self._rows["route_robot"] += [robot] * len(route.waypoint)
            self._rows["route_waypoint"] += [*route.waypoint]
            self._rows["route_level"] += [*route.level]
            self._rows["route_speed"] += [np.inf, *route.speed]
            self._rows["route_edge"] += [-1, *path.edge]
            self._rows["route_leave"] += [*path.enter[:1], *path.leave] or [0]

    def flush(self) -> None:
        """Hand on what has been collected."""
        if self._rows:
            self._sink({name: _stack(name, rows) for name, rows in self._rows.items()})
            self._rows.clear()


def _stack(name: str, rows: list[Any]) -> np.ndarray:
    if name == "scan_ranges":
        beams = max(len(row) for row in rows)
        padded = np.full((len(rows), beams), np.nan, "f4")
        for index, row in enumerate(rows):
            padded[index, : len(row)] = row
        return padded
    return np.array(rows, dtype=INTEGERS.get(name))
