"""Smallest distances between robots."""

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int16


def closest(position: Float, level: Int16, radii: Float) -> tuple[float | None, float | None]:
    """Smallest distance of centres and smallest gap of discs, metres, over all samples and pairs on the same level.

    Neighbours are compared in order of x, farther and farther apart in that order, until the x distance alone exceeds
    both minima. This is exact, and fast for robots that are spread out.

    Args:
        position: f8[T,n,2] metres.
        level: i2[T,n].
        radii: f8[n] metres.

    Returns:
        None for both if two robots were never on the same level.
    """
    order = np.argsort(position[..., 0], axis=1, kind="stable")
    x, y = (np.take_along_axis(position[..., axis], order, axis=1) for axis in (0, 1))
    level = np.take_along_axis(level, order, axis=1)
    radius = radii[order]
    nearest, tightest = np.inf, np.inf
    for apart in range(1, position.shape[1]):
        dx = x[:, apart:] - x[:, :-apart]
        least = dx.min(initial=np.inf)
        if least >= nearest and least - 2 * radii.max() >= tightest:
            break
        gap = np.hypot(dx, y[:, apart:] - y[:, :-apart])
        gap = np.where(level[:, apart:] == level[:, :-apart], gap, np.inf)
        nearest = min(nearest, float(gap.min(initial=np.inf)))
        tightest = min(tightest, float((gap - (radius[:, apart:] + radius[:, :-apart])).min(initial=np.inf)))
    return (nearest, tightest) if np.isfinite(nearest) else (None, None)
