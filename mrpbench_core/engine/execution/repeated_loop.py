"""Executes a plan without physics under many draws of the delays at once, to the same times as `ScheduleLoop`.

All executions go on by one clock, so that each step of NumPy moves the robots of all of them. Robots are numbered
through all executions: robot i of execution j is number j n + i. Every number is computed by the same operations in the
same order as in `ScheduleLoop`, so arrivals are equal bit for bit. Faults and resources are left to it.
"""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.api.dispatcher import RepeatedSession
from mrpbench_core.engine.execution.delays import DrawnDelays
from mrpbench_core.engine.execution.schedule import Schedule
from mrpbench_core.engine.execution.worst_case import Adversary
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.execution.orders import RepeatedOrders


class RepeatedLoop:
    """Executes the plan of a run d times.

    Args:
        schedule: the plan.
        session: releases it in d executions.
        delays: of d draws.
        adversaries: one for each execution, or none.

    Raises:
        BrokenContractError: the dispatcher returned what its contract rules out.
    """

    def __init__(
        self, schedule: Schedule, session: RepeatedSession, delays: DrawnDelays, adversaries: Sequence[Adversary] = ()
    ) -> None:
        robots, count = len(schedule.context.problem), len(delays.stopped)
        self._session, self._checks, self._delays, self._adversaries = session, schedule.checks(), delays, adversaries
        self._period, self._paths = schedule.context.period, schedule.paths
        self._shape = count // robots, robots
        self._first: Int = np.tile(schedule.paths.first, self._shape[0])
        self._last: Int = np.tile(schedule.paths.last_move, self._shape[0])
        self._seen: Int = np.zeros((2, count), np.int64)
        self._reached, self._cleared = self._seen
        self._done: Float = np.zeros(count)
        """Seconds of the planned duration that each robot has made of its present move."""
        self._arrived: Bool = np.zeros(count, bool)
        self._arrival: Float = np.full(count, np.nan)
        self._waiting: Float = np.zeros(count)

    def run(self, limit_s: float) -> tuple[Float, Float]:
        """Run until all robots of all executions have arrived, or `limit_s` simulated seconds are over.

        Returns:
            Arrival f8[d,n] and waiting f8[d,n] as in `ScheduleLoop`.
        """
        step, moved = 0, np.arange(len(self._first))
        while True:
            now = step * self._period
            self._delays.begun(now)
            seen = self._seen.reshape(2, *self._shape).copy()
            orders = self._checks.repeated(self._session.update(now, seen), self._shape[0])
            released = orders.released.reshape(-1)
            came = moved[~self._arrived[moved] & (self._reached[moved] >= self._last[moved])]
            self._arrived[came], self._arrival[came] = True, now
            self._delays.forget(came)
            if self._arrived.all() or now >= limit_s:
                return self._arrival.reshape(self._shape), self._waiting.reshape(self._shape)
            np.add(self._waiting, self._period, out=self._waiting, where=~self._arrived & (self._reached >= released))
            moved = self._advance(released, orders, self._stopped(now, orders))
            step += 1

    def _stopped(self, now: float, orders: RepeatedOrders) -> Bool:
        """The robots that stop in this control period."""
        stopped = self._delays.stopped
        if not self._adversaries:
            return stopped
        reached = self._reached.reshape(self._shape)
        for execution, adversary in enumerate(self._adversaries):
            adversary.update(now, reached[execution], orders.released[execution])
        stopped |= np.concatenate([adversary.stopped for adversary in self._adversaries])
        return stopped

    def _advance(self, released: Int, orders: RepeatedOrders, stopped: Bool) -> Int:
        """Let one control period pass; return the robots that may have moved."""
        moved = np.flatnonzero(self._reached < released)
        waits = moved
        while len(waits := waits[self._durations(waits) == 0]):
            self._reached[waits] += 1
            waits = waits[self._reached[waits] < released[waits]]
        left = np.where(stopped, 0.0, self._period)
        if len(orders.in_step):
            released, slowest = released.copy(), np.full(len(left), np.inf)
            self._keep_in_step(orders.in_step, released, left, slowest)
        robots = moved[(self._reached[moved] < released[moved])]
        duration, left = self._durations(robots), left[robots]
        speed = self._delays.speed(robots, self._reached[robots])
        if len(orders.in_step):
            speed = np.minimum(speed, slowest[robots])
        going = (left > 0) | (duration == 0)
        robots, duration, left, speed = robots[going], duration[going], left[going], speed[going]
        done = self._done[robots]
        while len(robots):
            needed = (duration - done) / speed
            ends = needed <= left + 1e-9
            goes_on = ~ends
            self._done[robots[goes_on]] = (done + left * speed)[goes_on]
            robots, left = robots[ends], np.maximum(left - needed, 0.0)[ends]
            self._reached[robots] += 1
            self._done[robots] = 0.0
            duration = self._durations(robots)
            going = (self._reached[robots] < released[robots]) & ((left > 0) | (duration == 0))
            robots, duration, left = robots[going], duration[going], left[going]
            speed, done = self._delays.speed(robots, self._reached[robots]), np.zeros(len(robots))
        self._clear(moved)
        return moved

    def _keep_in_step(self, in_step: Int, released: Int, left: Float, slowest: Float) -> None:
        """Let the members of each group begin together, and then go as long and as fast as the slowest of them.

        `slowest` gets the speed of the slowest one of each robot's group.
        """
        group, execution, robot, segment = in_step.T
        robot = execution * self._shape[1] + robot
        count = int(group.max()) + 1
        apart = np.zeros(count, bool)
        apart[group[self._reached[robot] < segment]] = True
        held = apart[group]
        np.minimum.at(released, robot[held], segment[held])
        going = self._reached[robot] == segment
        group, robot = group[going], robot[going]
        least, pace = np.full(count, self._period), np.full(count, np.inf)
        np.minimum.at(least, group, left[robot])
        np.minimum.at(pace, group, self._delays.speed(robot, self._reached[robot]))
        left[robot], slowest[robot] = least[group], pace[group]

    def _clear(self, robots: Int) -> None:
        """Take note of what `robots` have cleared."""
        reached = self._reached[robots]
        cleared = self._paths.cleared(self._first[robots] + reached, reached, self._done[robots])
        self._cleared[robots] = np.maximum(self._cleared[robots], cleared)

    def _durations(self, robots: Int) -> Float:
        """Planned seconds of the present segment of each of `robots`."""
        found: Float = self._paths.duration[self._first[robots] + self._reached[robots]]
        return found
