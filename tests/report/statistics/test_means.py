"""Bootstrap intervals against closed forms, published ones, and by coverage."""

import numpy as np
import pytest
from scipy import stats

from mrpbench_core.report.statistics.means import LEAST, MANY, RESAMPLES, SEED, mean


def test_many_normal_values_have_the_interval_of_student():
    values = np.random.default_rng(3).normal(10, 2, size=400)
    found = mean(values)
    low, high = stats.t.interval(0.95, 399, loc=values.mean(), scale=stats.sem(values))
    assert (found.low, found.high) == pytest.approx((low, high), abs=0.03)
    assert (found.value, found.n) == (values.mean(), 400)


def test_skewed_values_have_a_skewed_interval():
    """Times between failures of an aircraft's air conditioning: A. C. Davison, D. V. Hinkley, "Bootstrap methods and
    their application", 1997, example 1.1."""
    hours = np.array([3, 5, 7, 18, 43, 85, 91, 98, 100, 130, 230, 487], float)
    found = mean(hours)
    assert found.value == pytest.approx(108.083, abs=0.001)
    assert found.high - found.value > 1.5 * (found.value - found.low)


@pytest.mark.parametrize("count", [5, 12, 80, 1000])
def test_intervals_are_those_of_scipy(count):
    values = np.random.default_rng(count).exponential(size=count)
    found = mean(values)
    expected = stats.bootstrap(
        (np.sort(values),), np.mean, n_resamples=RESAMPLES, rng=np.random.default_rng(SEED), method="BCa"
    )
    assert (found.low, found.high) == pytest.approx(tuple(expected.confidence_interval), rel=1e-9)


def test_intervals_cover_skewed_means():
    rng = np.random.default_rng(11)
    trials = 300
    inside = 0
    for _ in range(trials):
        found = mean(rng.exponential(size=40))
        inside += found.low <= 1.0 <= found.high
    assert inside >= 0.89 * trials


def test_the_same_values_give_the_same_interval():
    values = np.random.default_rng(5).exponential(size=30)
    assert mean(values) == mean(values.copy())


def test_few_values_have_no_interval():
    assert not mean(np.arange(LEAST - 1.0)).has_interval
    assert mean(np.arange(float(LEAST))).has_interval


def test_equal_values_have_an_interval_of_one_point():
    found = mean(np.full(8, 3.5))
    assert (found.low, found.high) == (3.5, 3.5)


def test_nothing_has_no_mean():
    assert mean(np.empty(0)) is None


def test_very_many_values_are_done_with_in_little_memory():
    values = np.random.default_rng(1).normal(size=MANY + 1)
    found = mean(values)
    assert (found.low, found.high) == pytest.approx(
        stats.t.interval(0.95, MANY, loc=values.mean(), scale=stats.sem(values)), abs=0.003
    )


def test_the_interval_hardly_changes_where_it_becomes_normal():
    values = np.random.default_rng(2).exponential(size=MANY + 1)
    fewer, more = mean(values[:-1]), mean(values)
    assert (fewer.low, fewer.high) == pytest.approx((more.low, more.high), abs=0.1 * (more.high - more.low))
