"""The saturation rate: the rate of arrivals at which a stated share of the tasks piles up, found by bisection.

A fleet that can do m tasks an hour and meets a > m leaves the share 1 - m / a of them open, however long the run is.
Each seed gives one value of this share. A rate is judged by the one-sided limits of their mean (Student's t).
"""

import math
from collections.abc import Mapping, Sequence
from enum import StrEnum
from itertools import pairwise

import attrs
import numpy as np
from scipy.stats import t as student

from mrpbench_core.report.statistics.estimate import LEVEL

TOLERANCE = 0.05
"""Share of the tasks that piles up at the saturation rate. Short runs show a little growth below it."""
FARTHEST = 2**6
"""Largest factor between the first rate and those that are tried."""


class Verdict(StrEnum):
    """What the seeds show about a rate."""

    BOUNDED = "bounded"
    GROWS = "grows"
    NOT_SHOWN = "not shown"


@attrs.frozen
class Growth:
    """The mean share of tasks that pile up, with its one-sided limits."""

    mean: float
    low: float
    high: float

    @property
    def verdict(self) -> Verdict:
        """Compare the limits with the tolerance."""
        if self.high < TOLERANCE:
            return Verdict.BOUNDED
        return Verdict.GROWS if self.low > TOLERANCE else Verdict.NOT_SHOWN


def growth(shares: Sequence[float], level: float = LEVEL) -> Growth:
    """Return the growth that the shares of at least two seeds show, with limits of this confidence each."""
    centre, count = float(np.mean(shares)), len(shares)
    reach = float(student.ppf(level, count - 1)) * float(np.std(shares, ddof=1)) / math.sqrt(count)
    return Growth(centre, centre - reach, centre + reach)


def saturation(verdicts: Mapping[float, Verdict]) -> tuple[float | None, float | None]:
    """Return the interval of the saturation rate, None where an end is missing.

    The upper end is the lowest rate at which queues are shown to grow. The lower end is the highest rate below it at
    which they are shown to be bounded.
    """
    high = min((rate for rate, verdict in verdicts.items() if verdict is Verdict.GROWS), default=None)
    below = (rate for rate, verdict in verdicts.items() if verdict is Verdict.BOUNDED and (high is None or rate < high))
    return max(below, default=None), high


def next_rate(verdicts: Mapping[float, Verdict], first: float, resolution: float) -> float | None:
    """Return the rate to try next, or None if the interval cannot be made shorter.

    Args:
        verdicts: of the rates tried.
        first: rate to begin with.
        resolution: least distance of neighbouring rates as a share, at least 0.01.
    """
    if not verdicts:
        return first
    low, high = saturation(verdicts)
    if low is None or high is None:
        rate = min(verdicts) / 2 if low is None else max(verdicts) * 2
        return rate if first / FARTHEST <= rate <= first * FARTHEST else None
    steps = list(pairwise(rate for rate in sorted(verdicts) if low <= rate <= high))
    ends = steps[0], steps[-1]  # rates between them were tried, and nothing was shown
    near, far = max(ends, key=lambda step: step[1] / step[0])  # what shortens the interval most
    return float(f"{math.sqrt(near * far):.4g}") if far > near * (1 + resolution) else None
