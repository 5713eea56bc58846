"""Says what a difference of two groups means: shown or not, and large enough to matter or not.

Significance alone does not make a difference large, and a missing proof does not make two groups equal. The threshold
of the column decides both (smallest effect size of interest): D. Lakens, "Equivalence Tests", Social Psychological and
Personality Science 8, 2017.
"""

from enum import StrEnum

import attrs

from mrpbench_core.report.estimation.comparison import SIGNIFICANT, Comparison
from mrpbench_core.report.reading.columns import direction
from mrpbench_core.report.statistics.estimate import IntervalEstimate


class Relation(StrEnum):
    """What is known of one group, compared with another one."""

    BETTER = "noticeably better"
    WORSE = "noticeably worse"
    IDENTICAL = "identical"
    """The same value in every scenario that both have."""
    SLIGHT = "a difference too small to matter"
    """Significant, but below the threshold."""
    UNRATED = "a significant difference"
    """The column declares no threshold, so nothing says whether it matters."""
    SAME = "practically the same"
    """Not significant, and the interval excludes every difference that matters."""
    OPEN = "no clear difference"
    """Not significant, and the interval allows differences that matter, or there is none."""
    NOT_COMPARED = "not compared"
    """They differ in several choices, or share no unit."""


def relation(comparison: Comparison) -> Relation:
    """Return what is known of the second group, compared with the first."""
    paired, column = comparison.paired, comparison.column
    difference, threshold = paired.difference, least_noticeable(comparison)
    if paired.ties == difference.n:
        return Relation.IDENTICAL
    if not is_shown(comparison):
        alike = threshold is not None and difference.has_interval
        alike = alike and max(abs(difference.low), abs(difference.high)) < threshold  # type: ignore[operator]
        return Relation.SAME if alike else Relation.OPEN
    if threshold is None or not direction(column):
        return Relation.UNRATED
    if abs(difference.value) < threshold:
        return Relation.SLIGHT
    return Relation.BETTER if difference.value * direction(column) > 0 else Relation.WORSE


def is_shown(comparison: Comparison) -> bool:
    """True if the data show that the means differ: the test is significant, and the interval excludes 0 on its side."""
    paired = comparison.paired
    one_side = paired.difference.low > 0 or paired.difference.high < 0
    return comparison.p_adjusted < SIGNIFICANT and one_side and not comparison.is_mixed


def least_noticeable(comparison: Comparison) -> float | None:
    """Return the smallest difference of these means that matters; None if the column declares no threshold."""
    column, paired = comparison.column, comparison.paired
    if column.threshold is None:
        return None
    return max(column.threshold, column.threshold_share * max(abs(paired.first), abs(paired.second)))


def turned(comparison: Comparison) -> Comparison:
    """Return the comparison of the first group with the second."""
    paired = comparison.paired
    step = paired.difference
    return attrs.evolve(
        comparison,
        first=comparison.second,
        second=comparison.first,
        unpaired=comparison.unpaired[::-1],
        paired=attrs.evolve(
            paired,
            difference=IntervalEstimate(-step.value, -step.high, -step.low, step.n),
            first=paired.second,
            second=paired.first,
            above=paired.below,
            below=paired.above,
            effect=-paired.effect,
        ),
    )
