"""The legs of walking people, which a lidar near the floor sees instead of their bodies."""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.execution.movers import Mover, Movers

_STEP, _STEP_PER_SPEED = 0.36, 0.26
"""Metres, seconds: the length of a step is about 0.36 m + 0.26 s times the speed, 0.7 m at 1.3 m/s."""
_BESIDE = 0.07
"""Metres of each leg to the side of the middle."""


class Gait:
    """Two legs per person. A leg stands on the floor for one step, while the other one swings forward twice as far."""

    def __init__(self, members: Sequence[Mover]) -> None:
        self._walks = np.array([member.leg_radius > 0 for member in members], bool)
        self._radius = np.array([member.leg_radius or member.radius for member in members], float)
        self._phase = np.arange(len(members)) * (np.sqrt(5) - 1) / 2 % 1  # people do not walk in step

    def legs(self, movers: Movers, dt: float) -> Float:
        """Return the legs f8[m,5] as `Inputs.legs` holds them, `dt` seconds later; others are seen as their bodies."""
        yaw = movers.pose[:, 2]
        ahead = np.column_stack([np.cos(yaw), np.sin(yaw)])
        left = np.column_stack([-ahead[:, 1], ahead[:, 0]])
        speed = (movers.velocity * ahead).sum(axis=1)
        step = _STEP + _STEP_PER_SPEED * np.abs(speed)
        self._phase = (self._phase + speed * dt / (2 * step)) % 1
        reach = np.where(self._walks, step / 2, 0.0)[:, None]
        beside = np.where(self._walks, _BESIDE, 0.0)[:, None]
        place = movers.pose[:, :2]
        one = place + reach * _swing(self._phase) * ahead + beside * left
        two = place + reach * _swing((self._phase + 0.5) % 1) * ahead - beside * left
        return np.column_stack([one, two, self._radius])


def _swing(phase: Float) -> Float:
    """Where a leg is ahead of the body, f8[m,1] in halves of a step: from 1 to -1 on the floor, then back."""
    swing: Float = np.where(phase < 0.5, 1 - 4 * phase, 4 * phase - 3)[:, None]
    return swing
