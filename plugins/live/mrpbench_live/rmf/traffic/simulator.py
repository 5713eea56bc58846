"""The simulator `rmf`: outside robots are the robots of a run."""

from collections.abc import Iterator, Sequence
from typing import ClassVar

import attrs
import numpy as np
from attrs.validators import ge, gt

from mrpbench_core.api import (
    Fleet,
    Float,
    Int16,
    Simulation,
    Simulator,
    World,
    option,
)
from mrpbench_live.fleet.pace import Pace
from mrpbench_live.fleet.reported import OutsideRobots, ReportedFleet, refuse_surroundings
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
        refuse_surroundings("rmf", world, movers)
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
        return ReportedFleet(_Robots(traffic), Pace(self.pace), fleet, placements, on, period)


class _Robots(OutsideRobots):
    """The participants of the domain."""

    def __init__(self, traffic: Traffic) -> None:
        self._traffic = traffic

    def serve(self, due: float) -> None:
        self._traffic.serve(due)

    def reports(self) -> Iterator[tuple[int, float, float, float, float]]:
        for robot, it in enumerate(self._traffic.participants.robots):
            if it.pose is not None:
                yield robot, *it.pose, it.speed

    def route(self, robot: int) -> Float:
        return self._traffic.places(robot)

    def close(self) -> None:
        share(None)
        self._traffic.wire.close()
