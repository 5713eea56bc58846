"""Pairs of intervals that overlap, against the comparison of all pairs, and runs of True."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from mrpbench_core.model.common.intervals import overlapping, runs

ENDS = st.lists(st.tuples(st.integers(-5, 5), st.integers(0, 4)), max_size=12)


@given(ENDS)
def test_overlapping_intervals_are_found_once(drawn):
    low = np.array([low for low, _ in drawn], float)
    high = low + [length for _, length in drawn]
    first, second = overlapping(low, high)
    assert (low[first] <= low[second]).all()
    pairs = [tuple(sorted(pair)) for pair in zip(first.tolist(), second.tolist(), strict=True)]
    meet = (np.maximum.outer(low, low) <= np.minimum.outer(high, high)) & ~np.eye(len(low), dtype=bool)
    assert sorted(pairs) == [*map(tuple, np.argwhere(np.triu(meet)).tolist())]


def test_intervals_that_end_at_infinity_overlap():
    first, second = overlapping(np.array([np.inf, 0.0, np.inf]), np.array([np.inf, 1.0, np.inf]))
    assert (first.tolist(), second.tolist()) == ([0], [2])


@given(arrays(bool, array_shapes(min_dims=2, max_dims=2, min_side=0, max_side=8)))
def test_runs_are_maximal_and_hold_exactly_what_is_true(holds):
    again = np.zeros_like(holds)
    ends = {}
    for row, first, after in zip(*map(np.ndarray.tolist, runs(holds)), strict=True):
        assert first > ends.get(row, -1)
        again[row, first:after], ends[row] = True, after
    assert np.array_equal(again, holds)
