"""Pairs of things that are near one another, without looking at all pairs."""

import numpy as np

from mrpbench_core.model.arrays import Float, Int


def close_pairs(points: Float, reach: float) -> tuple[Int, Int]:
    """All pairs of `points` f8[n,2] less than `reach` metres apart: i8[k] and i8[k], the smaller index first, in order.

    Points that are not finite are near nothing. A sweep along x: the time grows with the pairs that are near in x.
    """
    finite = np.flatnonzero(np.isfinite(points).all(axis=1))
    order = finite[np.argsort(points[finite, 0], kind="stable")]
    x = points[order, 0]
    count = np.searchsorted(x, x + reach, side="right") - np.arange(len(x)) - 1
    one = np.repeat(np.arange(len(x)), count)
    other = one + 1 + np.arange(len(one)) - np.repeat(np.cumsum(count) - count, count)
    one, other = order[one], order[other]
    gap = points[other] - points[one]
    near = gap[:, 0] ** 2 + gap[:, 1] ** 2 < reach**2
    first, second = np.minimum(one[near], other[near]), np.maximum(one[near], other[near])
    ordered = np.lexsort((second, first))
    return first[ordered], second[ordered]
