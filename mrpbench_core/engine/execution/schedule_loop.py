"""Executes a plan without physics: each move takes the duration of the plan, and longer where its robot is late.

Robots stay on their paths, so this shows what a dispatcher makes of delays, and nothing else. They pass through one
another if the dispatcher lets them; the recording has that as contacts.

- A robot makes each move within what is released at the relative speed of `DelayStream.speed`, and stands while it
  stops. Waits take no time, because a dispatcher releases a robot when it may go on.
- It makes a move no faster than the speed limit that the dispatcher sets (`Orders.speed`).
- A robot has cleared the start of a move when it is its own radius and the largest one of the fleet away from it, as
  the navigator `waypoints` reports it, or at the end of a shorter move.
- Robots that rotate (`Orders.in_step`) move when none of them stops, as fast as the slowest of them.
- A door, lift or mutex is granted to the robot that has requested it longest as soon as there is room, but not before
  its `setup_ticks` have passed since the last robot left it, and not while it is out of order.
- No robot begins a move that leads it to a blocked place.
"""

from collections.abc import Mapping, Sequence, Set

import numpy as np

from mrpbench_core.api.dispatcher import Dispatcher
from mrpbench_core.config.faults import Faults
from mrpbench_core.engine.contract_checks import ContractChecks
from mrpbench_core.engine.execution.delays import DelayStream
from mrpbench_core.engine.execution.faults import FaultEvent, FaultState, approaches
from mrpbench_core.engine.execution.recorder import Recorder, Sample
from mrpbench_core.engine.execution.standstill import Ending, Standstill
from mrpbench_core.engine.own import own
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int16, Int32, frozen_array
from mrpbench_core.model.execution.motion import Event, Mode, Motion
from mrpbench_core.model.execution.orders import FleetView, Orders
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Resource
from mrpbench_core.model.runs.run import RunContext


