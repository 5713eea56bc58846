"""The state of charge of a fleet, computed from its true motion.

The execution decides by it, and the metric computes it again from the recording, in the same steps: half a second, as
rmf_battery does.
"""

import numpy as np

from mrpbench_core.api import Float, Int, Int16
from mrpbench_energy.site import Chargers, Energy

STEP = 0.5
"""Simulated seconds, at least."""
STANDS = np.array([0.01, 0.05])
"""m/s and rad/s below which a robot stands."""


class Ledger:
    """Keeps what robots use and charge.

    A robot charges while it stands within reach of a charger to which no other standing robot is nearer. Its devices
    are then supplied by the charger, as in Open-RMF.

    Args:
        energy: batteries and reach.
        chargers: their places.
        robots: their number.
    """

    def __init__(self, energy: Energy, chargers: Chargers, robots: int) -> None:
        self._energy, self._chargers = energy, chargers
        self.charge: Float = np.full(robots, energy.battery.initial)
        """f8[n] 0 to 1."""
        self.at: Int = np.full(robots, -1)
        """i8[n]: the charger at which each robot charged in the last step, -1 = none."""
        self.used: Float = np.zeros(robots)
        """f8[n] joules so far, of motion and devices."""
        self.gained: Float = np.zeros(robots)
        """f8[n] joules charged so far."""
        self._now, self._twist = -np.inf, np.zeros((robots, 2))

    def update(self, now: float, pose: Float, twist: Float, level: Int16) -> float:
        """Take in a sample; return the seconds since the one before that counts, 0 if this one does not count.

        Args:
            now: simulated seconds.
            pose: f8[n,3] true x, y, yaw.
            twist: f8[n,2] true m/s, rad/s.
            level: i2[n].
        """
        seconds = now - self._now
        if seconds < STEP - 1e-9:
            return 0.0
        before, self._now, self._twist = self._twist, now, twist
        if not np.isfinite(seconds):
            return 0.0
        battery = self._energy.battery
        robots = np.flatnonzero((np.maximum(abs(before), abs(twist)) < STANDS).all(axis=1))
        self.at = self._served(pose, level, robots)
        charging = self.at >= 0
        motion, devices = battery.motion(before, twist, seconds), battery.ambient * seconds
        self.used += motion + devices
        gained = np.where(charging, np.minimum(battery.charged(seconds), 1.0 - self.charge), 0.0)
        self.gained += gained * battery.energy
        spent = np.where(charging, 0.0, (motion + devices) / battery.energy)
        self.charge = np.clip(self.charge + gained - spent, 0.0, 1.0)
        return seconds

    def _served(self, pose: Float, level: Int16, robots: Int) -> Int:
        """The charger i8[n] that serves each of those that stand, -1 = none."""
        at = np.full(len(pose), -1)
        if not len(robots):
            return at
        chargers = self._chargers
        gap = np.hypot(*(pose[robots, None, :2] - chargers.position).transpose(2, 0, 1))
        gap[(level[robots, None] != chargers.level) | (gap > self._energy.reach)] = np.inf
        for _ in range(min(gap.shape)):
            row, charger = np.unravel_index(gap.argmin(), gap.shape)
            if not np.isfinite(gap[row, charger]):
                break
            at[robots[row]] = charger
            gap[row], gap[:, charger] = np.inf, np.inf
        return at
