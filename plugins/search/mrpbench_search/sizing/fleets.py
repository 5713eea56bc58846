"""Which fleets serve the orders, by one-sided limits over seeds, and which fleet to try or to repeat next.

A fleet serves them if fewer tasks than `TOLERANCE` pile up (see `mrpbench_search.saturation.rates`) and, where a bound
of the 95th percentile of service times is stated, 95 % of the orders are done within it. Sizes between one that does
not serve the orders and one that does are tried, others are not. Fleets of which nothing is shown are repeated with
twice as many seeds, at most `LOOKS` times in all; each look has an equal part of the error (Bonferroni's inequality).
"""

import math
from collections.abc import Mapping, Sequence
from enum import StrEnum

import attrs
import numpy as np
from scipy.stats import beta
from scipy.stats import t as student

from mrpbench_core.report.statistics.estimate import LEVEL
from mrpbench_search.saturation.rates import Growth
from mrpbench_search.saturation.rates import Verdict as Queues

FARTHEST = 64
"""Largest factor between the first fleet and those that are tried."""
LOOKS = 4
"""Number of times that the runs of a fleet are judged: with the seeds of the study, then twice as many each time."""
CONFIDENCE = 1 - (1 - LEVEL) / LOOKS
"""Of each one-sided limit of one look; that of all looks is `LEVEL`."""
SHARE = 0.95
"""Share of the orders that `--p95` bounds."""


class Verdict(StrEnum):
    """What the seeds show about a fleet."""

    SERVES = "serves"
    DOES_NOT = "does not"
    NOT_SHOWN = "not shown"


@attrs.frozen
class Limits:
    """An estimate with its one-sided limits."""

    mean: float
    low: float
    high: float


@attrs.frozen(kw_only=True)
class FleetFigures:
    """What the runs of one fleet show."""

    growth: Growth
    in_time: Limits | None
    """Share of the orders that are done within the bound; None: there is no bound."""
    p95: float | None
    """Mean of the 95th percentiles of service times, seconds; None: a run has none."""
    per_hour: float
    utilisation: float
    blocked: float
    """Share of the robots' time in which they do not get on."""
    failed: int
    """Runs that did not succeed."""
    runs: int
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

    @property
    def verdict(self) -> Verdict:
        """Compare the figures with the bounds."""
        late = self.in_time is not None and self.in_time.high < SHARE
        if self.failed or self.empty or self.growth.verdict is Queues.GROWS or late:
            return Verdict.DOES_NOT
        in_time = self.in_time is None or self.in_time.low > SHARE
        return Verdict.SERVES if self.growth.verdict is Queues.BOUNDED and in_time else Verdict.NOT_SHOWN


def share_in_time(levels: Sequence[float], orders: Sequence[float], confidence: float = CONFIDENCE) -> Limits:
    """Return the share of the orders that are done in time, with limits of this confidence each.

    It is the ratio of sums over seeds, with the error of a ratio estimator (W. G. Cochran, Sampling Techniques, 3rd
    ed. 1977, 6.3) and Student's t, because orders of one run depend on one another. The limits are at least as far as
    those of independent orders (C. J. Clopper, E. S. Pearson, Biometrika 26, 1934), so that few orders that are all in
    time do not show that all are.

    Args:
        levels: share of each seed, at least two.
        orders: number of orders of each seed.
        confidence: of each one-sided limit.
    """
    shares, weights = np.asarray(levels, float), np.asarray(orders, float)
    total, count = float(weights.sum()), len(shares)
    share = float(shares @ weights) / total
    reach = float(student.ppf(confidence, count - 1)) * float(np.std(weights * (shares - share), ddof=1))
    reach /= float(weights.mean()) * math.sqrt(count)
    done = share * total
    low = float(beta.ppf(1 - confidence, done, total - done + 1)) if done > 0 else 0.0
    high = float(beta.ppf(confidence, done + 1, total - done)) if done < total else 1.0
    return Limits(share, max(0.0, min(low, share - reach)), min(1.0, max(high, share + reach)))


def smallest(verdicts: Mapping[int, Verdict]) -> tuple[int, int | None]:
    """Return the interval of the smallest fleet that serves: at least the first, and at most the second if known."""
    high = min((size for size, found in verdicts.items() if found is Verdict.SERVES), default=None)
    fails = (size for size, found in verdicts.items() if found is Verdict.DOES_NOT and (high is None or size < high))
    return max(fails, default=0) + 1, high


def next_size(
    verdicts: Mapping[int, Verdict], looks: Mapping[int, int], first: int, most: int, busy: float = 0.0
) -> int | None:
    """Return the fleet to try or to repeat next, or None if the interval cannot be made shorter.

    Args:
        verdicts: of the fleets tried.
        looks: how often the runs of each were judged.
        first: to begin with.
        most: largest fleet that can be tried.
        busy: mean number of busy robots in the smallest fleet that serves, about as many as the orders need at least:
            a smaller fleet is not worth its runs unless all larger ones serve.
    """
    if not verdicts:
        return min(first, most)
    low, high = smallest(verdicts)
    largest = max(verdicts)
    if high is None and largest < (larger := min(2 * largest, most)) <= first * FARTHEST:
        return larger
    if high is not None and low == 1 and min(verdicts) > 1:
        least = min(verdicts)
        return max(1, least // 2, min(math.ceil(busy), 3 * least // 4))
    untried = [size for size in range(low, high or low) if size not in verdicts]
    if untried:
        return untried[len(untried) // 2]
    undecided = [size for size in sorted(verdicts) if low <= size < (high or math.inf) and looks[size] < LOOKS]
    fewest = [size for size in undecided if looks[size] == min(map(looks.__getitem__, undecided))]
    return fewest[len(fewest) // 2] if fewest else None
