"""Where a vehicle is, and how fast."""

import attrs


@attrs.frozen(kw_only=True)
class Here:
    """A vehicle at one time."""

    now: float
    """simulated seconds."""
    pose: tuple[float, float, float]
    """x, y (metres), yaw (radians)."""
    level: int
    driving: bool
    gave_up: bool
    """It cannot drive any more."""
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
