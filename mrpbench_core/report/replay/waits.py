"""Finds out from a recording why robots wait, and for what."""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from enum import IntEnum
from typing import Any

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.dependencies import Dependencies, first_samples
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.report.replay.blocked import nearest, standing
from mrpbench_core.report.replay.motion import read_poses
from mrpbench_core.report.replay.packing import Packing
from mrpbench_core.report.replay.plans import RecordedPlan
from mrpbench_core.store.recording import Recording

NEEDED = frozenset({"mode", "reached", "cleared", "released"})


class Reason(IntEnum):
    """Why a robot stands; the page has the same list (`why.js`)."""

    NONE = 0
    ROBOT = 1
    """Another robot passes first; `culprit` is its index."""
    RESOURCE = 2
    """A door, lift or mutex is not granted yet; `culprit` is the index of the resource."""
    ROTATION = 3
    """A rotation begins when all of its robots are ready; `culprit` is the robot that is missing."""
    REPLAN = 4
    """A new plan is being computed, and nothing is released until then."""
    RECOVERY = 5
    SCHEDULE = 6
    """The dispatcher releases by the plan's times, and that time has not come."""
    START = 7
    """The robot starts late."""
    UNKNOWN = 8
    """The dispatcher has not released the next segment, and the recording does not tell why."""
    BLOCKED = 9
    """The robot stands although its way is released; `culprit` is the nearest robot if one is near."""
    FAULT = 10
    """The robot is out of order (`faults:`)."""


@attrs.frozen(kw_only=True)
class Waits:
    """Reasons and culprits."""

    reason: Int
    """u1[T,n] of `Reason`."""
    culprit: Int32
    """i4[T,n]: robot or resource, -1 = none."""


def pack_waits(
    recording: Recording, plans: Sequence[RecordedPlan], config: Mapping[str, Any], packing: Packing
) -> None:
    """Pack `reason` and `culprit` if the recording allows to find them; see `explain_waits`."""
    waits = explain_waits(recording, plans, config)
    if waits is not None:
        packing.add("reason", waits.reason.T)
        packing.add("culprit", waits.culprit.T)


def explain_waits(recording: Recording, plans: Sequence[RecordedPlan], config: Mapping[str, Any]) -> Waits | None:
    """Return why each robot waits at each sample; None if progress or modes were not recorded.

    The reason is a dependency of the plan in force that is not met. Where nothing is known of that plan but its routes,
    the reason is the robot that holds the next waypoint.

    Args:
        recording: of an execution.
        plans: of this execution, see `read_plans`.
        config: the configuration of the run, for the latency of replanning.
    """
    if not recording.channels.keys() >= NEEDED:
        return None
    channels = {name: recording.channel(name) for name in (*sorted(NEEDED), "time")}
    if any(len(plan.routes) != channels["mode"].shape[1] for plan in plans):
        return None
    if "waits_for" in recording.channels:
        channels["waits_for"] = recording.channel("waits_for")
    pending = _pending(recording, channels["time"], config)
    context = recording.first_context()
    waits = _Explanation(context.problem, channels, plans).waits(pending)
    return _with_faults(_with_blocked(waits, recording, context.fleet), recording)


def _with_faults(waits: Waits, recording: Recording) -> Waits:
    """Add the robots that stand because they are out of order; see `engine.execution.faults`."""
    if "event_kind" not in recording.channels:
        return waits
    time, reason, culprit = recording.channel("time"), waits.reason.copy(), waits.culprit.copy()
    names = ("event_time", "event_kind", "event_robot", "event_detail")
    stops: dict[int, int] = defaultdict(int)
    for at, kind, robot, detail in zip(*(recording.channel(name).tolist() for name in names), strict=True):
        if kind in ("fault", "fault_over") and robot >= 0 and detail.startswith("stops"):
            stops[robot] += 1 if kind == "fault" else -1
            later = time >= at - 1e-9
            reason[later, robot] = Reason.FAULT if stops[robot] else waits.reason[later, robot]
            culprit[later, robot] = -1 if stops[robot] else waits.culprit[later, robot]
    return Waits(reason=reason, culprit=culprit)


def _with_blocked(waits: Waits, recording: Recording, fleet: Fleet) -> Waits:
    """Add the robots that stand although their way is released."""
    time, pose = read_poses(recording)
    mode, reached, released = (recording.channel(name) for name in ("mode", "reached", "released"))
    blocked = (mode == Mode.FOLLOWING) & (reached < released) & standing(time, pose)
    level = recording.channel("level") if "level" in recording.channels else np.zeros_like(reached)
    radius = np.array([robot.radius for robot in fleet.robots])
    near = nearest(blocked, pose, level, radius)
    return Waits(reason=np.where(blocked, Reason.BLOCKED, waits.reason), culprit=np.where(blocked, near, waits.culprit))


def _pending(recording: Recording, time: Float, config: Mapping[str, Any]) -> Bool:
    """Tell at which samples bool[T] a new plan was pending."""
    pending = np.zeros(len(time), bool)
    if "event_kind" in recording.channels:
        latency = float((config.get("replanning") or {}).get("latency") or 0.0)
        stamps = recording.channel("event_time")[np.char.startswith(recording.channel("event_kind"), "replan")]
        for stamp in stamps.tolist():
            pending |= (time >= stamp - latency - 1e-9) & (time <= stamp + 1e-9)
    return pending


