"""The positions of leaves, computed by hand."""

import math

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.model.common.geometry import inside, point_segment_distance
from mrpbench_core.model.worlds.doors import leaf_segments, opening_time, swept_areas
from mrpbench_core.model.worlds.world import Door

DOOR = Door(name="d", start=(0.0, 0.0), end=(2.0, 0.0))
KINDS = ("hinged", "double_hinged", "sliding", "double_sliding", "telescope", "double_telescope")


def where(opening, **changes):
    return np.round(leaf_segments(attrs.evolve(DOOR, **changes), opening), 9).tolist()


@pytest.mark.parametrize("motion", KINDS)
def test_shut_leaves_fill_the_doorway(motion):
    lines = leaf_segments(attrs.evolve(DOOR, motion=motion, right_left_ratio=1.5), 0.0)
    gap = [point_segment_distance(np.array([x, 0.0]), lines[:, :2], lines[:, 2:]).min() for x in np.linspace(0, 2, 41)]
    assert max(gap) < 1e-9
    assert np.abs(lines[:, [1, 3]]).max() < 1e-9


SQRT2, SQRT3 = 2**0.5, 3**0.5
OPEN_LEAVES = [
    # kind, axis, direction, degrees -> open leaves x1, y1, x2, y2. In the image (y down) the leaf at `start` points to
    # angle 0 + direction * degrees and the one at `end` to 180 + direction * degrees, mirrored in double doors.
    ("hinged", "start", 1, 90, [[0, 0, 0, -2]]),
    ("hinged", "start", -1, 90, [[0, 0, 0, 2]]),
    ("hinged", "end", 1, 90, [[2, 0, 2, 2]]),
    ("hinged", "end", -1, 90, [[2, 0, 2, -2]]),
    ("hinged", "start", 1, 120, [[0, 0, -1, -SQRT3]]),
    ("hinged", "start", -1, 120, [[0, 0, -1, SQRT3]]),
    ("hinged", "start", 1, 45, [[0, 0, SQRT2, -SQRT2]]),
    ("hinged", "end", 1, 45, [[2, 0, 2 - SQRT2, SQRT2]]),
    ("hinged", "start", 1, -90, [[0, 0, 0, -2]]),
    ("hinged", "start", -1, -90, [[0, 0, 0, 2]]),
    ("double_hinged", "start", 1, 90, [[0, 0, 0, -0.5], [2, 0, 2, -1.5]]),
    ("double_hinged", "start", -1, 90, [[0, 0, 0, 0.5], [2, 0, 2, 1.5]]),
    ("double_hinged", "end", 1, 90, [[0, 0, 0, -0.5], [2, 0, 2, -1.5]]),
    ("double_hinged", "start", 1, 180, [[0, 0, -0.5, 0], [2, 0, 3.5, 0]]),
    ("sliding", "start", 1, 90, [[-2, 0, 0, 0]]),
    ("sliding", "start", -1, 90, [[-2, 0, 0, 0]]),
    ("sliding", "end", 1, 90, [[4, 0, 2, 0]]),
    ("double_sliding", "start", 1, 90, [[-0.5, 0, 0, 0], [3.5, 0, 2, 0]]),
    ("double_sliding", "start", -1, 90, [[-0.5, 0, 0, 0], [3.5, 0, 2, 0]]),
    ("telescope", "start", 1, 90, [[-1, 0, 0, 0], [-1, 0, 0, 0]]),
    ("telescope", "end", -1, 90, [[3, 0, 2, 0], [3, 0, 2, 0]]),
    ("double_telescope", "start", 1, 90, [[-0.25, 0, 0, 0], [-0.25, 0, 0, 0], [2.75, 0, 2, 0], [2.75, 0, 2, 0]]),
    ("double_telescope", "start", -1, 90, [[-0.25, 0, 0, 0], [-0.25, 0, 0, 0], [2.75, 0, 2, 0], [2.75, 0, 2, 0]]),
]


@pytest.mark.parametrize(("motion", "axis", "direction", "degrees", "leaves"), OPEN_LEAVES)
def test_leaves_open_as_the_traffic_editor_draws_them(motion, axis, direction, degrees, leaves):
    door = attrs.evolve(
        DOOR,
        motion=motion,
        motion_axis=axis,
        motion_direction=direction,
        motion_degrees=degrees,
        right_left_ratio=3.0,
    )
    np.testing.assert_allclose(leaf_segments(door, 1.0), leaves, atol=1e-9)


def test_half_open_leaves_are_halfway():
    assert where(0.5, motion="hinged") == [[0, 0, round(SQRT2, 9), -round(SQRT2, 9)]]
    assert where(0.5, motion="sliding", motion_axis="end") == [[3, 0, 1, 0]]


def test_it_takes_as_long_as_leaves_are_long():
    times = {motion: opening_time(attrs.evolve(DOOR, motion=motion)) for motion in KINDS}
    quarter = math.pi / 2 / 0.5
    assert times == {
        "hinged": quarter,
        "double_hinged": quarter,
        "sliding": 4.0,
        "double_sliding": 2.0,
        "telescope": 2.0,
        "double_telescope": 1.0,
    }


@given(
    st.sampled_from(KINDS),
    st.sampled_from(["start", "end"]),
    st.sampled_from([1, -1]),
    st.floats(-170, 170),
    st.floats(0.2, 5),
    st.floats(0, 1),
)
def test_the_swept_area_contains_the_leaves_at_every_opening(motion, axis, direction, degrees, ratio, opening):
    door = attrs.evolve(
        DOOR,
        motion=motion,
        motion_axis=axis,
        motion_direction=direction,
        motion_degrees=degrees,
        right_left_ratio=ratio,
    )
    polygons = swept_areas(door)
    for line in leaf_segments(door, opening):
        for share in (0.0, 0.5, 1.0):
            point = line[:2] + share * (line[2:] - line[:2])
            gap = [
                0.0
                if inside(polygon, point)
                else point_segment_distance(point, polygon, np.roll(polygon, -1, axis=0)).min()
                for polygon in polygons
            ]
            assert min(gap) < 1e-6
