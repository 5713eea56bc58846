"""What is known of outside robots, from what they publish."""

import math
import time
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import attrs

from mrpbench_core.api import InputError
from mrpbench_live.rmf.messages import PlanKey, plan_key
from mrpbench_live.rmf.wire import Wire

NEAR = 0.5
"""Metres from its start at which a robot has to stand at first."""
LOOK_S = 0.05
"""Seconds between two looks at who is there."""


@attrs.define
class Participant:
    """One robot."""

    pose: tuple[float, float, float] | None = None
    """x, y (metres), yaw (radians), of its newest odometry."""
    speed: float = 0.0
    """m/s forward."""
    progress: tuple[PlanKey, int] | None = None
    """The plan that it follows, and the waypoint of it that it has reached."""


class Participants:
    """The robots of a fleet, by their names.

    Args:
        wire: by which they are heard.
        names: of the robots of the run, which are those of the participants.
    """

    def __init__(self, wire: Wire, names: Sequence[str]) -> None:
        self._wire, self.names = wire, names
        self.robots = [Participant() for _ in names]
        self.destinations: dict[int, Any] = {}
        """The newest `Destination` of each robot that has come and was not looked at."""
        self.errors: dict[int, Any] = {}
        """The newest `PlanError` likewise."""
        for robot, name in enumerate(names):
            wire.advertise(f"{name}/plan")
            wire.advertise(f"{name}/plan/release")
            wire.advertise(f"{name}/destination/error")
            wire.subscribe(f"{name}/odom", partial(self._locate, robot))
            wire.subscribe(f"{name}/plan/progress", partial(self._hear, robot))
            wire.subscribe(f"{name}/destination", partial(self.destinations.__setitem__, robot))
            wire.subscribe(f"{name}/plan/error", partial(self.errors.__setitem__, robot))

    def meet(self, starts: Mapping[str, tuple[float, float]], patience: float) -> None:
        """Wait until all robots say where they are.

        Args:
            starts: x, y (metres) of the start of each robot.
            patience: seconds.

        Raises:
            InputError: a robot is silent, or elsewhere.
        """
        until = time.monotonic() + patience
        while silent := [name for name, it in zip(self.names, self.robots, strict=True) if it.pose is None]:
            if time.monotonic() > until:
                raise InputError(
                    f"rmf: {len(silent)} of {len(self.names)} robots publish no odometry, such as {silent[0]}/odom",
                    hint="start the robots first; both sides need one DDS domain",
                )
            self._wire.serve(time.monotonic() + LOOK_S)
        for name, robot in zip(self.names, self.robots, strict=True):
            assert robot.pose is not None
            x, y = starts[name]
            if math.hypot(robot.pose[0] - x, robot.pose[1] - y) > NEAR:
                raise InputError(
                    f"rmf: {name} is at ({robot.pose[0]:g}, {robot.pose[1]:g}), and its start is ({x:g}, {y:g})",
                    hint="give the scenario the places at which the robots stand",
                )

    def _locate(self, robot: int, odometry: Any) -> None:
        pose, turn = odometry.pose.pose, odometry.pose.pose.orientation
        yaw = math.atan2(2 * (turn.w * turn.z + turn.x * turn.y), 1 - 2 * (turn.y**2 + turn.z**2))
        values = (float(pose.position.x), float(pose.position.y), yaw)
        if all(map(math.isfinite, values)):
            self.robots[robot].pose, self.robots[robot].speed = values, float(odometry.twist.twist.linear.x)

    def _hear(self, robot: int, progress: Any) -> None:
        self.robots[robot].progress = plan_key(progress.plan_id), int(progress.reached_waypoint)
