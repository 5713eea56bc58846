"""Why robots wait during an execution, and for what."""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from enum import IntEnum
from typing import Any

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.dependencies import Dependencies, first_samples
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.runs.plans import RecordedPlan, spans
from mrpbench_core.model.runs.recording import POSES, pose_channel
from mrpbench_core.model.runs.run import Loaders, RunContext
from mrpbench_core.model.runs.standing import nearest, standing

NEEDED = frozenset({"time", "mode", "reached", "cleared", "released"})
"""Channels without which nothing can be said, besides one of `POSES`."""
EVENT_ROWS = "event_time", "event_kind", "event_robot", "event_detail"
EVENTS = frozenset(EVENT_ROWS)
OPTIONAL = EVENTS | {*POSES, "level", "waits_for"}


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
    DELAY = 11
    """The robot stops by `delays:` although its way is released."""


@attrs.frozen(kw_only=True)
class Waits:
    """Reasons and culprits."""

    reason: Int
    """u1[T,n] of `Reason`."""
    culprit: Int32
    """i4[T,n]: robot or resource, -1 = none."""


def explain_waits(context: RunContext, channels: Loaders, plans: Sequence[RecordedPlan]) -> Waits | None:
    """Return why each robot waits at each sample; None if progress, modes or poses were not recorded.

    The reason is a dependency of the current plan that is not met. Where nothing is known of that plan but its routes,
    the reason is the robot that holds the next waypoint.

    Args:
        context: of the run.
        channels: of its recording.
        plans: of this execution, see `read_plans`.
    """
    if not channels.keys() >= NEEDED or pose_channel(channels) is None:
        return None
    loaded = {name: load() for name, load in channels.items() if name in NEEDED | OPTIONAL}
    if any(len(plan.routes) != loaded["mode"].shape[1] for plan in plans):
        return None
    waits = _Explanation(context.problem, loaded, plans).waits(_pending(loaded, context.latency))
    waits = _with_blocked(waits, loaded, np.array([robot.radius for robot in context.fleet.robots]))
    return _with_delays_and_faults(waits, loaded) if loaded.keys() >= EVENTS else waits


def _with_blocked(waits: Waits, channels: Mapping[str, Any], radius: Float) -> Waits:
    """Add the robots that stand although their way is released."""
    pose = channels[pose_channel(channels) or POSES[0]]
    mode, reached, released = (channels[name] for name in ("mode", "reached", "released"))
    blocked = (mode == Mode.FOLLOWING) & (reached < released) & standing(channels["time"], pose)
    near = nearest(blocked, pose, channels.get("level", np.zeros_like(reached)), radius)
    return Waits(reason=np.where(blocked, Reason.BLOCKED, waits.reason), culprit=np.where(blocked, near, waits.culprit))


def _with_delays_and_faults(waits: Waits, channels: Mapping[str, Any]) -> Waits:
    """Add the robots that stop by `delays` on released segments, and those that are out of order (`engine.execution`).

    A robot that also waits for something else loses no time by its delay.
    """
    time, reason, culprit = channels["time"], waits.reason.copy(), waits.culprit.copy()
    free = np.isin(reason, (Reason.NONE, Reason.START, Reason.BLOCKED))
    free &= (channels["reached"] < channels["released"]) & (channels["mode"] != Mode.ABORTED)
    faults: dict[int, int] = defaultdict(int)
    stopped = np.zeros(reason.shape, bool)
    for at, kind, robot, detail in zip(*(channels[name].tolist() for name in EVENT_ROWS), strict=True):
        first = int(np.searchsorted(time, at - 1e-9))
        if kind == "delay" and robot >= 0:
            last = int(np.searchsorted(time, at + _seconds(detail) - 1e-9))
            rows = first + np.flatnonzero(free[first:last, robot])
            reason[rows, robot], culprit[rows, robot] = Reason.DELAY, -1
        elif kind in ("fault", "fault_over") and robot >= 0 and detail.startswith("stops"):
            faults[robot] += 1 if kind == "fault" else -1
            stopped[first:, robot] = faults[robot] > 0
    return Waits(reason=np.where(stopped, Reason.FAULT, reason), culprit=np.where(stopped, -1, culprit))


def _seconds(detail: str) -> float:
    """The length of a delay; 0 where others recorded something else."""
    try:
        return float(detail.removesuffix(" s"))
    except ValueError:
        return 0.0


def _pending(channels: Mapping[str, Any], latency: float) -> Bool:
    """Tell at which samples bool[T] a new plan was pending."""
    time = channels["time"]
    pending = np.zeros(len(time), bool)
    if channels.keys() >= EVENTS:
        stamps = channels["event_time"][np.char.startswith(channels["event_kind"], "replan")]
        for stamp in stamps.tolist():
            pending |= (time >= stamp - latency - 1e-9) & (time <= stamp + 1e-9)
    return pending


class _Explanation:
    def __init__(self, problem: Problem, channels: Mapping[str, Any], plans: Sequence[RecordedPlan]) -> None:
        self.problem, self.channels = problem, channels
        self.time: Float = channels["time"]
        self.windows = spans(plans, self.time)
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

    def _by_holders(self, routes: Sequence[Route], window: slice) -> None:
        """Name the robot that was let onto the next waypoint and has not cleared it."""
        visits = defaultdict(list)
        places = [_places(route) for route in routes]
        for other, held_places in enumerate(places):
            for index, place in enumerate(held_places):
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
        self._by_passing(graph, window)

    def _by_passing(self, graph: Dependencies, window: slice) -> None:
        """Name the robot that passed the next vertex first, although it comes later in the plan (see `switches`)."""
        moves, reached, cleared = graph.moves, self.channels["reached"], self.channels["cleared"]
        for robot, count, samples in self._open(window):
            move = graph.next_move(robot, count)
            if move is None:
                continue
            came = first_samples(reached, robot, int(moves.segment[move]) + 1)
            for visit in np.flatnonzero((moves.head == moves.head[move]) & (moves.robot != robot)).tolist():
                other = int(moves.robot[visit])
                leaves = graph.next_move(other, int(moves.segment[visit]) + 1)
                if leaves is not None and first_samples(reached, other, int(moves.segment[visit]) + 1) < came:
                    gone = first_samples(cleared, other, int(moves.segment[leaves]) + 1)
                    self._blame(samples[samples < gone], robot, Reason.ROBOT, other)

    def _released_by_clock(self, plan: Plan, window: slice) -> bool:
        tick = self.problem.roadmap.tick
        time, released = self.time[window] + 1e-9, self.channels["released"][window]
        due = [np.searchsorted(path.enter * tick, time, side="right") for path in plan.paths]
        return bool((released == np.stack(due, axis=1)).all()) if due else False


def _places(route: Route) -> list[tuple[int, int, int]]:
    """Waypoints in millimetres, with their levels, to compare them."""
    millimetres = np.rint(route.waypoint[:, :2] * 1000).astype(int).tolist()
    return [(x, y, level) for (x, y), level in zip(millimetres, route.level.tolist(), strict=True)]
