"""The battery of a vehicle, as Open-RMF models it: what it spends for motion and for being switched on.

Open-RMF, rmf_battery, `SimpleMotionPowerSink` and `SimpleDevicePowerSink`: the power of a motion is m a v + mu m g v,
and devices take a constant one. Accelerations are left out here: over a run they cancel but for what braking wastes.
"""

import attrs
from attrs.validators import gt

from mrpbench_core.api import between, option

GRAVITY = 9.81
"""m/s^2."""


@attrs.frozen(kw_only=True)
class Battery:
    """Options of a battery."""

    capacity: float = option(24.0, help="ampere hours", validator=gt(0))
    voltage: float = option(12.0, help="volts", validator=gt(0))
    charging_current: float = option(5.0, help="amperes while it charges", validator=gt(0))
    mass: float = option(20.0, help="kilograms of the vehicle", validator=gt(0))
    friction: float = option(0.22, help="coefficient of rolling friction", validator=between(0, 1))
    standby: float = option(20.0, help="watts of sensors and computers", validator=between(0, 1e4))
    initial: float = option(1.0, help="charge at the start, 0 to 1", validator=between(0, 1))

    def after(self, charge: float, seconds: float, metres: float, charging: bool) -> float:
        """Return the charge (0 to 1) after some simulated seconds in which the vehicle drove so many metres."""
        joules = 3600.0 * self.capacity * self.voltage
        spent = (self.standby * seconds + self.friction * self.mass * GRAVITY * metres) / joules
        gained = self.charging_current * seconds / (3600.0 * self.capacity) if charging else 0.0
        return min(1.0, max(0.0, charge - spent + gained))
