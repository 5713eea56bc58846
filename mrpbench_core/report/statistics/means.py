"""Means with bootstrap intervals: bias-corrected and accelerated, units resampled. With many units, normal intervals.

B. Efron, "Better bootstrap confidence intervals", JASA 82, 1987. Both intervals agree up to terms of order 1/n:
P. Hall, "Theoretical comparison of bootstrap confidence intervals", Annals of Statistics 16, 1988.
"""

from statistics import NormalDist

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.report.statistics.estimate import IntervalEstimate, Z

RESAMPLES = 1999
SEED = 0
"""Seed of the resampling, the same for every interval."""
LEAST = 5
"""Number of units below which there is no interval, since a bootstrap interval would be too narrow."""
MANY = 1000
"""Number of units above which the interval is normal: the difference vanishes, and the jackknife is quadratic."""
AT_ONCE = 4_000_000
"""Number of values drawn at once, which limits memory."""


def mean(values: Float) -> IntervalEstimate | None:
    """Return the mean over units; None without units."""
    count = len(values)
    if not count:
        return None
    values = np.sort(values)  # so that no result depends on the order of records
    centre = float(values.mean())
    if count < LEAST:
        return IntervalEstimate(centre, np.nan, np.nan, count)
    if np.ptp(values) <= 1e-12 * max(1.0, abs(centre)):  # nothing to resample
        return IntervalEstimate(centre, centre, centre, count)
    if count > MANY:
        reach = float(Z * values.std(ddof=1) / np.sqrt(count))
        return IntervalEstimate(centre, centre - reach, centre + reach, count)
    return IntervalEstimate(centre, *_bootstrap(values), count)


def _bootstrap(values: Float) -> tuple[float, float]:
    """Return the ends of the BCa interval of the mean (Efron 1987, sections 3 and 6)."""
    rng, count = np.random.default_rng(SEED), len(values)
    sizes = np.diff([*range(0, RESAMPLES, max(1, AT_ONCE // count)), RESAMPLES])
    means = np.concatenate([values[rng.integers(0, count, (size, count))].mean(axis=1) for size in sizes])
    below, equal = (means < values.mean()).mean(), (means == values.mean()).mean()
    normal = NormalDist()
    bias = normal.inv_cdf(float(np.clip(below + equal / 2, 1 / RESAMPLES, 1 - 1 / RESAMPLES)))
    influence = values - values.mean()
    acceleration = float((influence**3).sum() / (6 * (influence**2).sum() ** 1.5))
    ends = [normal.cdf(bias + (bias + z) / (1 - acceleration * (bias + z))) for z in (-Z, Z)]
    low, high = np.percentile(means, [100 * end for end in ends])
    return float(low), float(high)
