"""The number of pairs that a signed-rank test needs: G. E. Noether, "Sample size determination for some common
nonparametric tests", Journal of the American Statistical Association 82, 1987.
"""

import math
from statistics import NormalDist

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.report.statistics.paired import LEAST_PAIRS

POWER = 0.9
"""Probability with which the test shows the difference."""


def pairs_needed(steps: Float, difference: float, level: float) -> int | None:
    """Return the number of pairs at which the two-sided test shows a difference; None with fewer than two pairs.

    The probability that the sum of two differences is above 0, on which the number depends, is estimated from pairs
    whose median was moved to `difference`.

    Args:
        steps: f8[n], the differences of the pairs.
        difference: to show, above 0.
        level: of the test.
    """
    if len(steps) < 2:
        return None
    moved = steps - np.median(steps) + difference
    sums = (moved[:, None] + moved)[np.triu_indices(len(moved), 1)]
    share = float((sums > 0).mean() + (sums == 0).mean() / 2)
    if share <= 0.5:
        return None
    normal = NormalDist()
    reach = normal.inv_cdf(1 - level / 2) + normal.inv_cdf(POWER)
    return max(LEAST_PAIRS, math.ceil(reach**2 / (3 * (share - 0.5) ** 2)))
