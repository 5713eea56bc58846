import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.checking.tiles import Tiles

corner = st.tuples(st.floats(-20, 20), st.floats(-20, 20))
box = st.tuples(corner, st.tuples(st.floats(0, 6), st.floats(0, 6)))


@settings(deadline=None, max_examples=200)
@given(st.lists(box, max_size=12), box)
def test_every_box_that_meets_another_is_found_once(boxes, other):
    low = np.array([corner for corner, _ in boxes]).reshape(-1, 2)
    high = low + np.array([size for _, size in boxes]).reshape(-1, 2)
    least, most = np.array(other[0]), np.array(other[0]) + other[1]
    found = Tiles(low, high)(least, most).tolist()
    meeting = ((low <= most) & (high >= least)).all(axis=1)
    assert set(np.flatnonzero(meeting).tolist()) <= set(found)
    assert len(set(found)) == len(found)


def test_boxes_far_away_are_not_looked_at():
    low = np.arange(1000.0)[:, None] * (1, 0)
    assert len(Tiles(low, low + 0.5)(np.array([500.0, 0.0]), np.array([501.0, 1.0]))) < 6
