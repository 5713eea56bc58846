"""The recovery `back_up`: drive away from what the robot is too close to."""

import math

import attrs
import numpy as np
from attrs.validators import ge, gt

from mrpbench_core.api import option
from mrpbench_core.api.recovery import Recovery, RecoverySession, Surroundings
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel


@attrs.frozen(kw_only=True)
class BackUp(Recovery):
    """Drives straight back, as long as there is room behind."""

    backup_dist: float = option(0.15, help="distance to drive back", unit="m", validator=gt(0))
    backup_speed: float = option(0.025, help="speed", unit="m/s", validator=gt(0))
    simulate_ahead_time: float = option(2.0, help="time ahead for which poses must be free", unit="s", validator=ge(0))

    time_allowance: float = option(10.0, help="time after which an attempt has failed", unit="s", validator=gt(0))

    def start(self, robot: RobotModel, surroundings: Surroundings, period: float) -> RecoverySession:
        """Begin an attempt."""
        return _Session(self, min(self.backup_speed, robot.max_speed), surroundings, period)


class _Session(RecoverySession):
    def __init__(self, options: BackUp, speed: float, surroundings: Surroundings, period: float) -> None:
        self._options, self._speed, self._surroundings, self._period = options, speed, surroundings, period
        self._from: tuple[float, float] | None = None
        self._until = math.inf

    def step(self, now: float, pose: Float, twist: Float) -> tuple[float, float] | bool:  # noqa: ARG002
        x, y, yaw = pose.tolist()
        if self._from is None:
            self._from = x, y
            self._until = now + self._options.time_allowance
        left = self._options.backup_dist - math.dist((x, y), self._from)
        if left <= 0:
            return True
        if now > self._until:  # something that no sensor shows blocks the robot
            return False
        ahead = min(self._speed * self._options.simulate_ahead_time, left)
        steps = np.arange(1, max(2, round(ahead / (self._speed * self._period)))) * self._speed * self._period
        poses = np.column_stack([x - steps * math.cos(yaw), y - steps * math.sin(yaw), np.full(len(steps), yaw)])
        return (-self._speed, 0.0) if self._surroundings.is_free(poses).all() else False
