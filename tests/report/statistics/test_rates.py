"""Wilson intervals against published ones, and under repeats."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import binomtest

from mrpbench_core.report.statistics.rates import effective_size, rate


def successes(count, size):
    return np.r_[np.ones(count), np.zeros(size - count)]


@pytest.mark.parametrize(
    ("count", "size", "low", "high"),
    [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)],
)
def test_intervals_are_the_published_ones(count, size, low, high):
    """R. G. Newcombe, "Two-sided confidence intervals for the single proportion", Statistics in Medicine 17, 1998."""
    found = rate(successes(count, size), size)
    assert (round(found.low, 4), round(found.high, 4)) == (low, high)


@given(st.integers(1, 200).flatmap(lambda size: st.tuples(st.integers(0, size), st.just(size))))
def test_intervals_are_those_of_scipy(case):
    count, size = case
    found = rate(successes(count, size), size)
    expected = binomtest(count, size).proportion_ci(method="wilson")
    assert (found.low, found.high) == pytest.approx((expected.low, expected.high), abs=1e-12)
    assert found.low <= found.value <= found.high


def test_nothing_has_no_rate():
    assert rate(np.empty(0), 0) is None


def test_repeats_that_agree_are_no_evidence():
    once = rate(successes(6, 10), 10)
    repeated = rate(successes(6, 10), 100)
    assert repeated == once


def test_repeats_that_differ_at_random_count_as_runs():
    assert effective_size(np.array([0.5, 0.4, 0.6, 0.5, 0.5, 0.5]), 60) == 60


@given(st.lists(st.integers(0, 5), min_size=2, max_size=30))
def test_the_effective_size_lies_between_units_and_runs(counts):
    assert len(counts) <= effective_size(np.array(counts) / 5, 5 * len(counts)) <= 5 * len(counts)


def test_the_effective_size_is_runs_over_the_design_effect():
    fractions = np.array([0.2, 0.8, 0.4, 0.6])  # mean 0.5, sample variance 1/15
    assert effective_size(fractions, 40) == pytest.approx(0.25 / (1 / 15 / 4))


def test_intervals_cover_where_scenarios_differ():
    """Success differs from scenario to scenario: taking the 200 runs as independent would cover far less."""
    rng = np.random.default_rng(7)
    covered = naive = 0
    for _ in range(300):
        chance = rng.beta(0.5, 0.5, size=20)  # mean 0.5
        fractions = rng.binomial(10, chance) / 10
        found = rate(fractions, 200)
        covered += found.low <= 0.5 <= found.high
        pooled = binomtest(round(fractions.mean() * 200), 200).proportion_ci(method="wilson")
        naive += pooled.low <= 0.5 <= pooled.high
    assert covered >= 0.90 * 300
    assert naive < 0.70 * 300
