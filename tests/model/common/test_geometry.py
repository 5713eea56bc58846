"""Pairs of intervals that overlap, against the comparison of all pairs."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.model.common.geometry import overlapping

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
