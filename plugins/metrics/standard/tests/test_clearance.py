"""The metric `clearance` on gaps measured by hand, and against brute force."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_metrics_standard import Clearance
from mrpbench_metrics_standard.surroundings import robot_gaps, solid_distances

from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.worlds.world import Level, World

WAY = [(0, 0), (9, 0)]
WALL = Level(name="L", walls=[[-20, 2, 20, 2]], wall_thickness=0.2)


def within(run, *levels):
    return attrs.evolve(run, context=attrs.evolve(run.context, world=World(name="w", levels=levels)))


def test_gaps_are_measured_between_surfaces(executed):
    """Radii 0.1 and 0.3 m, centres 1 to 3 m apart; the wall's side is at y = 1.9 m."""
    tracks = [[(0, 0), (0, 0), (0, 0)], [(1, 0), (2, 0), (3, 0)]]
    run = within(executed(range(3), tracks, [[0] * 3] * 2, [WAY] * 2, radii=[0.1, 0.3]), WALL)
    values = Clearance().measure(run)
    assert values["robots_min_m"] == pytest.approx(0.6)
    assert values["robots_p50_m"] == pytest.approx(1.6)
    assert values["robots_p5_m"] == pytest.approx(0.6)
    assert values["walls_min_m"] == pytest.approx(1.9 - 0.3)
    assert values["walls_p50_m"] == pytest.approx(1.7)  # of 1.6, 1.6, 1.6, 1.8, 1.8, 1.8


def test_only_robots_under_way_are_looked_at_but_all_are_in_their_way(executed):
    """Robot 0 has arrived, 0.5 m from the wall; robot 1 passes 1 m from it."""
    tracks = [[(0, 1.4)] * 2, [(0, 0.4)] * 2]
    values = Clearance().measure(within(executed([0, 1], tracks, [[1, 1], [0, 0]], [WAY] * 2), WALL))
    assert values["robots_min_m"] == pytest.approx(0.8)
    assert values["walls_min_m"] == pytest.approx(1.4)


def test_levels_do_not_see_one_another(executed):
    run = executed([0, 1], [[(0, 0)] * 2] * 2, [[0, 0]] * 2, [WAY] * 2, level=[[0, 0], [1, 1]])
    values = Clearance().measure(within(run, WALL, Level(name="open")))
    assert values["robots_min_m"] is None
    assert values["walls_p50_m"] == pytest.approx(1.8)


def test_without_a_robot_under_way_nothing_is_measured(executed):
    values = Clearance().measure(within(executed([0, 1], [[(0, 0)] * 2], [[1, 1]], [WAY]), WALL))
    assert set(values.values()) == {None}


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 2**32 - 1), st.integers(1, 9), st.integers(1, 3))
def test_gaps_are_those_of_all_pairs(seed, count, kinds):
    random = np.random.default_rng(seed)
    position, level = random.uniform(-3, 3, (4, count, 2)), random.integers(0, 2, (4, count)).astype("i2")
    position[0, : count // 2] = position[0, 0]
    radii, chosen = random.choice([0.1, 0.3, 0.5][:kinds], count), random.random((4, count)) < 0.7
    expected = []
    for t, i in zip(*np.nonzero(chosen), strict=True):
        gaps = [
            np.hypot(*(position[t, i] - position[t, j])) - radii[i] - radii[j]
            for j in range(count)
            if j != i and level[t, i] == level[t, j]
        ]
        expected += [min(gaps)] if gaps else []
    assert robot_gaps(position, level, radii, chosen) == pytest.approx(np.array(expected), abs=1e-9)


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 2**32 - 1), st.integers(0, 60), st.integers(1, 40))
def test_distances_are_those_from_all_segments(seed, count, solid):
    random = np.random.default_rng(seed)
    points, start = random.uniform(-30, 30, (count, 2)), random.uniform(-40, 40, (solid, 2))
    segments = np.concatenate([start, start + random.normal(0, 6, (solid, 2))], axis=1)
    expected = point_segment_distance(points[:, None], segments[:, :2], segments[:, 2:]).min(axis=1)
    assert np.array_equal(solid_distances(points, segments), expected)


def test_without_solids_distances_are_infinite():
    assert np.isinf(solid_distances(np.zeros((2, 2)), np.empty((0, 4)))).all()
