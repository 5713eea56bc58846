"""Robots that freeze among people (P. Trautman and A. Krause, "Unfreezing the Robot", IROS 2010)."""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.common.intervals import runs

STILL_SPEED, STILL_TURN = 0.02, 0.05
"""m/s and rad/s below which a robot stands."""
LEAST = 3.0
"""Seconds for which a robot that freezes stands at least."""
NEAR = 2.0
"""Metres within which a person is the reason."""


def freezings(time: Float, twist: Float, may_drive: Bool, person: Float, robot: Float) -> tuple[int, float]:
    """Number of the periods in which robots freeze, and their seconds.

    Args:
        time: f8[T] seconds.
        twist: f8[T,n,2] m/s forward and rad/s.
        may_drive: bool[T,n], whether a part of the path is released that is not completed.
        person: f8[T,n] metres to the nearest person.
        robot: f8[T,n] metres to the nearest other robot, which is in the way if it is nearer than the person.
    """
    still = (np.abs(twist[..., 0]) < STILL_SPEED) & (np.abs(twist[..., 1]) < STILL_TURN)
    _, first, after = runs((still & may_drive & (person < NEAR) & (person <= robot)).T)
    lasted = time[np.minimum(after, len(time) - 1)] - time[first]
    long = lasted >= LEAST - 1e-9
    return int(long.sum()), float(lasted[long].sum())
