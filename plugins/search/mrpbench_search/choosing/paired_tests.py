"""One-sided tests of two candidates on the seeds that both have.

Success: sign test over the seeds whose success differs, which is McNemar's exact test where each seed is run once
(Q. McNemar, Psychometrika 12, 1947). Values: F. Wilcoxon's signed-rank test (Biometrics Bulletin 1, 1945). As good
within a margin: two one-sided signed-rank tests of the differences, moved by the margin of each seed (D. J. Schuirmann,
Journal of Pharmacokinetics and Biopharmaceutics 15, 1987).
"""

import attrs
import numpy as np
from scipy.stats import binomtest, rankdata, wilcoxon

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.report.statistics.paired import TIE

EXACT = 200
"""Number of seeds that differ up to which the signed-rank test is exact, with ties; above, its normal approximation."""


@attrs.frozen
class OneSided:
    """A one-sided test."""

    p: float
    least: float
    """The least p that it can have, given how many seeds differ: that all of them do so in one direction."""


def fails_more(success: Float, other: Float) -> OneSided:
    """Test whether the first candidate fails more often than the other one.

    Args:
        success: f8[n], share of the runs of each seed that succeeded.
        other: f8[n], of the other candidate.
    """
    more, differ = int((success < other).sum()), int((success != other).sum())
    return OneSided(float(binomtest(more, differ, alternative="greater").pvalue) if more else 1.0, 0.5**differ)


def is_larger(values: Float, other: Float) -> OneSided:
    """Test whether the first candidate's values are larger than the other's.

    Args:
        values: f8[n], one for each seed.
        other: f8[n], of the other candidate.
    """
    steps = values - other
    moved = steps[np.abs(steps) > TIE * np.maximum(np.abs(values), np.abs(other))]
    p = _signed_rank_p(moved) if (moved > 0).any() else 1.0
    return OneSided(p, 0.5 ** len(moved))


def p_beyond_margin(values: Float, other: Float, margin: float) -> float:
    """Return p of the hypothesis that the values differ by the margin or more.

    Args:
        values: f8[n], one for each seed.
        other: f8[n], of the other candidate.
        margin: share of the other's value, above 0.
    """
    reach = margin * np.abs(other)
    return max(is_larger(other + reach, values).p, is_larger(values, other - reach).p)


def _signed_rank_p(steps: Float) -> float:
    """Return the probability that random signs give a sum of positive ranks at least as large as these steps do.

    SciPy has this distribution without ties only, and tries all signs otherwise; durations and costs of plans are
    multiples of a tick and have many.
    """
    if len(steps) > EXACT:
        return float(wilcoxon(steps, alternative="greater", method="asymptotic").pvalue)
    ranks = np.rint(2 * rankdata(np.abs(steps))).astype(int)  # whole numbers, with ties too
    chances = np.zeros(ranks.sum() + 1)
    chances[0] = 1.0
    for rank in ranks:
        chances[rank:] = (chances[rank:] + chances[:-rank]) / 2
        chances[:rank] /= 2
    return float(chances[ranks[steps > 0].sum() :].sum())