class ScheduleLoop:
    """Executes the plan of a run, control period by control period.

    Raises:
        BrokenContractError: the dispatcher returned what its contract rules out.
        DispatchError: the dispatcher refuses the plan.
    """

    def __init__(
        self,
        context: RunContext,
        dispatcher: Dispatcher,
        delays: DelayStream,
        recorder: Recorder | None = None,
        faults: FaultState | None = None,
    ) -> None:
        """Begin an execution.

        Args:
            context: of the run, with a plan.
            dispatcher: releases the plan.
            delays: of the robots.
            recorder: of what happens; without it neither samples nor contacts are found, which is faster.
            faults: of the robots; none by default.
        """
        plan = context.result.plan
        assert plan is not None
        self._context = context
        self._faults = faults or FaultState(Faults(), (), len(context.problem))
        self._standstill = Standstill(self._faults.settings.patience)
        self._period, self._delays, self._recorder = context.period, delays, recorder
        self._session = dispatcher.start(own(context.problem), own(plan))
        self._checks = ContractChecks(np.array([len(path) for path in plan.paths], np.int64))
        self._paths = _Paths(context)
        self._resources = _Resources(context.problem)
        robots = len(context.problem)
        self._reached: Int = np.zeros(robots, np.int64)
        self._done: Float = np.zeros(robots)
        """Seconds f8[n] of the planned duration that each robot has made of its present move."""
        self._cleared: Int = np.zeros(robots, np.int64)
        self._returned = self._orders = Orders(released=np.zeros(robots, "i4"))
        self._radius = context.problem.radius
        self.arrival: Float = np.full(robots, np.nan)
        """Simulated seconds f8[n] at which each robot has completed its last move; NaN = it has not."""
        self.waiting: Float = np.zeros(robots)
        """Simulated seconds f8[n] in which each robot has completed all that is released, and is not there yet."""
        self._commands = frozen_array(np.zeros((robots, 2)), "f8", 2)
        self._look(moved=np.zeros(robots, bool))

    def run(self, limit_s: float) -> tuple[bool, float]:
        """Run until all robots have arrived or `limit_s` simulated seconds are over.

        Returns:
            Whether all have arrived, and the simulated seconds.
        """
        step, pose = 0, self._pose()
        state = self._state(pose, pose)
        while True:
            now, pose = step * self._period, state.pose
            events = [*self._delays.begun(now), *self._faults.update(now)]
            view = FleetView(
                revision=0,
                reached=self._motion.reached,
                cleared=self._motion.cleared,
                pose=pose,
                level=state.level,
                mode=self._motion.mode,
                granted=self._resources.granted,
            )
            returned = self._session.update(now, self._faults.heard(view))
            if returned is not self._returned:  # orders cannot be changed, so these are checked once
                self._returned, self._orders = returned, self._checks.orders(returned)
            events += self._delays.attacked(now, self._reached, self._orders.released)
            self._resources.assign(now, self._orders.requests, self._faults.broken)
            arrived = self._reached >= self._paths.last_move
            self.arrival[arrived & np.isnan(self.arrival)] = now
            last = bool((arrived | self._faults.lost).all()) or now >= limit_s or self._stands_still(now)
            self._record(step, now, state, events, last)
            if last:
                self.ending = self._ending(arrived, pose)
                return bool(arrived.all()), now
            self.waiting[~arrived & (self._reached >= self._orders.released)] += self._period
            self._look(moved=self._advance())
            state = self._state(self._pose(), pose)
            step += 1
            if self._recorder is not None:
                self._recorder.contacts(step * self._period, state)

    def _record(self, step: int, now: float, state: State, events: list[Event], last: bool) -> None:
        """Record the events and the sample of a control period."""
        if self._recorder is None:
            return
        self._recorder.events(events)
        waits_for = self._resources.waits_for()
        sample = Sample(now=now, state=state, orders=self._orders, motion=self._motion, waits_for=waits_for)
        self._recorder.sample(step, sample, last)
        if last:
            self._recorder.flush()

    def _stands_still(self, now: float) -> bool:
        """Tell whether nothing goes on any more because of faults that do not end."""
        if not self._faults:
            return False
        progress = (int(self._reached.sum()), float(self._done.sum()), int(self._orders.released.sum()))
        return self._standstill.update(now, progress, self._faults.final and not self._delays.stopped.any())

    def _ending(self, arrived: Bool, pose: Float) -> Ending | None:
        """The fleet at the end, if there are faults."""
        if not self._faults:
            return None
        assert self._context.result.plan is not None
        return Ending(
            problem=self._context.problem,
            plan=self._context.result.plan,
            names=self._context.fleet.names,
            faults=self._faults,
            orders=self._orders,
            motion=self._motion,
            pose=pose,
            granted=self._resources.granted,
            holders=self._resources.holders,
            arrived=arrived,
            gave_up={},
        )

    def _speed(self) -> Float:
        """Relative speed f8[n] of each robot on its segment."""
        relative = self._delays.speed(self._reached) * self._faults.speed
        if len(self._orders.speed):
            relative = np.minimum(relative, self._orders.speed * self._paths.pace(self._reached))
        return relative

    def _advance(self) -> Bool:
        """Let one control period pass; return which robots have moved."""
        released = self._faults.received(self._orders.released).astype(np.int64)
        for blockage in self._faults.blockages:
            released = np.minimum(released, self._paths.before(blockage, self._reached, self._done > 0, self._radius))
        duration = self._paths.duration(self._reached)
        while (waits := (self._reached < released) & (duration == 0)).any():
            self._reached[waits] += 1
            duration = self._paths.duration(self._reached)
        left = np.where(self._delays.stopped | self._faults.stopped, 0.0, self._period)
        speed = self._speed()
        moved = np.zeros(len(left), bool)
        for group in self._orders.in_step:
            robots, segments = (np.array(column) for column in zip(*group, strict=True))
            if (self._reached[robots] < segments).any():  # all begin together
                released[robots] = np.minimum(released[robots], segments)
            going = robots[self._reached[robots] == segments]
            left[going] = left[going].min(initial=self._period)
            speed[going] = speed[going].min(initial=np.inf)
        while (going := (self._reached < released) & ((left > 0) | (duration == 0))).any():
            needed = (duration - self._done) / speed
            ends = going & (needed <= left + 1e-9)
            moved |= going & (needed > 0)
            self._done += np.where(going & ~ends, left * speed, 0.0)
            if not ends.any():
                break
            left = np.where(ends, np.maximum(left - needed, 0.0), np.where(going, 0.0, left))
            self._reached += ends
            self._done[ends] = 0.0
            duration = self._paths.duration(self._reached)
            speed = np.where(ends, self._speed(), speed)
        return moved

    def _look(self, moved: Bool) -> None:
        """What the dispatcher and the recording are told of the robots' progress."""
        on_way = self._done >= self._paths.clearing(self._reached)
        cleared = np.where(on_way & (self._done > 0), self._reached + 1, self._paths.settled(self._reached))
        self._cleared = np.maximum(self._cleared, cleared)
        self._motion = Motion(
            twist=self._commands,
            reached=self._reached.astype(np.int32),
            cleared=self._cleared.astype(np.int32),
            mode=np.where(moved, Mode.FOLLOWING, Mode.WAITING).astype("u1"),
        )

    def _pose(self) -> Float:
        return self._paths.pose(self._reached, self._done)

    def _state(self, pose: Float, before: Float) -> State:
        """The state at a `pose` f8[n,3], one control period after the one `before`."""
        level = self._paths.level(self._reached)
        if self._recorder is None:
            return State(pose=pose, twist=self._commands, level=level, contacts=_NONE)
        moved = pose[:, :2] - before[:, :2]
        twist = np.column_stack([np.hypot(moved[:, 0], moved[:, 1]) / self._period, np.zeros(len(pose))])
        return State(pose=pose, twist=twist, level=level, contacts=_overlaps(pose, level, self._radius))


