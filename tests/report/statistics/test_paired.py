"""Paired tests against published examples, exact enumeration and one another."""

from itertools import product
from math import comb

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import binom, norm

from mrpbench_core.report.statistics.means import MANY
from mrpbench_core.report.statistics.paired import adjust, compare_rates, compare_values

DARWIN = np.array([6, 8, 14, 16, 23, 24, 28, 29, 41, -48, 49, 56, 60, -67, 75], float)
"""Cross- less self-fertilised maize, eighths of an inch: R. A. Fisher, "The design of experiments", 1935."""


def four_fold(both, gained, lost, neither):
    """First and second success of as many units of each kind."""
    kinds = [(1, 1, both), (0, 1, gained), (1, 0, lost), (0, 0, neither)]
    return (np.repeat([float(kind[side]) for kind in kinds], [kind[2] for kind in kinds]) for side in (0, 1))


def test_the_signed_rank_test_of_darwins_maize():
    found = compare_values(np.zeros(15), DARWIN)
    assert found.p == pytest.approx(0.041259765625)  # exact: 2 · P(T <= 24)
    assert (found.above, found.ties, found.below) == (13, 0, 2)
    assert found.effect == pytest.approx((96 - 24) / 120)  # Kerby: favourable less unfavourable ranks
    assert found.difference.value == pytest.approx(20.9333, abs=1e-4)


@given(st.lists(st.integers(-5, 5).filter(bool), min_size=1, max_size=9, unique_by=abs))
def test_the_signed_rank_test_equals_the_count_over_all_sign_flips(steps):
    steps = np.array(steps, float)
    ranks = np.argsort(np.argsort(np.abs(steps))) + 1
    sums = np.array(
        [
            sum(rank * sign for rank, sign in zip(ranks, signs, strict=True))
            for signs in product((1, -1), repeat=len(steps))
        ]
    )
    exact = np.mean(np.abs(sums) >= abs((ranks * np.sign(steps)).sum()))
    assert compare_values(np.zeros(len(steps)), steps).p == pytest.approx(exact)


def test_mcnemars_exact_test_is_the_binomial_of_the_pairs_that_differ():
    first, second = four_fold(both=101, gained=12, lost=3, neither=33)
    found = compare_rates(first, second)
    assert found.p == pytest.approx(2 * binom.cdf(3, 15, 0.5))
    assert (found.above, found.ties, found.below) == (12, 134, 3)
    assert found.difference.value == pytest.approx(9 / 149)


def test_sign_flips_of_repeated_runs_are_mcnemars_test_where_repeats_agree():
    first, second = four_fold(both=3, gained=7, lost=1, neither=2)
    plain = compare_rates(first, second)
    halved = compare_rates(first / 2, second / 2)  # takes the other path: differences of a half
    assert halved.p == pytest.approx(plain.p)


def test_nothing_differs():
    values = np.array([0.1 + 0.2, 5.0])
    found = compare_values(values, np.array([0.3, 5.0]))
    assert (found.p, found.ties, found.effect) == (1.0, 2, 0.0)
    assert compare_rates(np.ones(4), np.ones(4)).p == 1.0


def test_groups_without_common_units_are_not_compared():
    assert compare_values(np.empty(0), np.empty(0)) is None
    assert compare_rates(np.empty(0), np.empty(0)) is None


@given(st.tuples(*[st.integers(0, 12)] * 4).filter(any))
def test_the_interval_of_two_rates_is_bonetts_and_prices(counts):
    both, gained, lost, neither = counts
    n = sum(counts)
    found = compare_rates(*four_fold(both, gained, lost, neither)).difference
    p12, p21 = (gained + 1) / (n + 2), (lost + 1) / (n + 2)
    reach = norm.ppf(0.975) * np.sqrt((p12 + p21 - (p12 - p21) ** 2) / (n + 2))
    assert found.low == pytest.approx(max(-1, p12 - p21 - reach))
    assert found.high == pytest.approx(min(1, p12 - p21 + reach))


@pytest.mark.parametrize(("gain", "loss"), [(0.1, 0.1), (0.3, 0.05), (0.05, 0.0)])
def test_the_interval_of_two_rates_covers(gain, loss):
    """Exact coverage over all outcomes of 25 pairs."""
    n, covered = 25, 0.0
    for gained in range(n + 1):
        for lost in range(n - gained + 1):
            rest = n - gained - lost
            chance = comb(n, gained) * comb(n - gained, lost) * gain**gained * loss**lost * (1 - gain - loss) ** rest
            if chance > 1e-9:
                found = compare_rates(*four_fold(rest, gained, lost, 0)).difference
                covered += chance * (found.low <= gain - loss <= found.high)
    assert covered >= 0.94


def test_holms_adjustment():
    """Only tests that could be significant count: with the first four, 0.01 · 4 = 0.04 and so on upward."""
    found = [_Found(p) for p in (0.01, 0.04, 0.03, 0.005)] + [_Found(0.25, able=False)]
    assert adjust(found) == pytest.approx([0.03, 0.06, 0.06, 0.02, 1.0])
    assert adjust([]) == []


def test_six_pairs_must_differ_to_be_significant():
    assert not compare_values(np.zeros(9), np.r_[np.ones(5), np.zeros(4)]).can_be_significant
    six = compare_values(np.zeros(9), np.r_[np.arange(1.0, 7), np.zeros(3)])
    assert six.can_be_significant
    assert six.p == pytest.approx(2 / 2**6)


class _Found:
    def __init__(self, p, able=True):
        self.p, self.can_be_significant = p, able


def test_many_fractions_are_compared_by_the_limit_of_sign_flips():
    rng = np.random.default_rng(3)
    first = rng.choice([0.0, 0.5, 1.0], MANY + 1)
    second = np.clip(first + rng.choice([-0.5, 0.5], MANY + 1, p=[0.47, 0.53]), -0.5, 1.5)
    steps = second - first
    flipped = np.abs((rng.choice([-1, 1], (20_000, len(steps))) * steps).sum(axis=1))
    assert compare_rates(first, second).p == pytest.approx((flipped >= abs(steps.sum())).mean(), abs=0.01)


def test_one_unit_that_differs_by_a_fraction_decides_nothing():
    found = compare_rates(np.array([0.5]), np.array([0.75]))
    assert (found.difference.value, found.p) == (0.25, 1.0)
