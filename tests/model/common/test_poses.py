import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.model.common.poses import composed, relative, wrapped

number = st.floats(-50, 50)
pose = st.tuples(number, number, number).map(np.array)


def same(a, b):
    return np.allclose(a[:2], b[:2], atol=1e-9) and abs(wrapped(a[2] - b[2] + 1.0) - 1.0) < 1e-9


@given(st.floats(-1e3, 1e3))
def test_wrapped_angles_point_the_same_way(angle):
    assert -np.pi <= wrapped(angle) < np.pi
    assert np.allclose(np.exp(1j * wrapped(angle)), np.exp(1j * angle), atol=1e-9)


@given(pose, pose)
def test_relative_undoes_composed(frame, inner):
    assert same(relative(frame, composed(frame, inner)), inner)


@given(pose, pose, pose)
def test_frames_nest(a, b, c):
    assert same(composed(composed(a, b), c), composed(a, composed(b, c)))


def test_a_quarter_turn():
    assert np.allclose(composed(np.array([1.0, 2.0, np.pi / 2]), np.array([1.0, 0.0, 0.0])), [1, 3, np.pi / 2])
