"""The battery of a robot, by the model of Open-RMF.

rmf_battery: `SimpleMotionPowerSink` (kinetic energy and friction), `SimpleDevicePowerSink` (devices), and a constant
charging current. The defaults are those of the robots in RMF's demonstrations.
"""

import attrs
from attrs.validators import ge, gt

from mrpbench_core.api import Float, between, option

GRAVITY = 9.81
"""m/s^2."""
SECONDS = 3600.0
"""Per hour."""


@attrs.frozen(kw_only=True)
class Battery:
    """Options of a battery and of the robot that it drives."""

    capacity: float = option(24.0, help="ampere hours", validator=gt(0))
    voltage: float = option(12.0, help="volts", validator=gt(0))
    charging_current: float = option(5.0, help="amperes while it charges", validator=gt(0))
    mass: float = option(20.0, help="kilograms of the robot", validator=gt(0))
    inertia: float = option(10.0, help="moment of inertia about the vertical axis, kg m^2", validator=ge(0))
    friction: float = option(0.22, help="coefficient of rolling friction", validator=ge(0))
    ambient: float = option(20.0, help="watts of computers, sensors and other devices, all the time", validator=ge(0))
    initial: float = option(1.0, help="state of charge of each robot at the start", validator=between(0, 1))

    @property
    def energy(self) -> float:
        """The joules of a full battery."""
        return SECONDS * self.capacity * self.voltage

    def motion(self, before: Float, after: Float, seconds: float) -> Float:
        """Return the joules f8[n] that robots use to drive, between two samples of their speeds.

        The power is m |a| v + I |α| |ω| + μ m g v, with the means of the speeds and accelerations: braking costs as
        much as accelerating does.

        Args:
            before: f8[n,2] m/s forward, rad/s, at the first sample.
            after: the same at the second.
            seconds: between the two.
        """
        speed, turn_rate = ((abs(before) + abs(after)) / 2).T
        change, turn_change = abs(after - before).T
        used: Float = self.mass * change * speed + self.inertia * turn_change * turn_rate
        used += self.friction * self.mass * GRAVITY * speed * seconds
        return used

    def charged(self, seconds: float) -> float:
        """Return by how much the state of charge grows while it charges for some seconds."""
        return self.charging_current * seconds / (SECONDS * self.capacity)
