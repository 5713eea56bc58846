"""The recovery `spin`: turn, so that the robot and its lidar face another way."""

import math

import attrs
import numpy as np
from attrs.validators import ge, gt

from mrpbench_core.api import option
from mrpbench_core.api.recovery import Recovery, RecoverySession, Surroundings
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel


@attrs.frozen(kw_only=True)
class Spin(Recovery):
    """Turns on the spot, as long as there is room ahead of the turn."""

    spin_dist: float = option(1.57, help="angle to turn counter-clockwise, radians", validator=gt(0))
    max_rotational_vel: float = option(1.0, help="highest turn rate", unit="rad/s", validator=gt(0))
    min_rotational_vel: float = option(0.4, help="lowest turn rate", unit="rad/s", validator=gt(0))
    rotational_acc_lim: float = option(3.2, help="deceleration, rad/s^2", validator=gt(0))
    simulate_ahead_time: float = option(2.0, help="time ahead for which poses must be free", unit="s", validator=ge(0))

    time_allowance: float = option(10.0, help="time after which an attempt has failed", unit="s", validator=gt(0))

    def start(self, robot: RobotModel, surroundings: Surroundings, period: float) -> RecoverySession:
        """Begin an attempt."""
        return _Session(self, robot, surroundings, period)


class _Session(RecoverySession):
    def __init__(self, options: Spin, robot: RobotModel, surroundings: Surroundings, period: float) -> None:
        self._options, self._surroundings, self._period = options, surroundings, period
        self._fastest = min(options.max_rotational_vel, robot.max_turn_rate)
        self._turned = 0.0
        self._yaw: float | None = None
        self._until = math.inf

    def step(self, now: float, pose: Float, twist: Float) -> tuple[float, float] | bool:  # noqa: ARG002
        x, y, yaw = pose.tolist()
        if self._yaw is None:
            self._until = now + self._options.time_allowance
        else:
            self._turned += math.remainder(yaw - self._yaw, math.tau)
        self._yaw = yaw
        left = self._options.spin_dist - self._turned
        if left <= 0:
            return True
        if now > self._until:  # something that no sensor shows blocks the robot
            return False
        braking = math.sqrt(2 * self._options.rotational_acc_lim * left)
        rate = min(max(braking, self._options.min_rotational_vel), self._fastest)
        ahead = min(rate * self._options.simulate_ahead_time, left)
        turns = np.arange(0.0, ahead, max(rate * self._period, 1e-3))
        poses = np.column_stack([np.full(len(turns), x), np.full(len(turns), y), yaw + turns])
        return (0.0, rate) if self._surroundings.is_free(poses).all() else False
