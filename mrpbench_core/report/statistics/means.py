"""Means with bootstrap intervals: bias-corrected and accelerated, units resampled. With many units, normal intervals.

B. Efron, "Better bootstrap confidence intervals", JASA 82, 1987. Both intervals agree up to terms of order 1/n:
P. Hall, "Theoretical comparison of bootstrap confidence intervals", Annals of Statistics 16, 1988.
"""

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.report.statistics.estimate import LEVEL, IntervalEstimate

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
    from scipy.stats import bootstrap, norm

    count = len(values)
    if not count:
        return None
    centre = float(values.mean())
    if count < LEAST:
        return IntervalEstimate(centre, np.nan, np.nan, count)
    if np.ptp(values) <= 1e-12 * max(1.0, abs(centre)):  # nothing to resample
        return IntervalEstimate(centre, centre, centre, count)
    if count > MANY:
        reach = float(norm.ppf((1 + LEVEL) / 2) * values.std(ddof=1) / np.sqrt(count))
        return IntervalEstimate(centre, centre - reach, centre + reach, count)
    found = bootstrap(
        (values,),
        np.mean,
        n_resamples=RESAMPLES,
        confidence_level=LEVEL,
        method="BCa",
        batch=max(1, AT_ONCE // count),
        rng=np.random.default_rng(SEED),
    ).confidence_interval
    return IntervalEstimate(centre, float(found.low), float(found.high), count)
