"""Mean and percentiles of robots, samples or tasks.

Sums are exactly rounded (`math.fsum`), so that no result depends on the order of robots or the layout of arrays.
"""

import math

import numpy as np

from mrpbench_core.model.common.arrays import Float


def mean(values: Float) -> float | None:
    """Arithmetic mean; None without values."""
    return math.fsum(values) / len(values) if len(values) else None


def percentile(values: Float, share: float) -> float | None:
    """Percentile, linear between the two nearest values (type 7 of Hyndman and Fan, 1996); None without values."""
    return float(np.percentile(values, share)) if len(values) else None
