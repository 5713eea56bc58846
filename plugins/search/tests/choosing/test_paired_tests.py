"""One-sided tests, against the enumeration of all signs."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_search.choosing.paired_tests import fails_more, is_larger, p_beyond_margin
from scipy.stats import rankdata, wilcoxon


@given(st.lists(st.integers(1, 8), min_size=1, max_size=9), st.data())
def test_the_signed_rank_test_is_that_of_all_signs(sizes, data):
    signs = np.array(data.draw(st.lists(st.sampled_from([-1, 1]), min_size=len(sizes), max_size=len(sizes))))
    steps = signs * np.array(sizes, float)
    ranks = rankdata(np.abs(steps))
    statistic = ranks[steps > 0].sum()
    sums = [ranks[np.array(chosen) > 0].sum() for chosen in product((-1, 1), repeat=len(steps))]
    expected = np.mean(np.array(sums) >= statistic) if statistic else 1.0
    found = is_larger(10.0 + steps, np.full(len(steps), 10.0))
    assert found.p == pytest.approx(expected)
    assert found.least == 0.5 ** len(steps)


def test_success_is_compared_on_the_seeds_that_differ():
    first, other = np.array([0.0, 0, 0, 1, 1]), np.array([1.0, 1, 1, 1, 1])
    assert fails_more(first, other).p == 0.5**3
    assert fails_more(other, first).p == 1
    assert fails_more(first, first).least == 1


def test_values_are_within_a_margin_only_if_both_sides_are_shown():
    values = np.linspace(10, 20, 12)
    assert p_beyond_margin(values * 1.01, values, 0.02) == pytest.approx(0.5**12)
    assert p_beyond_margin(values * 1.03, values, 0.02) == 1
    assert p_beyond_margin(values * 0.97, values, 0.02) == 1


def test_without_ties_the_test_is_that_of_scipy():
    steps = np.random.default_rng(0).normal(0.4, 1, 40)
    assert is_larger(10 + steps, np.full(40, 10.0)).p == pytest.approx(wilcoxon(steps, alternative="greater").pvalue)
