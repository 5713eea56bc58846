"""Rates with Wilson intervals.

E. B. Wilson, "Probable inference, the law of succession, and statistical inference", JASA 22, 1927. Where a scenario
was run several times, its runs are not independent samples; the interval is then that of the effective sample size,
runs divided by the design effect: C. Franco, R. Little, T. Louis, E. Slud, "Comparative study of confidence intervals
for proportions in complex sample surveys", Journal of Survey Statistics and Methodology 7, 2019.
"""

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.report.statistics.estimate import IntervalEstimate, Z


def rate(fractions: Float, runs: int) -> IntervalEstimate | None:
    """Return the mean of the units' success fractions; None without units.

    Args:
        fractions: of each unit, the share of its runs that succeeded.
        runs: how many runs all units have together.
    """
    if not len(fractions):
        return None
    mean = float(fractions.mean())
    size = effective_size(fractions, runs)
    centre = (mean + Z**2 / (2 * size)) / (1 + Z**2 / size)
    reach = Z / (1 + Z**2 / size) * np.sqrt(mean * (1 - mean) / size + Z**2 / (4 * size**2))
    # Rounding errors may leave the mean outside of the interval, at 0 and 1.
    return IntervalEstimate(mean, min(mean, float(centre - reach)), max(mean, float(centre + reach)), len(fractions))


def effective_size(fractions: Float, runs: int) -> float:
    """Number of independent runs with the same information: at least one, at most all runs of each unit."""
    units, mean = len(fractions), float(fractions.mean())
    variance = float(fractions.var(ddof=1)) / units if units > 1 else 0.0
    if mean in (0.0, 1.0) or variance == 0.0:  # nothing shows how alike the runs of one unit are
        return float(units)
    return float(np.clip(mean * (1 - mean) / variance, units, runs))
