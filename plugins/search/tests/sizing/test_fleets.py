"""The smallest fleet of queues whose capacity is known."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_search.saturation.rates import growth
from mrpbench_search.sizing.fleets import (
    CONFIDENCE,
    LOOKS,
    FleetFigures,
    Verdict,
    next_size,
    share_in_time,
    smallest,
)


def searched(judge, first, most=10**6, busy=0.0):
    """The verdicts at the end, and the looks; `judge` has the size and the look, from 1."""
    verdicts, looks = {}, {}
    while (size := next_size(verdicts, looks, first, most, busy)) is not None:
        assert verdicts.get(size, Verdict.NOT_SHOWN) is Verdict.NOT_SHOWN
        looks[size] = looks.get(size, 0) + 1
        verdicts[size] = judge(size, looks[size])
    return verdicts, looks


@given(st.integers(1, 300), st.integers(1, 300))
def test_the_smallest_fleet_that_serves_is_found_and_one_fewer_does_not(needed, first):
    verdicts, looks = searched(lambda size, _: Verdict.SERVES if size >= needed else Verdict.DOES_NOT, first)
    if needed <= first * 64:
        assert smallest(verdicts) == (needed, needed)
        assert needed == 1 or verdicts[needed - 1] is Verdict.DOES_NOT
    assert sum(looks.values()) <= 2 + 2 * math.log2(300)


@given(st.integers(1, 300), st.integers(1, 300), st.floats(0, 400))
def test_the_smallest_fleet_is_found_however_many_robots_are_busy(needed, first, busy):
    verdicts, looks = searched(lambda size, _: Verdict.SERVES if size >= needed else Verdict.DOES_NOT, first, busy=busy)
    if needed <= first * 64:
        assert smallest(verdicts) == (needed, needed)
    assert sum(looks.values()) <= 2 + math.log(300, 4 / 3) + math.log2(300)


def test_fleets_smaller_than_the_number_of_busy_robots_are_not_tried():
    verdicts, _ = searched(lambda size, _: Verdict.SERVES if size >= 3 else Verdict.DOES_NOT, 3, busy=1.9)
    assert sorted(verdicts) == [2, 3]


@given(st.integers(1, 40), st.integers(0, 8), st.integers(1, 40))
def test_fleets_of_which_nothing_is_shown_lie_in_the_interval(fails, gap, first):
    def judge(size, _):
        if size <= fails:
            return Verdict.DOES_NOT
        return Verdict.SERVES if size > fails + gap else Verdict.NOT_SHOWN

    verdicts, looks = searched(judge, first)
    assert smallest(verdicts) == (fails + 1, fails + gap + 1)
    assert all(looks[size] == LOOKS for size in range(fails + 1, fails + gap + 1))


@given(st.integers(2, 40), st.integers(1, 40), st.integers(2, LOOKS))
def test_fleets_of_which_more_seeds_show_something_are_decided(needed, first, look):
    """The two fleets at the edge need several looks, the others one."""

    def judge(size, looks):
        if size in (needed - 1, needed) and looks < look:
            return Verdict.NOT_SHOWN
        return Verdict.SERVES if size >= needed else Verdict.DOES_NOT

    verdicts, looks = searched(judge, first)
    assert smallest(verdicts) == (needed, needed)
    assert all(count == 1 for size, count in looks.items() if size not in (needed - 1, needed))


def test_no_larger_fleet_is_tried_than_fits():
    verdicts, _ = searched(lambda *_: Verdict.DOES_NOT, 4, most=10)
    assert sorted(verdicts) == [4, 8, 10]
    assert smallest(verdicts) == (11, None)


@given(st.lists(st.tuples(st.integers(0, 500), st.integers(1, 500)), min_size=2, max_size=20))
def test_the_share_in_time_is_that_of_all_orders_and_lies_between_its_limits(seeds):
    done, orders = [min(seed) for seed in seeds], [count for _, count in seeds]
    found = share_in_time([some / count for some, count in zip(done, orders, strict=True)], orders)
    assert found.mean == pytest.approx(sum(done) / sum(orders))
    assert 0 <= found.low <= found.mean + 1e-12
    assert found.mean - 1e-12 <= found.high <= 1


def test_orders_that_are_all_in_time_show_as_much_as_as_many_independent_orders():
    found = share_in_time([1.0, 1.0], [20, 20])
    assert found.high == 1.0
    assert found.low == pytest.approx((1 - CONFIDENCE) ** (1 / 40))  # Clopper and Pearson 1934


def figures(shares, levels, failed=0):
    in_time = levels and share_in_time(levels, [500] * len(levels))
    return FleetFigures(
        growth=growth(shares),
        in_time=in_time,
        p95=1.0,
        per_hour=1.0,
        utilisation=0.5,
        blocked=0.0,
        failed=failed,
        runs=3,
    )


@pytest.mark.parametrize(
    ("found", "verdict"),
    [
        (figures([0.01, 0.02, 0.0], [0.99, 0.99, 0.98]), Verdict.SERVES),
        (figures([0.01, 0.02, 0.0], [0.7, 0.71, 0.72]), Verdict.DOES_NOT),
        (figures([0.01, 0.02, 0.0], [1.0, 0.9, 0.95]), Verdict.NOT_SHOWN),
        (figures([0.01, 0.02, 0.0], None), Verdict.SERVES),
        (figures([0.3, 0.32, 0.31], [0.99, 0.99, 0.98]), Verdict.DOES_NOT),
        (figures([0.0, 0.2, 0.1], [0.99, 0.99, 0.98]), Verdict.NOT_SHOWN),
        (figures([0.0, 0.0, 0.0], [1.0, 1.0, 1.0], failed=1), Verdict.DOES_NOT),
    ],
)
def test_a_fleet_serves_if_queues_are_bounded_and_orders_are_in_time(found, verdict):
    assert found.verdict is verdict
