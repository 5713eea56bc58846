"""A robot on two driven wheels in a Bullet world."""

import attrs

Place = tuple[tuple[float, float, float], tuple[float, float, float, float]]
"""A position, and an orientation as a quaternion x, y, z, w."""


@attrs.frozen(kw_only=True)
class Driven:
    """Which body it is, and what drives it."""

    body: int
    joints: tuple[int, int] = (0, 1)
    """Of the left and the right wheel."""
    signs: tuple[int, int] = (1, 1)
    """-1 where a positive speed of the joint drives back."""
    base: Place | None = None
    """The robot's base frame, seen from where Bullet says the body is; None: the two lie over one another."""
