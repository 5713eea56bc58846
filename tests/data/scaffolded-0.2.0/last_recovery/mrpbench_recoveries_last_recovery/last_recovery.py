"""LastRecovery: turn to where there is room."""

import math

import attrs
import numpy as np
from mrpbench_core.api import Recovery, RecoverySession, Surroundings, option
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel


@attrs.frozen(kw_only=True)
class LastRecovery(Recovery):
    """Turns on the spot to the nearest direction in which the robot could drive on; it fails where there is none."""

    ahead: float = option(0.3, help="distance that must be free", unit="m", validator=attrs.validators.gt(0))
    turn_rate: float = option(1.0, help="rate of the turn", unit="rad/s", validator=attrs.validators.gt(0))
    time_allowance: float = option(
        10.0, help="time after which the attempt has failed", unit="s", validator=attrs.validators.gt(0)
    )

    def start(self, robot: RobotModel, surroundings: Surroundings, period: float) -> RecoverySession:
        """Begin an attempt."""
        return LastRecoverySession(self, min(self.turn_rate, robot.max_turn_rate), surroundings, period)


class LastRecoverySession(RecoverySession):
    """One attempt."""

    def __init__(self, options: LastRecovery, turn_rate: float, surroundings: Surroundings, period: float) -> None:
        self.options, self.turn_rate, self.surroundings, self.period = options, turn_rate, surroundings, period
        self.wanted: float | None = None
        self.until = math.inf

    def step(self, now: float, pose: Float, twist: Float) -> tuple[float, float] | bool:  # noqa: ARG002
        """Return the command, or whether the robot faces a free direction."""
        if self.wanted is None:
            self.until = now + self.options.time_allowance
            self.wanted = self.free_direction(pose)
        left = math.nan if self.wanted is None else math.remainder(self.wanted - pose[2], math.tau)
        if math.isnan(left) or now > self.until:
            return False
        if abs(left) < self.turn_rate * self.period:
            return True
        rate = math.copysign(self.turn_rate, left)
        soon = pose + (0.0, 0.0, rate * self.period)
        return (0.0, rate) if self.surroundings.is_free(soon[None]).all() else False

    def free_direction(self, pose: Float) -> float | None:
        """Return the yaw with the smallest turn, other than the present one, in which the way ahead is free."""
        for turn in sorted(np.linspace(-math.pi, math.pi, 25).tolist(), key=abs)[1:]:
            yaw = pose[2] + turn
            step = np.linspace(0.0, self.options.ahead, 7)
            way = np.column_stack([pose[0] + step * np.cos(yaw), pose[1] + step * np.sin(yaw), np.full(7, yaw)])
            if self.surroundings.is_free(way).all():
                return float(yaw)
        return None
