"""The recoveries `spin` and `rotate_to_path`: turn on the spot."""

import math

import attrs
import numpy as np
from attrs.validators import ge, gt

from mrpbench_core.api import option
from mrpbench_core.api.recovery import Recovery, RecoverySession, Surroundings
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel

_ALONG = 0.1
"""radians off its path at which a robot heads along it."""


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


@attrs.frozen(kw_only=True)
class RotateToPath(Recovery):
    """Turns on the spot along the path, at the rates of `spin`.

    A controller that begins to drive before it heads along its path, as Nav2's regulated pure pursuit does, finds a
    collision ahead where a shelf is near. Fails at once where the robot heads along its path already.
    """

    def start(self, robot: RobotModel, surroundings: Surroundings, period: float) -> RecoverySession:
        """Begin an attempt."""
        return _Session(Spin(), robot, surroundings, period, surroundings.heading())


class _Session(RecoverySession):
    """Turns by `spin_dist`, or the shorter way to a heading.

    Args:
        options: how fast to turn, and by how much.
        robot: which turns.
        surroundings: where it has room.
        period: control period, simulated seconds.
        heading: radians, NaN = there is none to turn to; None = turn by `spin_dist`.
    """

    def __init__(
        self,
        options: Spin,
        robot: RobotModel,
        surroundings: Surroundings,
        period: float,
        heading: float | None = None,
    ) -> None:
        self._options, self._surroundings, self._period, self._heading = options, surroundings, period, heading
        self._fastest = min(options.max_rotational_vel, robot.max_turn_rate)
        self._turn, self._turned = options.spin_dist, 0.0
        self._yaw: float | None = None
        self._until = math.inf

    def step(self, now: float, pose: Float, twist: Float) -> tuple[float, float] | bool:  # noqa: ARG002
        x, y, yaw = pose.tolist()
        if self._yaw is None:
            self._until = now + self._options.time_allowance
            if self._heading is not None:
                self._turn = math.remainder(self._heading - yaw, math.tau)
                if not abs(self._turn) > _ALONG:
                    return False
        else:
            self._turned += math.remainder(yaw - self._yaw, math.tau)
        self._yaw = yaw
        side = math.copysign(1.0, self._turn)
        left = side * (self._turn - self._turned)
        if left <= 0:
            return True
        if now > self._until:  # something that no sensor shows blocks the robot
            return False
        braking = math.sqrt(2 * self._options.rotational_acc_lim * left)
        rate = min(max(braking, self._options.min_rotational_vel), self._fastest)
        ahead = min(rate * self._options.simulate_ahead_time, left)
        turns = side * np.arange(0.0, ahead, max(rate * self._period, 1e-3))
        poses = np.column_stack([np.full(len(turns), x), np.full(len(turns), y), yaw + turns])
        return (0.0, side * rate) if self._surroundings.is_free(poses).all() else False
