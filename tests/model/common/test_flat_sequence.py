"""Sequences in flat arrays behave as tuples of their items."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.model.planning.plan import Paths, RobotPath

BOUND = st.none() | st.integers(-5, 5)


@given(st.lists(st.integers(0, 3), max_size=4), st.builds(slice, BOUND, BOUND, st.sampled_from([None, 1, 2, -1])))
def test_items_and_slices_are_those_of_a_tuple(sizes, some):
    items = tuple(RobotPath(edge=np.arange(size), enter=np.arange(size), leave=np.arange(size) + 1) for size in sizes)
    flat = Paths.of(items)
    assert (tuple(flat), len(flat), flat[some]) == (items, len(items), items[some])
    assert [flat[-1 - index] for index in range(len(items))] == [*reversed(items)]
    for outside in (len(items), -len(items) - 1):
        with pytest.raises(IndexError):
            flat[outside]
