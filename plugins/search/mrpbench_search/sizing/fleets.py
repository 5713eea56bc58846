"""Which fleets serve the orders, by one-sided limits of means over seeds, and which fleet to try next.

A fleet serves them if fewer tasks than `TOLERANCE` pile up (see `mrpbench_search.saturation.rates`) and, where a bound
is stated, the 95th percentile of the service times is below it. Sizes between one that does not serve the orders and
one that does are tried, others are not.
"""

import math
from collections.abc import Mapping, Sequence
from enum import StrEnum

import attrs
import numpy as np
from scipy.stats import t as student

from mrpbench_core.report.statistics.estimate import LEVEL
from mrpbench_search.saturation.rates import Growth
from mrpbench_search.saturation.rates import Verdict as Queues

FARTHEST = 64
"""Largest factor between the first fleet and those that are tried."""


class Verdict(StrEnum):
    """What the seeds show about a fleet."""

    SERVES = "serves"
    DOES_NOT = "does not"
    NOT_SHOWN = "not shown"


@attrs.frozen
class Limits:
    """A mean with its one-sided limits."""

    mean: float
    low: float
    high: float


@attrs.frozen(kw_only=True)
class FleetFigures:
    """What the runs of one fleet show."""

    growth: Growth
    p95: Limits | None
    """Of the means over seeds of the 95th percentile of service times, seconds; None: a run has none."""
    per_hour: float
    utilisation: float
    blocked: float
    """Share of the robots' time in which they do not get on."""
    failed: int
    """Runs that did not succeed."""
    lifts: float | None = None
    """Share of the robots' time in which they wait for lifts; None: not measured."""
    energy_wh: float | None = None
    """Used per hour; None: the study has no batteries, as in what follows."""
    charging: float | None = None
    """Share of the robots' time in which they charge."""
    chargers_busy: float | None = None
    """Share of the chargers' time in which a robot charges."""
    empty: float = 0.0
    """Robots that ran empty, in the mean of a run."""

    def verdict(self, bound_s: float) -> Verdict:
        """Compare the figures with the bounds."""
        late = self.p95 is None or self.p95.low > bound_s
        if self.failed or self.empty or self.growth.verdict is Queues.GROWS or (math.isfinite(bound_s) and late):
            return Verdict.DOES_NOT
        in_time = not math.isfinite(bound_s) or (self.p95 is not None and self.p95.high < bound_s)
        return Verdict.SERVES if self.growth.verdict is Queues.BOUNDED and in_time else Verdict.NOT_SHOWN


def limits(values: Sequence[float]) -> Limits:
    """Return the mean of at least two values with its one-sided limits (Student's t)."""
    centre, count = float(np.mean(values)), len(values)
    reach = float(student.ppf(LEVEL, count - 1)) * float(np.std(values, ddof=1)) / math.sqrt(count)
    return Limits(centre, centre - reach, centre + reach)


def smallest(verdicts: Mapping[int, Verdict]) -> tuple[int, int | None]:
    """Return the interval of the smallest fleet that serves: at least the first, and at most the second if known."""
    high = min((size for size, found in verdicts.items() if found is Verdict.SERVES), default=None)
    fails = (size for size, found in verdicts.items() if found is Verdict.DOES_NOT and (high is None or size < high))
    return max(fails, default=0) + 1, high


def next_size(verdicts: Mapping[int, Verdict], first: int, most: int) -> int | None:
    """Return the fleet to try next, or None if the interval cannot be made shorter.

    Args:
        verdicts: of the fleets tried.
        first: to begin with.
        most: largest fleet that can be tried.
    """
    if not verdicts:
        return min(first, most)
    low, high = smallest(verdicts)
    if high is None:
        largest = max(verdicts)
        size = min(2 * largest, most)
        return size if size > largest and size <= first * FARTHEST else None
    if low == 1 and min(verdicts) > 1:
        return max(1, min(verdicts) // 2)
    untried = [size for size in range(low, high) if size not in verdicts]
    return untried[len(untried) // 2] if untried else None
