"""What a difference means: shown or not, large enough to matter or not."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.api.metric import Column
from mrpbench_core.report.estimation.comparison import Comparison
from mrpbench_core.report.estimation.relation import Relation, is_shown, relation, turned
from mrpbench_core.report.statistics.estimate import IntervalEstimate
from mrpbench_core.report.statistics.paired import Difference

TIME = Column("x.time", "s", "lower", "how long", threshold=1.0, threshold_share=0.1)


def comparison(value, low, high, p=0.001, column=TIME, effect=None, first=5.0):
    effect = np.sign(value) if effect is None else effect
    difference = IntervalEstimate(value, low, high, 10)
    found = Difference(difference=difference, first=first, second=first + value, above=5, below=5, effect=effect, p=p)
    return Comparison(
        setting="",
        first="a",
        second="b",
        unit="runs",
        column=column,
        is_rate=False,
        paired=found,
        unpaired=(0, 0),
        p_adjusted=p,
    )


@pytest.mark.parametrize(
    ("value", "low", "high", "p", "expected"),
    [
        (3.0, 2.0, 4.0, 0.001, Relation.WORSE),
        (-3.0, -4.0, -2.0, 0.001, Relation.BETTER),
        (0.0004, 0.0003, 0.0005, 0.001, Relation.SLIGHT),
        (0.1, -0.3, 0.5, 0.6, Relation.SAME),
        (0.1, -3.0, 3.0, 0.6, Relation.OPEN),
        (3.0, 2.0, 4.0, 0.06, Relation.OPEN),
        (3.0, np.nan, np.nan, 0.001, Relation.OPEN),
    ],
)
def test_a_difference_is_shown_and_large_enough_or_not(value, low, high, p, expected):
    assert relation(comparison(value, low, high, p)) is expected


def test_a_share_of_the_larger_mean_is_a_threshold_too():
    assert relation(comparison(3.0, 2.0, 4.0, first=5.0)) is Relation.WORSE
    assert relation(comparison(3.0, 2.0, 4.0, first=50.0)) is Relation.SLIGHT


def test_without_a_threshold_nothing_is_noticeable():
    column = Column("x.time", "s", "lower", "how long")
    assert relation(comparison(3.0, 2.0, 4.0, column=column)) is Relation.UNRATED
    assert relation(comparison(0.1, -0.2, 0.3, 0.5, column=column)) is Relation.OPEN


def test_ranks_that_oppose_the_mean_show_nothing():
    assert relation(comparison(3.0, 2.0, 4.0, effect=-0.2)) is Relation.OPEN


numbers = st.floats(-100, 100)


@given(numbers, numbers, numbers, st.floats(0, 1), numbers, st.sampled_from([-1.0, 1.0]), st.floats(0, 5) | st.none())
def test_no_difference_is_claimed_whose_interval_contains_zero_or_that_is_below_the_threshold(
    a, b, c, p, first, effect, threshold
):
    low, value, high = sorted((a, b, c))
    column = Column("x.time", "s", "lower", "how long", threshold=threshold)
    entry = comparison(value, low, high, p, column, effect, first)
    found = relation(entry)
    if low <= 0 <= high or p >= 0.05:
        assert not is_shown(entry)
        assert found in (Relation.OPEN, Relation.SAME)
    if found in (Relation.BETTER, Relation.WORSE):
        assert threshold is not None
        assert abs(value) >= threshold
    if found is Relation.SAME:
        assert max(abs(low), abs(high)) < threshold
    other = {Relation.BETTER: Relation.WORSE, Relation.WORSE: Relation.BETTER}
    assert relation(turned(entry)) is other.get(found, found)
    assert turned(turned(entry)) == entry