_NONE = frozen_array(np.empty((0, 2)), "i4", 2)


def _overlaps(pose: Float, level: Int16, radius: Float) -> Int32:
    """The pairs i4[k,2] of robots whose footprints overlap: a sweep along x."""
    order = np.argsort(pose[:, 0], kind="stable")
    along = pose[order, 0]
    count = np.searchsorted(along, along + 2 * radius.max(initial=0.0)) - np.arange(1, len(order) + 1)
    count = np.maximum(count, 0)
    one = np.repeat(np.arange(len(order)), count)
    other = order[np.arange(len(one)) - np.repeat(np.cumsum(count) - count, count) + one + 1]
    one = order[one]
    x, y = pose[one, 0] - pose[other, 0], pose[one, 1] - pose[other, 1]
    touch = (np.hypot(x, y) - radius[one] - radius[other] < -1e-6) & (level[one] == level[other])
    return np.sort(np.column_stack([one[touch], other[touch]]), axis=1).astype(np.int32)


class _Paths:
    """The segments of all paths, one path after another, each with one more entry for its end."""

    def __init__(self, context: RunContext) -> None:
        problem, plan = context.problem, context.result.plan
        assert plan is not None
        sizes = [len(path) + 1 for path in plan.paths]
        self._first = np.cumsum([0, *sizes[:-1]]).astype(np.int64)
        self.last_move: Int = np.array([route.last_move for route in context.routes], np.int64)
        self._point = np.concatenate([route.waypoint[:, :2] for route in context.routes]).reshape(-1, 2)
        self._level = np.concatenate([route.level for route in context.routes]).astype(np.int16)
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
        self._duration = np.concatenate(durations) if durations else np.empty(0)
        self._clearing, self._settled = np.concatenate(clearing), np.concatenate(settled)
        self._pace: Float = np.concatenate(paces)
        ahead = np.diff(self._point, axis=0, append=self._point[-1:])
        ahead[self._first[1:] - 1] = 0.0
        self._ahead = ahead
        self._blocked: dict[FaultEvent, Int] = {}
        """The segments, of all robots one after another, that lead to a blocked place."""
        starts = context.scenario.start[:, 2]
        self._yaw = _yaws(ahead, self._first, np.where(np.isnan(starts), 0.0, starts))

    def duration(self, segment: Int) -> Float:
        """Planned seconds f8[n] of each robot's `segment` i8[n], 0 for waits and ends."""
        found: Float = self._duration[self._first + segment]
        return found

    def pace(self, segment: Int) -> Float:
        """Planned seconds per metre f8[n] of each robot's `segment` i8[n], inf for turns, waits and ends."""
        found: Float = self._pace[self._first + segment]
        return found

    def clearing(self, segment: Int) -> Float:
        """Planned seconds f8[n] after which a robot has cleared the start of its `segment` i8[n]."""
        found: Float = self._clearing[self._first + segment]
        return found

    def settled(self, segment: Int) -> Int:
        """The segments i8[n] that a robot at the beginning of its `segment` has cleared: all before the last waits."""
        found: Int = self._settled[self._first + segment]
        return found

    def level(self, segment: Int) -> Int16:
        """The level i2[n] of each robot."""
        found: Int16 = self._level[self._first + segment]
        return found

    def before(self, blockage: FaultEvent, segment: Int, under_way: Bool, radius: Float) -> Int:
        """The first segment i8[n] of each robot, after the one `under_way`, that leads it to a blocked place."""
        if blockage not in self._blocked:
            owner = np.repeat(np.arange(len(self._first)), np.diff(np.append(self._first, len(self._point))))
            place, reach = np.array(blockage.place), radius[owner] + blockage.radius
            blocked = approaches(place, self._point, self._point + self._ahead, reach)
            rows = np.flatnonzero(blocked & (self._level == blockage.level))
            self._blocked[blockage] = np.append(rows, np.iinfo(np.int64).max)
        rows = self._blocked[blockage]
        found: Int = rows[np.searchsorted(rows, self._first + segment + under_way)] - self._first
        return found

    def pose(self, segment: Int, done: Float) -> Float:
        """The pose f8[n,3] of each robot that has made `done` f8[n] planned seconds of its `segment`."""
        at = self._first + segment
        share = done / np.maximum(self._duration[at], 1e-9)
        return np.column_stack([self._point[at] + share[:, None] * self._ahead[at], self._yaw[at]])


