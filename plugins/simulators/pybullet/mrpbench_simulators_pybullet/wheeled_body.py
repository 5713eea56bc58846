"""A body on two driven wheels in a Bullet world."""

import attrs

Transform = tuple[tuple[float, float, float], tuple[float, float, float, float]]
"""A position, and an orientation as a quaternion x, y, z, w."""


@attrs.frozen(kw_only=True)
class WheeledBody:
    """The identifiers of a robot's body and of the joints that drive it."""

    body: int
    joints: tuple[int, int] = (0, 1)
    """The joints of the left and the right wheel."""
    signs: tuple[int, int] = (1, 1)
    """For each joint, -1 if a positive speed drives the robot back."""
    base: Transform | None = None
    """The robot's base frame in the frame that Bullet reports for the body; None: the two are the same."""
