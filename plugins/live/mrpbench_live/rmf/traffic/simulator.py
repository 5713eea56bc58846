"""The simulator `rmf`: outside robots are the robots of a run."""

import sys
from collections.abc import Sequence
from typing import ClassVar

import attrs
import numpy as np
from attrs.validators import ge, gt

from mrpbench_core.api import (
    Facilities,
    Fleet,
    Float,
    InputError,
    Inputs,
    Int16,
    ScanBatch,
    Simulation,
    Simulator,
    State,
    World,
    option,
)
from mrpbench_live.fleet.overlaps import Overlaps
from mrpbench_live.fleet.pace import Pace
from mrpbench_live.fleet.tracking import Tracker
from mrpbench_live.rmf.messages import messages_of
from mrpbench_live.rmf.traffic.shared import share
from mrpbench_live.rmf.traffic.traffic import Traffic
from mrpbench_live.rmf.wire import Wire


@attrs.frozen(kw_only=True)
class RmfRobots(Simulator):
    """Outside robots of next-generation Open-RMF over DDS: what they report as odometry counts as the truth.

    A participant is the robot of its name. The recorded robot drives from report to report within the limits of its
    model. Contacts are overlaps of the bodies at these poses.
    """

    live: ClassVar[bool] = True

    domain: int = option(0, help="DDS domain, the ROS_DOMAIN_ID of the other side", validator=ge(0))
    pace: float = option(1.0, help="simulated seconds per second of wall time", validator=gt(0))
    patience: float = option(30.0, help="wall time to wait for all robots", unit="s", validator=gt(0))
    messages: str = option("", help="file of message definitions; empty: those of mrpbench-live")

    def open(
        self,
        world: World,
        fleet: Fleet,
        placements: Float,
        seed: int,
        period: float,
        movers: Sequence[float] = (),
        levels: Int16 | None = None,
    ) -> Simulation:
        """Wait for the robots.

        Raises:
            InputError: a robot is missing or elsewhere; or the world has doors, lifts or movers.
        """
        del seed
        if Facilities(world).names:
            raise InputError("simulator: `rmf` has no doors and no lifts, and the world has")
        if movers:
            raise InputError("simulator: `rmf` has no crowds: leave out `crowds`")
        messages = messages_of(self.messages)
        wire = Wire(messages, self.domain)
        traffic = Traffic(messages, wire, fleet.names)
        starts = dict(zip(fleet.names, map(tuple, placements[:, :2].tolist()), strict=True))
        try:
            traffic.participants.meet(starts, self.patience)
        except BaseException:
            wire.close()
            raise
        share(traffic)
        on = np.zeros(len(fleet), np.int16) if levels is None else levels
        return _Reported(traffic, Pace(self.pace), fleet, placements, on, period)


class _Reported(Simulation):
    """The robots as they report themselves."""

    def __init__(
        self, traffic: Traffic, pace: Pace, fleet: Fleet, placements: Float, levels: Int16, period: float
    ) -> None:
        self._traffic, self._pace, self._period, self._steps = traffic, pace, period, 0
        self._tracker = Tracker(fleet.robots, placements, period)
        self._levels, self._overlaps, self._closed = levels, Overlaps(fleet.robots), False
        self._state = State(
            pose=placements.copy(), twist=np.zeros((len(fleet), 2)), level=levels, contacts=np.empty((0, 2), np.int32)
        )

    @property
    def state(self) -> State:
        return self._state

    def step(self, inputs: Inputs) -> State:
        """Listen until the control period is over; the commands are for simulators."""
        del inputs
        self._steps += 1
        now = self._steps * self._period
        if self._steps == 1:
            self._pace.due(0.0)
        self._traffic.wire.serve(self._pace.due(now))
        if change := self._pace.change(now):
            sys.stderr.write(f"at {now:.1f} s: {change}\n")
        for robot, it in enumerate(self._traffic.participants.robots):
            if it.pose is not None:
                self._tracker.report(robot, *it.pose, it.speed)
        self._tracker.step()
        pose = self._tracker.pose
        contacts = self._overlaps.of(pose, self._levels)
        self._state = State(pose=pose, twist=self._tracker.twist, level=self._levels, contacts=contacts)
        return self._state

    def scans(self) -> tuple[ScanBatch, ...]:
        return ()

    def close(self) -> None:
        if not self._closed:
            self._closed = True
            share(None)
            self._traffic.wire.close()
