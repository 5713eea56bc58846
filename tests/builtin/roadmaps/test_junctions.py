import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from mrpbench_core.builtin.roadmaps.junctions import cut_at_junctions
from mrpbench_core.checking.components import components
from mrpbench_core.model.common.geometry import point_segment_distance, segment_distance

TOLERANCE = 0.001
lattice = st.tuples(st.integers(0, 12), st.integers(0, 12))
lanes = st.lists(st.tuples(lattice, lattice).filter(lambda ends: ends[0] != ends[1]), min_size=1, max_size=9)


def cut(drawn, tolerance=TOLERANCE):
    """Every lane with vertices of its own, so that all connections have to be found."""
    points = np.array([point for lane in drawn for point in lane], float)
    return points, cut_at_junctions(points, np.arange(len(points)).reshape(-1, 2), tolerance)


@settings(deadline=None, max_examples=150)
@given(lanes)
def test_lanes_that_meet_are_connected_and_others_are_not(drawn):
    points, pieces = cut(drawn)
    a, b = points[0::2], points[1::2]
    i, j = np.triu_indices(len(drawn), 1)
    meet = segment_distance(a[i], b[i], a[j], b[j]) < 1e-9
    expected = components(len(drawn), np.stack([i[meet], j[meet]], axis=1))
    label = components(len(pieces.position), pieces.ends)[pieces.vertex[0::2]]
    assert ((expected[:, None] == expected) == (label[:, None] == label)).all()


@settings(deadline=None, max_examples=150)
@given(lanes)
@example([((0, 2), (12, 1)), ((3, 8), (11, 7)), ((8, 3), (10, 6)), ((12, 0), (2, 11))])
def test_pieces_meet_at_their_ends_only(drawn):
    _, pieces = cut(drawn)
    position, ends = pieces.position, np.unique(np.sort(pieces.ends, axis=1), axis=0)
    for a, b in ends:
        others = np.setdiff1d(np.arange(len(position)), [a, b])
        assert (point_segment_distance(position[others], position[a], position[b]) >= TOLERANCE).all()
    i, j = np.triu_indices(len(ends), 1)
    strangers = np.array([not set(ends[x]) & set(ends[y]) for x, y in zip(i, j, strict=True)], bool)
    i, j = i[strangers], j[strangers]
    gap = segment_distance(position[ends[i, 0]], position[ends[i, 1]], position[ends[j, 0]], position[ends[j, 1]])
    assert (gap > 0).all()


@settings(deadline=None, max_examples=150)
@given(lanes)
def test_pieces_of_a_lane_lead_from_its_start_to_its_end(drawn):
    points, pieces = cut(drawn)
    for index in range(len(drawn)):
        own = pieces.ends[pieces.lane == index]
        assert own[0, 0] == pieces.vertex[2 * index]
        assert own[-1, 1] == pieces.vertex[2 * index + 1]
        assert (own[1:, 0] == own[:-1, 1]).all()
        length = np.hypot(*(pieces.position[own[:, 0]] - pieces.position[own[:, 1]]).T).sum()
        assert length == pytest.approx(np.hypot(*(points[2 * index] - points[2 * index + 1])), abs=0.05)


@settings(deadline=None, max_examples=200)
@given(st.lists(st.tuples(*[st.tuples(st.floats(0, 5), st.floats(0, 5))] * 2), min_size=1, max_size=8))
@example([((0, 0), (1.078125, 4.25)), ((1, 4.625), (0.25, 2.5)), ((2.375, 2.125), (0.375, 5))])  # three close vertices
def test_a_wide_tolerance_connects_lanes_that_meet_without_edges_to_and_fro(drawn):
    points, pieces = cut(drawn, 0.2)
    label = components(len(pieces.position), pieces.ends)[pieces.vertex[0::2]]
    a, b = points[0::2], points[1::2]
    for index in range(len(drawn)):
        meet = segment_distance(a[index], b[index], a, b) < 1e-9
        assert (label[meet] == label[index]).all()
        own = pieces.ends[pieces.lane == index]
        assert len(np.unique(own[:, 0])) == len(own), "no vertex is left twice"


def test_a_t_junction_and_a_crossing_are_found():
    points = np.array([[0, 0], [10, 0], [4, 0.1], [4, 5], [7, -3], [7, 3]], float)
    pieces = cut_at_junctions(points, np.array([[0, 1], [2, 3], [4, 5]]), 0.2)
    assert pieces.ends.tolist() == [[0, 2], [2, 6], [6, 1], [2, 3], [4, 6], [6, 5]]
    assert pieces.position[6].tolist() == pytest.approx([7, 0.05], abs=0.06)


def test_a_lane_that_ends_just_beyond_another_is_joined_at_its_end():
    points = np.array([[0, 0], [10, 0], [0, 1], [8, -0.1]])
    pieces = cut_at_junctions(points, np.array([[0, 1], [2, 3]]), 0.2)
    assert len(pieces.position) == 4
    assert pieces.ends.tolist() == [[0, 3], [3, 1], [2, 3]]


def test_points_nearer_than_the_tolerance_are_one():
    pieces = cut_at_junctions(np.array([[0, 0], [5, 0], [5, 0.1], [9, 0]]), np.array([[0, 1], [2, 3]]), 0.2)
    assert pieces.vertex.tolist() == [0, 1, 1, 2]
    assert pieces.ends.tolist() == [[0, 1], [1, 2]]
