"""The battery of a vehicle, by the model of Open-RMF, with the options of the task source `charging`.

Open-RMF, rmf_battery, `SimpleMotionPowerSink` and `SimpleDevicePowerSink`: the power of a motion is
m |a| v + I |α| |ω| + μ m g v, and devices take a constant one. A vehicle that charges uses nothing.
"""

import attrs
from attrs.validators import ge, gt

from mrpbench_core.api import between, option

GRAVITY = 9.81
"""m/s^2."""
Twist = tuple[float, float]
"""m/s forward, rad/s."""


@attrs.frozen(kw_only=True)
class Battery:
    """Options of a battery and of the vehicle that it drives."""

    capacity: float = option(24.0, help="ampere hours", validator=gt(0))
    voltage: float = option(12.0, help="volts", validator=gt(0))
    charging_current: float = option(5.0, help="amperes while it charges", validator=gt(0))
    mass: float = option(20.0, help="kilograms of the vehicle", validator=gt(0))
    inertia: float = option(10.0, help="moment of inertia about the vertical axis, kg m^2", validator=ge(0))
    friction: float = option(0.22, help="coefficient of rolling friction", validator=ge(0))
    ambient: float = option(20.0, help="watts of computers, sensors and other devices, all the time", validator=ge(0))
    initial: float = option(1.0, help="state of charge at the start", validator=between(0, 1))

    def after(
        self, charge: float, seconds: float, metres: float, before: Twist, twist: Twist, charging: bool = False
    ) -> float:
        """Return the state of charge (0 to 1) after some simulated seconds.

        Args:
            charge: before.
            seconds: that have passed.
            metres: that the vehicle has driven in them.
            before: its speeds at first.
            twist: its speeds at last; in between they change evenly.
            charging: it has charged all the time.
        """
        if charging:
            return min(1.0, charge + self.charging_current * seconds / (3600.0 * self.capacity))
        speed, rate = ((abs(one) + abs(other)) / 2 for one, other in zip(before, twist, strict=True))
        change, turn_change = (abs(other - one) for one, other in zip(before, twist, strict=True))
        motion = self.mass * change * speed + self.inertia * turn_change * rate
        motion += self.friction * self.mass * GRAVITY * metres
        return max(0.0, charge - (self.ambient * seconds + motion) / (3600.0 * self.capacity * self.voltage))
