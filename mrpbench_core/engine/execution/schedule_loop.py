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

from mrpbench_core.config.faults import Faults
from mrpbench_core.engine.execution.delays import DelayStream
from mrpbench_core.engine.execution.ending import Ending
from mrpbench_core.engine.execution.faults import FaultState
from mrpbench_core.engine.execution.recorder import Recorder, Sample
from mrpbench_core.engine.execution.schedule import Schedule
from mrpbench_core.engine.execution.standstill import Standstill
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int16, Int32, frozen_array
from mrpbench_core.model.execution.motion import Event, Mode, Motion
from mrpbench_core.model.execution.orders import FleetView, Orders
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Resource


class ScheduleLoop:
    """Executes the plan of a run, control period by control period.

    Raises:
        BrokenContractError: the dispatcher returned what its contract rules out.
        DispatchError: the dispatcher refuses the plan, if it starts anew.
    """

    def __init__(
        self,
        schedule: Schedule,
        delays: DelayStream,
        recorder: Recorder | None = None,
        faults: FaultState | None = None,
    ) -> None:
        """Begin an execution.

        Args:
            schedule: the plan, and who releases it.
            delays: of the robots.
            recorder: of what happens; without it neither samples nor contacts are found, which is faster.
            faults: of the robots; none by default.
        """
        context = schedule.context
        self._schedule = schedule
        self._faults = faults or FaultState(Faults(), (), len(context.problem))
        self._standstill = Standstill(self._faults.settings.patience, len(context.problem))
        self._period, self._delays, self._recorder = context.period, delays, recorder
        self._session, self._checks, self._paths = schedule.session(), schedule.checks(), schedule.paths
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
        return self._standstill.update(now, progress, self._faults.final, self._delays.stopped)

    def _ending(self, arrived: Bool, pose: Float) -> Ending | None:
        """The fleet at the end, if there are faults."""
        if not self._faults:
            return None
        return Ending(
            problem=self._schedule.context.problem,
            plan=self._schedule.plan,
            names=self._schedule.context.fleet.names,
            faults=self._faults,
            orders=self._orders,
            motion=self._motion,
            pose=pose,
            granted=self._resources.granted,
            holders=self._resources.holders,
            arrived=arrived,
            gave_up={},
            dispatcher_waits_for=lambda robot: self._checks.waits_for(self._session.waits_for(robot)),
        )

    def _speed(self) -> Float:
        """Relative speed f8[n] of each robot on its segment."""
        relative = self._delays.speed(self._reached) * self._faults.speed
        if len(self._orders.speed):
            relative = np.minimum(relative, self._orders.speed * self._paths.pace[self._paths.rows(self._reached)])
        return relative

    def _advance(self) -> Bool:
        """Let one control period pass; return which robots have moved."""
        released = self._faults.received(self._orders.released).astype(np.int64)
        for blockage in self._faults.blockages:
            released = np.minimum(released, self._paths.before(blockage, self._reached, self._done > 0, self._radius))
        duration = self._paths.duration[self._paths.rows(self._reached)]
        while (waits := (self._reached < released) & (duration == 0)).any():
            self._reached[waits] += 1
            duration = self._paths.duration[self._paths.rows(self._reached)]
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
            duration = self._paths.duration[self._paths.rows(self._reached)]
            speed = np.where(ends, self._speed(), speed)
        return moved

    def _look(self, moved: Bool) -> None:
        """What the dispatcher and the recording are told of the robots' progress."""
        cleared = self._paths.cleared(self._paths.rows(self._reached), self._reached, self._done)
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
        level = self._paths.level[self._paths.rows(self._reached)]
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