def _yaws(ahead: Float, first: Int, start: Float) -> Float:
    """The yaw f8[s] of each segment: along it, or as before where the robot does not move."""
    yaw = np.where((ahead != 0).any(axis=1), np.arctan2(ahead[:, 1], ahead[:, 0]), np.nan)
    begins = yaw[first]
    yaw[first] = np.where(np.isnan(begins), start, begins)
    known = np.maximum.accumulate(np.where(np.isnan(yaw), 0, np.arange(len(yaw))))
    held: Float = yaw[known]
    return held


class _Resources:
    """Grants doors, lifts and mutexes by the plan's model of them: capacities and setup times."""

    def __init__(self, problem: Problem) -> None:
        self._resources: dict[str, Resource] = {resource.name: resource for resource in problem.roadmap.resources}
        self._number = {name: number for number, name in enumerate(self._resources)}
        self._tick, self._robots = problem.roadmap.tick, len(problem)
        self._held: dict[str, list[int]] = {name: [] for name in self._resources}
        self.holders: Mapping[str, Sequence[int]] = self._held
        self._busy: dict[str, list[float]] = {name: [] for name in self._resources}
        """Times at which places that robots have left can be used again."""
        self._asked: Sequence[tuple[int, str]] = ()
        self.granted: tuple[tuple[int, str], ...] = ()

    def assign(self, now: float, requests: Sequence[tuple[int, str]], broken: Set[str] = frozenset()) -> None:
        """Take back what is no longer requested, and grant what there is room for, the longest requested first.

        What is `broken` is not granted to more robots.
        """
        self._asked = requests
        for name, holders in self._held.items():
            kept = [robot for robot in holders if (robot, name) in requests]
            free_at = now + self._resources[name].setup_ticks * self._tick
            busy = [time for time in self._busy[name] if time > now + 1e-9]
            self._busy[name] = busy + [free_at] * (len(holders) - len(kept))
            self._held[name] = kept
        for robot, name in requests:
            holders = self._held[name]
            in_setup = sum(time > now + 1e-9 for time in self._busy[name])
            if robot not in holders and name not in broken and len(holders) + in_setup < self._resources[name].capacity:
                holders.append(robot)
        self.granted = tuple((robot, name) for name, holders in self._held.items() for robot in holders)

    def waits_for(self) -> Int32:
        """The number i4[n] of the resource that each robot has asked for and not got, -1 = none."""
        waits: Int32 = np.full(self._robots, -1, np.int32)
        for robot, name in self._asked:
            if waits[robot] < 0 and (robot, name) not in self.granted:
                waits[robot] = self._number[name]
        return waits
