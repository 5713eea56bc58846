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

import numpy as np

from mrpbench_core.api.dispatcher import BatchSession
from mrpbench_core.config.faults import Faults
from mrpbench_core.engine.execution.control_loop import ControlLoop, ExecutionResult
from mrpbench_core.engine.execution.delays import DelayStream
from mrpbench_core.engine.execution.faults import FaultState
from mrpbench_core.engine.execution.recorder import Recorder, Sample
from mrpbench_core.engine.execution.schedule import Schedule
from mrpbench_core.engine.execution.scheduled_fleet import ScheduledFleet
from mrpbench_core.engine.execution.single_session import SingleSession
from mrpbench_core.engine.execution.standstill import Standstill
from mrpbench_core.model.common.arrays import Bool, Float, Int


class ScheduleLoop(ControlLoop):
    """Executes the plan of a run under each draw of `delays`, all by one clock.

    Args:
        schedule: the plan, and who releases it.
        delays: of d draws.
        limit_s: simulated seconds after which the executions end.
        recorder: of what happens, in one execution; without it neither samples nor contacts are computed.
        faults: of the robots, in one execution; none by default.
        batch: releases the plan in d executions; None = an ordinary session does, in one.

    Raises:
        BrokenContractError: the dispatcher returned what its contract rules out.
        DispatchError: the dispatcher refuses the plan, if it starts anew.
    """

    def __init__(
        self,
        schedule: Schedule,
        delays: DelayStream,
        limit_s: float,
        recorder: Recorder | None = None,
        faults: FaultState | None = None,
        batch: BatchSession | None = None,
    ) -> None:
        robots, executions = len(schedule.context.problem), delays.executions
        faults = faults or FaultState(Faults(), (), robots)
        super().__init__(schedule.context.period, limit_s, faults, delays, recorder)
        self._paths, self._radius, self._checks = schedule.paths, schedule.context.problem.radius, schedule.checks()
        self._fleet = ScheduledFleet(schedule.paths, executions, self._speed)
        self._batch = batch
        self._single = None if batch else SingleSession(schedule, self._checks, self._fleet, faults, recorder)
        self._standstill = Standstill(faults.settings.patience, robots)
        self._last: Int = np.tile(schedule.paths.last_move, executions)
        self._candidates = np.arange(robots * executions)
        """The robots that may have moved in the last control period."""
        self._arrived: Bool = np.zeros(robots * executions, bool)
        self.arrival: Float = np.full((executions, robots), np.nan)
        """Simulated seconds f8[d,n] at which each robot has completed its last move; NaN = it has not."""
        self.waiting: Float = np.zeros((executions, robots))
        """Simulated seconds f8[d,n] in which each robot has completed all that is released, and is not there yet."""

    def _dispatch(self) -> None:
        if self._single is not None:
            self._orders = self._single.update(self._now)
        elif self._batch is not None:
            counts = self._fleet.counts.reshape(2, *self.arrival.shape).copy()
            self._orders = self._checks.batch(self._batch.update(self._now, counts), len(self.arrival))

    def _drive(self) -> None:
        events = self._delays.attacked(self._now, self._fleet.reached, self._orders.released.reshape(-1))
        if self._recorder is not None:
            self._recorder.events(events)

    def _result(self) -> ExecutionResult | None:
        moved, reached = self._candidates, self._fleet.reached
        came = moved[~self._arrived[moved] & (reached[moved] >= self._last[moved])]
        self._arrived[came] = True
        self.arrival.reshape(-1)[came] = self._now
        done = self._arrived
        if self._recorder is None and not self._faults:
            self._delays.forget(came)
        elif self._faults:
            done = done | self._faults.lost
        if not (done.all() or self._now >= self._limit_s or self._stands_still()):
            return None
        unarrived = {}
        if self._faults and self._single is not None:
            unarrived = self._single.failure_reasons(self._arrived).reasons()
        return ExecutionResult(succeeded=bool(self._arrived.all()), simulated_s=self._now, unarrived=unarrived)

    def _stands_still(self) -> bool:
        """Tell whether nothing goes on any more because of faults that do not end."""
        if not self._faults:
            return False
        fleet = self._fleet
        progress = (int(fleet.reached.sum()), float(fleet.done.sum()), int(self._orders.released.sum()))
        return self._standstill.update(self._now, progress, self._faults.final, self._delays.stopped)

    def _record(self, recorder: Recorder, last: bool) -> None:
        single = self._single
        assert single is not None
        sample = Sample(
            now=self._now,
            state=single.state,
            orders=single.orders,
            motion=single.motion,
            waits_for=single.resources.waits_for(),
        )
        recorder.sample(self._step, sample, last)

    def _advance(self) -> None:
        fleet, released = self._fleet, self._orders.released.reshape(-1)
        waits = ~self._arrived & (fleet.reached >= released)
        waiting = self.waiting.reshape(-1)
        np.add(waiting, self._period, out=waiting, where=waits)
        stopped = self._delays.stopped
        if self._faults:
            stopped = stopped | self._faults.stopped
            released = self._faults.received(released.astype(np.int32)).astype(np.int64)
            for blockage in self._faults.blockages:
                before = self._paths.before(blockage, fleet.reached, fleet.done > 0, self._radius)
                released = np.minimum(released, before)
        left = np.where(stopped, 0.0, self._period)
        self._candidates = fleet.advance(released, self._orders.in_step, left, self._period)
        if self._single is not None:
            self._single.look()
            self._state = self._single.state

    def _speed(self, robots: Int, segment: Int) -> Float:
        """Relative speed f8[j] of each of `robots` on a `segment` i8[j] of its path."""
        speed = self._delays.speed(robots, segment)
        if self._faults:
            speed = speed * self._faults.speed[robots]
        if self._single is not None and len(limit := self._single.orders.speed):
            speed = np.minimum(speed, limit[robots] * self._paths.pace[self._fleet.first[robots] + segment])
        return speed
