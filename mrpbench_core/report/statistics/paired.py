"""Differences between two treatments of the same units.

- Rates: McNemar's exact test (Q. McNemar, Psychometrika 12, 1947). Where units were run several times their success is
  a fraction, and the test flips the signs of the units' differences, of which McNemar's exact test is the special case;
  with many units by the normal distribution, which the sum of flipped differences then has.
  Interval: D. G. Bonett, R. M. Price, "Adjusted Wald confidence interval for a difference of binomial proportions based
  on paired data", Journal of Educational and Behavioral Statistics 37, 2012.
- Values: F. Wilcoxon's signed-rank test (Biometrics Bulletin 1, 1945); units without a difference leave it. Interval of
  the mean difference: bootstrap, as for means. Effect size: matched-pairs rank-biserial correlation (D. S. Kerby, "The
  simple difference formula", Comprehensive Psychology 3, 2014).
- Many tests: S. Holm, "A simple sequentially rejective multiple test procedure", Scandinavian Journal of Statistics 6,
  1979; tests that cannot be significant leave the family: R. E. Tarone, "A modified Bonferroni method for discrete
  data", Biometrics 46, 1990.
"""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.report.statistics.estimate import LEVEL, IntervalEstimate, Z
from mrpbench_core.report.statistics.means import AT_ONCE, MANY, SEED, mean

FLIPS = 9999
"""Number of random sign flips if there are too many to try all."""
LEAST_PAIRS = next(count for count in range(1, 99) if 2.0 ** (1 - count) <= 1 - LEVEL)
"""Number of pairs that differ below which no test is significant."""
TIE = 1e-9
"""Relative difference up to which two values count as equal, because sums are rounded."""


@attrs.frozen(kw_only=True)
class Difference:
    """Second treatment minus first, over the units that both have."""

    difference: IntervalEstimate
    first: float
    second: float
    """Means of both over these units."""
    above: int
    """Number of units in which the second is larger."""
    below: int
    effect: float
    """Rank-biserial correlation from -1 (second smaller in every unit) to 1; 0 if differences of both signs balance."""
    p: float
    """Two-sided; 1 where no unit differs."""

    @property
    def ties(self) -> int:
        """Number of units without a difference."""
        return self.difference.n - self.above - self.below

    @property
    def can_be_significant(self) -> bool:
        """True if the test would be significant if all units that differ did so in the same direction."""
        return self.above + self.below >= LEAST_PAIRS


def compare_rates(first: Float, second: Float) -> Difference | None:
    """Compare the units' success fractions; None without units."""
    steps = _steps(first, second)
    if not len(steps):
        return None
    # Bonett and Price add two units, one won by each.
    padded = np.append(steps, (1.0, -1.0))
    reach = float(Z * np.sqrt(padded.var() / len(padded)))
    centre = float(padded.mean())
    estimate = IntervalEstimate(float(steps.mean()), max(-1.0, centre - reach), min(1.0, centre + reach), len(steps))
    return _difference(estimate, first, second, steps, _flip_test(steps))


def compare_values(first: Float, second: Float) -> Difference | None:
    """Compare the units' values; None without units."""
    steps = _steps(first, second)
    estimate = mean(steps)
    if estimate is None:
        return None
    return _difference(estimate, first, second, steps, _signed_rank_test(steps))


def adjust(differences: Sequence[Difference]) -> list[float]:
    """Return p-values adjusted for the number of tests.

    Tests that cannot be significant, because too few units differ, do not count and get 1.
    """
    adjusted = np.ones(len(differences))
    able = sorted((entry.p, index) for index, entry in enumerate(differences) if entry.can_be_significant)
    least = 0.0
    for rank, (p, index) in enumerate(able):
        least = max(least, min(1.0, p * (len(able) - rank)))
        adjusted[index] = least
    return adjusted.tolist()


def _steps(first: Float, second: Float) -> Float:
    """Differences; those within rounding errors are exactly 0."""
    steps = second - first
    steps[np.abs(steps) <= TIE * np.maximum(np.abs(first), np.abs(second))] = 0.0
    return steps


def _difference(estimate: IntervalEstimate, first: Float, second: Float, steps: Float, p: float) -> Difference:
    return Difference(
        difference=estimate,
        first=float(first.mean()),
        second=float(second.mean()),
        above=int((steps > 0).sum()),
        below=int((steps < 0).sum()),
        effect=_rank_biserial(steps),
        p=p,
    )


def _flip_test(steps: Float) -> float:
    moved = steps[steps != 0]
    if len(moved) < 2:
        return 1.0
    from scipy.stats import binomtest, norm, permutation_test

    if (np.abs(moved) == 1).all():
        return float(binomtest(int((moved > 0).sum()), len(moved)).pvalue)
    if len(moved) > MANY:
        return float(2 * norm.sf(abs(moved.sum()) / np.sqrt((moved**2).sum())))
    rng = np.random.default_rng(SEED)
    batch = max(1, AT_ONCE // len(moved))
    test = permutation_test((moved,), np.mean, permutation_type="samples", n_resamples=FLIPS, batch=batch, rng=rng)
    return float(test.pvalue)


def _signed_rank_test(steps: Float) -> float:
    from scipy.stats import wilcoxon

    moved = steps[steps != 0]
    return float(wilcoxon(moved).pvalue) if len(moved) else 1.0


def _rank_biserial(steps: Float) -> float:
    """Share of the ranks of differences above 0, minus the share of those below 0."""
    from scipy.stats import rankdata

    moved = steps[steps != 0]
    if not len(moved):
        return 0.0
    ranks = rankdata(np.abs(moved))
    return float((ranks * np.sign(moved)).sum() / ranks.sum())
