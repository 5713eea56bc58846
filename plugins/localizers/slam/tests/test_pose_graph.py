"""The pose graph against SciPy's least squares."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_native.slam import optimised

from mrpbench_core.model.common.poses import composed, relative, wrapped

scipy = pytest.importorskip("scipy.optimize")
least_squares, minimize = scipy.least_squares, scipy.minimize


def graph(seed, nodes, loops):
    """True poses f8[n,3], a start, pairs, measured relative poses and information matrices, with noise."""
    random = np.random.default_rng(seed)
    truth = [np.array([[1.0, 2.0, 0.5]])]
    for _ in range(nodes - 1):
        truth.append(composed(truth[-1], np.array([[0.5, 0.0, random.normal(0, 0.3)]])))
    truth = np.concatenate(truth)
    pairs = [(i, i + 1) for i in range(nodes - 1)]
    pairs += [tuple(random.choice(nodes, 2, replace=False).tolist()) for _ in range(loops)]
    pairs = np.array(pairs, np.int32)
    measured = relative(truth[pairs[:, 0]], truth[pairs[:, 1]]) + random.normal(0, (0.05, 0.05, 0.03), (len(pairs), 3))
    halves = random.normal(0, 3, (len(pairs), 3, 3)) + 10 * np.eye(3)
    start = [truth[:1]]
    for step in measured[: nodes - 1]:
        start.append(composed(start[-1], step[None]))
    return np.concatenate(start), pairs, measured, halves @ halves.transpose(0, 2, 1)


def errors(poses, pairs, measured):
    """Errors f8[c,3] in the frames that the constraints measure."""
    found = relative(poses[pairs[:, 0]], poses[pairs[:, 1]])
    off = relative(measured, found)
    return np.column_stack([off[:, :2], wrapped(found[:, 2] - measured[:, 2])])


def cost(poses, pairs, measured, information):
    e = errors(poses, pairs, measured)
    return 0.5 * np.einsum("ci,cij,cj->", e, information, e)


@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 10**6), nodes=st.integers(2, 15), loops=st.integers(0, 4), fixed=st.integers(1, 4))
def test_the_cost_is_the_least_that_scipy_finds(seed, nodes, loops, fixed):
    start, pairs, measured, information = graph(seed, nodes, loops)
    fixed = min(fixed, nodes - 1)
    poses, found = optimised(start, pairs, measured, information.reshape(-1, 9), fixed=fixed)
    roots = np.linalg.cholesky(information).transpose(0, 2, 1)

    def residuals(free):
        moved = np.concatenate([start[:fixed], free.reshape(-1, 3)])
        return np.einsum("cij,cj->ci", roots, errors(moved, pairs, measured)).ravel()

    best = least_squares(residuals, start[fixed:].ravel(), xtol=1e-12, ftol=1e-12, gtol=1e-12)
    assert found == pytest.approx(cost(poses, pairs, measured, information), rel=1e-9, abs=1e-12)
    assert found <= best.cost * (1 + 1e-6) + 1e-9
    assert np.array_equal(poses[:fixed], start[:fixed])


@pytest.mark.parametrize("seed", range(5))
def test_hubers_loss_is_the_least_that_scipy_finds(seed):
    start, pairs, measured, information = graph(seed, 6, 3)
    measured[-1, :2] += 5
    poses, found = optimised(start, pairs, measured, information.reshape(-1, 9), huber=2.0)

    def loss(free):
        e = errors(np.concatenate([start[:1], free.reshape(-1, 3)]), pairs, measured)
        size = np.sqrt(np.einsum("ci,cij,cj->c", e, information, e))
        return np.where(size <= 2, size**2 / 2, 2 * (size - 1)).sum()

    assert found == pytest.approx(loss(poses[1:].ravel()), rel=1e-9)
    for begin in (start, poses):
        assert found <= minimize(loss, begin[1:].ravel(), method="BFGS").fun * (1 + 1e-5)


@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 10**6), x=st.floats(-5, 5), y=st.floats(-5, 5), yaw=st.floats(-3, 3))
def test_a_graph_that_is_moved_as_a_whole_gives_moved_poses(seed, x, y, yaw):
    start, pairs, measured, information = graph(seed, 8, 2)
    flat = information.reshape(-1, 9)
    frame = np.array([[x, y, yaw]])
    here, least = optimised(start, pairs, measured, flat)
    there, moved = optimised(composed(np.repeat(frame, 8, axis=0), start), pairs, measured, flat)
    assert moved == pytest.approx(least, rel=1e-6, abs=1e-9)
    off = there - composed(np.repeat(frame, 8, axis=0), here)
    assert np.abs(off[:, :2]).max() < 1e-3
