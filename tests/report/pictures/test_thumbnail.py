"""Small pictures of runs."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mrpbench_core.report.pictures.thumbnail import CELLS, _bars, _merged


@given(arrays(bool, st.tuples(st.integers(1, 9), st.integers(1, 9))))
def test_bars_cover_exactly_the_blocked_cells(blocked):
    covered = np.zeros(blocked.shape, int)
    for corners in _bars(blocked):
        (left, bottom), (right, top) = corners.min(axis=0).astype(int), corners.max(axis=0).astype(int)
        covered[bottom:top, left:right] += 1
    assert (covered == blocked).all()


@given(st.integers(1, 450), st.integers(1, 450), st.integers(0, 10**6))
def test_merged_cells_are_few_and_keep_what_is_blocked(rows, columns, place):
    blocked = np.zeros((rows, columns), bool)
    row, column = place % rows, place // rows % columns
    blocked[row, column] = True
    merged, size = _merged(blocked, 0.5)
    assert max(merged.shape) <= CELLS
    assert merged.sum() == 1
    assert merged[int(row * 0.5 / size), int(column * 0.5 / size)]