class _Explanation:
    def __init__(self, problem: Problem, channels: Mapping[str, Any], plans: Sequence[RecordedPlan]) -> None:
        self.problem, self.channels = problem, channels
        self.time: Float = channels["time"]
        limits = [*np.searchsorted(self.time, [plan.time for plan in plans]).tolist(), len(self.time)]
        self.windows = [(plan, slice(begin, end)) for plan, begin, end in zip(plans, limits, limits[1:], strict=False)]
        self.reason = np.zeros(channels["mode"].shape, np.uint8)
        self.culprit: Int32 = np.full(self.reason.shape, -1, np.int32)

    def waits(self, pending: Bool) -> Waits:
        mode, reached, released = (self.channels[name] for name in ("mode", "reached", "released"))
        self.reason[mode == Mode.RECOVERING] = Reason.RECOVERY
        waiting = mode == Mode.WAITING
        for plan, window in self.windows:
            waiting[window] &= reached[window] < [route.last_move for route in plan.routes]
        self.reason[waiting] = np.where(reached < released, Reason.START, Reason.UNKNOWN)[waiting]
        for plan, window in self.windows:
            self._by_holders(plan.routes, window)
            if plan.plan is not None:
                self._by_dependencies(plan.plan, window)
        self.reason[(self.reason == Reason.UNKNOWN) & pending[:, None]] = Reason.REPLAN
        if "waits_for" in self.channels:
            asked = waiting & (self.channels["waits_for"] >= 0)
            self.reason[asked] = Reason.RESOURCE
            self.culprit[asked] = self.channels["waits_for"][asked]
        return Waits(reason=self.reason, culprit=self.culprit)

    def _open(self, window: slice) -> Iterator[tuple[int, int, Int]]:
        """Robot, number of released segments, and the samples at which it waits with no more than these."""
        for robot in range(self.reason.shape[1]):
            samples = window.start + np.flatnonzero(self.reason[window, robot] == Reason.UNKNOWN)
            released = self.channels["released"][samples, robot]
            for count in np.unique(released).tolist():
                yield robot, count, samples[released == count]

    def _blame(self, samples: Int, robot: int, reason: Reason, culprit: int) -> None:
        self.reason[samples, robot] = reason
        self.culprit[samples, robot] = culprit

    def _by_holders(self, routes: tuple[Route, ...], window: slice) -> None:
        """Name the robot that was let onto the next waypoint and has not cleared it."""
        visits = defaultdict(list)
        places = [_places(route) for route in routes]
        for other, own in enumerate(places):
            for index, place in enumerate(own):
                visits[place].append((other, index))
        released, cleared = self.channels["released"], self.channels["cleared"]
        for robot, count, samples in self._open(window):
            here = places[robot][count]
            ahead = next((place for place in places[robot][count:] if place != here), None)
            for other, index in visits.get(ahead, ()) if ahead else ():
                if other != robot:
                    holds = (released[samples, other] >= index) & (cleared[samples, other] <= index)
                    self._blame(samples[holds], robot, Reason.ROBOT, other)

    def _by_dependencies(self, plan: Plan, window: slice) -> None:
        """Name the first dependency of a plan that is not met, or the plan's time if that is what counts."""
        if not np.isin(self.reason[window], (Reason.ROBOT, Reason.UNKNOWN)).any():
            return
        holders = self.culprit[window].copy()
        self.culprit[window] = -1
        held = self.reason[window] == Reason.ROBOT
        if self._released_by_clock(plan, window):
            self.reason[window][held | (self.reason[window] == Reason.UNKNOWN)] = Reason.SCHEDULE
            return
        self.reason[window][held] = Reason.UNKNOWN
        graph = Dependencies(self.problem, plan)
        for robot, count, samples in self._open(window):
            move = graph.next_move(robot, count)
            if move is None:
                continue
            reason = Reason.ROTATION if graph.rotates(move) else Reason.ROBOT
            for other, needed, reached in reversed(graph.of(move)):  # the first in the plan is written last
                met = first_samples(self.channels["reached" if reached else "cleared"], other, needed)
                self._blame(samples[samples <= met], robot, reason, other)
        unknown = (self.reason[window] == Reason.UNKNOWN) & (holders >= 0)
        self.reason[window][unknown] = Reason.ROBOT
        self.culprit[window][unknown] = holders[unknown]

    def _released_by_clock(self, plan: Plan, window: slice) -> bool:
        tick = self.problem.roadmap.tick
        time, released = self.time[window] + 1e-9, self.channels["released"][window]
        due = [np.searchsorted(path.enter * tick, time, side="right") for path in plan.paths]
        return bool((released == np.stack(due, axis=1)).all()) if due else False


def _places(route: Route) -> list[tuple[int, int, int]]:
    """Waypoints in millimetres, with their levels, to compare them."""
    millimetres = np.rint(route.waypoint[:, :2] * 1000).astype(int).tolist()
    return [(x, y, level) for (x, y), level in zip(millimetres, route.level.tolist(), strict=True)]
