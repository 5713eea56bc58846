"""The smallest fleet of queues whose capacity is known."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_search.saturation.rates import growth
from mrpbench_search.sizing.fleets import FleetFigures, Verdict, limits, next_size, smallest


def searched(judge, first, most=10**6):
    verdicts = {}
    while (size := next_size(verdicts, first, most)) is not None:
        assert size not in verdicts
        verdicts[size] = judge(size)
    return verdicts


@given(st.integers(1, 300), st.integers(1, 300))
def test_the_smallest_fleet_that_serves_is_found_and_one_fewer_does_not(needed, first):
    verdicts = searched(lambda size: Verdict.SERVES if size >= needed else Verdict.DOES_NOT, first)
    if needed <= first * 64:
        assert smallest(verdicts) == (needed, needed)
        assert needed == 1 or verdicts[needed - 1] is Verdict.DOES_NOT
    assert len(verdicts) <= 2 + 2 * math.log2(300)


@given(st.integers(1, 40), st.integers(0, 8), st.integers(1, 40))
def test_fleets_of_which_nothing_is_shown_lie_in_the_interval(fails, gap, first):
    def judge(size):
        if size <= fails:
            return Verdict.DOES_NOT
        return Verdict.SERVES if size > fails + gap else Verdict.NOT_SHOWN

    low, high = smallest(searched(judge, first))
    assert (low, high) == (fails + 1, fails + gap + 1)


def test_no_larger_fleet_is_tried_than_fits():
    verdicts = searched(lambda size: Verdict.DOES_NOT, 4, most=10)
    assert sorted(verdicts) == [4, 8, 10]
    assert smallest(verdicts) == (11, None)


def figures(shares, p95, failed=0):
    return FleetFigures(
        growth=growth(shares), p95=p95 and limits(p95), per_hour=1.0, utilisation=0.5, blocked=0.0, failed=failed
    )


@pytest.mark.parametrize(
    ("found", "bound", "verdict"),
    [
        (figures([0.01, 0.02, 0.0], [100.0, 110.0, 105.0]), 240.0, Verdict.SERVES),
        (figures([0.01, 0.02, 0.0], [250.0, 260.0, 270.0]), 240.0, Verdict.DOES_NOT),
        (figures([0.01, 0.02, 0.0], [200.0, 260.0, 230.0]), 240.0, Verdict.NOT_SHOWN),
        (figures([0.01, 0.02, 0.0], [200.0, 260.0, 230.0]), math.inf, Verdict.SERVES),
        (figures([0.3, 0.32, 0.31], [100.0, 110.0, 105.0]), 240.0, Verdict.DOES_NOT),
        (figures([0.0, 0.2, 0.1], [100.0, 110.0, 105.0]), 240.0, Verdict.NOT_SHOWN),
        (figures([0.0, 0.0, 0.0], [1.0, 1.0, 1.0], failed=1), 240.0, Verdict.DOES_NOT),
        (figures([0.01, 0.02, 0.0], None), 240.0, Verdict.DOES_NOT),
    ],
)
def test_a_fleet_serves_if_queues_are_bounded_and_orders_are_in_time(found, bound, verdict):
    assert found.verdict(bound) is verdict
