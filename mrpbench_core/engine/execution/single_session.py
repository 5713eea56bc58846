"""An ordinary session of a dispatcher in one execution without physics: what it is shown, and what it orders."""

import numpy as np

from mrpbench_core.engine.contract_checks import ContractChecks
from mrpbench_core.engine.execution.failure_reasons import FailureReasons
from mrpbench_core.engine.execution.faults import FaultState
from mrpbench_core.engine.execution.recorder import Recorder
from mrpbench_core.engine.execution.resources import PlannedResources
from mrpbench_core.engine.execution.schedule import Schedule
from mrpbench_core.engine.execution.scheduled_fleet import ScheduledFleet
from mrpbench_core.model.common.arrays import Bool, Float, Int16, Int32, frozen_array
from mrpbench_core.model.common.intervals import overlapping
from mrpbench_core.model.execution.motion import Mode, Motion
from mrpbench_core.model.execution.orders import BatchOrders, FleetView, Orders
from mrpbench_core.model.execution.state import State


class SingleSession:
    """Shows a session the fleet, grants what it requests, and hands on its orders as those of a batch of one.

    Args:
        schedule: begins the session.
        checks: of what it returns.
        fleet: of one execution.
        faults: of the robots.
        recorder: None = neither speeds nor contacts are computed.
    """

    def __init__(
        self,
        schedule: Schedule,
        checks: ContractChecks,
        fleet: ScheduledFleet,
        faults: FaultState,
        recorder: Recorder | None,
    ) -> None:
        self._schedule, self._checks, self._fleet, self._faults = schedule, checks, fleet, faults
        self._recorded, self._paths, self._period = recorder is not None, schedule.paths, schedule.context.period
        self._session = schedule.session()
        robots = len(schedule.context.problem)
        self.resources = PlannedResources(schedule.context.problem)
        self._returned = self.orders = Orders(released=np.zeros(robots, "i4"))
        self._batch = BatchOrders(released=self.orders.released[None].astype(np.int64))
        self._commands = frozen_array(np.zeros((robots, 2)), "f8", 2)
        self._pose = self._paths.pose(fleet.reached, fleet.done)
        self.look()

    def look(self) -> None:
        """Take in where the robots are, one control period after the last call."""
        fleet, before = self._fleet, self._pose
        self._pose = pose = self._paths.pose(fleet.reached, fleet.done)
        level = self._paths.level[self._paths.rows(fleet.reached)]
        twist, contacts = self._commands, _NONE
        if self._recorded:
            moved = pose[:, :2] - before[:, :2]
            twist = np.column_stack([np.hypot(moved[:, 0], moved[:, 1]) / self._period, np.zeros(len(pose))])
            contacts = _overlaps(pose, level, self._schedule.context.problem.radius)
        self.state = State(pose=pose, twist=twist, level=level, contacts=contacts)
        self.motion = Motion(
            twist=self._commands,
            reached=fleet.reached.astype(np.int32),
            cleared=fleet.cleared.astype(np.int32),
            mode=np.where(fleet.moves, Mode.FOLLOWING, Mode.WAITING).astype("u1"),
        )

    def update(self, now: float) -> BatchOrders:
        """The orders now."""
        motion, state = self.motion, self.state
        view = FleetView(
            revision=0,
            reached=motion.reached,
            cleared=motion.cleared,
            pose=state.pose,
            level=state.level,
            mode=motion.mode,
            granted=self.resources.ready,
        )
        returned = self._session.update(now, self._faults.reported_view(view))
        if returned is not self._returned:  # orders cannot be changed, so these are checked once
            self._returned, self.orders = returned, self._checks.orders(returned)
            members = [
                (group, 0, robot, segment) for group, each in enumerate(self.orders.in_step) for robot, segment in each
            ]
            self._batch = BatchOrders(
                released=self.orders.released[None].astype(np.int64), in_step=np.reshape(members, (-1, 4))
            )
        self.resources.assign(now, self.orders.requests, self._faults.broken)
        return self._batch

    def failure_reasons(self, arrived: Bool) -> FailureReasons:
        """The fleet at the end, where robots that have `arrived` bool[n] do not explain themselves."""
        context = self._schedule.context
        return FailureReasons(
            problem=context.problem,
            plan=self._schedule.plan,
            names=context.fleet.names,
            faults=self._faults,
            orders=self.orders,
            motion=self.motion,
            pose=self.state.pose,
            granted=self.resources.ready,
            holders=self.resources.holders,
            arrived=arrived,
            gave_up={},
            dispatcher_waits_for=lambda robot: self._checks.waits_for(self._session.waits_for(robot)),
        )


_NONE = frozen_array(np.empty((0, 2)), "i4", 2)


def _overlaps(pose: Float, level: Int16, radius: Float) -> Int32:
    """The pairs i4[k,2] of robots whose footprints overlap."""
    one, other = overlapping(pose[:, 0], pose[:, 0] + 2 * radius.max(initial=0.0))
    x, y = pose[one, 0] - pose[other, 0], pose[one, 1] - pose[other, 1]
    touch = (np.hypot(x, y) - radius[one] - radius[other] < -1e-6) & (level[one] == level[other])
    return np.sort(np.column_stack([one[touch], other[touch]]), axis=1).astype(np.int32)
