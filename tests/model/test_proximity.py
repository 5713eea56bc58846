import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.model.proximity import close_pairs

number = st.integers(-8, 8).map(lambda value: value / 4) | st.just(np.inf)


@given(st.lists(st.tuples(number, number), max_size=25), st.floats(0, 3))
def test_pairs_are_those_of_brute_force_in_order(points, reach):
    points = np.array(points, float).reshape(-1, 2)
    expected = [
        (first, second)
        for first in range(len(points))
        for second in range(first + 1, len(points))
        if np.isfinite(points[[first, second]]).all() and ((points[second] - points[first]) ** 2).sum() < reach**2
    ]
    first, second = close_pairs(points, reach)
    assert list(zip(first.tolist(), second.tolist(), strict=True)) == expected
