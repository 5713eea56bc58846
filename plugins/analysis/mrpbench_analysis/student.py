"""Student's t distribution: M. Abramowitz, I. A. Stegun, *Handbook of Mathematical Functions*, 26.7.3 and 26.7.4."""

import math


def quantile(level: float, freedom: int) -> float:
    """Return t such that a variable with `freedom` >= 1 degrees of freedom is at most t with probability `level`.

    Args:
        level: from 0.5 to below 1.
        freedom: number of degrees of freedom.
    """
    low, high = 0.0, 1.0
    while within(high, freedom) < 2 * level - 1:
        high *= 2
    while high - low > 1e-12 * high:
        middle = (low + high) / 2
        low, high = (middle, high) if within(middle, freedom) < 2 * level - 1 else (low, middle)
    return high


def within(t: float, freedom: int) -> float:
    """Return the probability that the variable is between -t and t."""
    angle = math.atan(t / math.sqrt(freedom))
    odd = freedom % 2
    term, total = math.cos(angle) ** odd, 0.0
    for power in range(odd, freedom - 1, 2):
        total += term
        term *= (power + 1) / (power + 2) * math.cos(angle) ** 2
    total *= math.sin(angle)
    return 2 / math.pi * (angle + total) if odd else total
