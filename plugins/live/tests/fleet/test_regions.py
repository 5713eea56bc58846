"""Distances between ways, bodies and polygons, against ones that are found point by point."""

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st
from mrpbench_live.fleet.regions import clearance, offsets, placed, touches

from mrpbench_core.model.common.geometry import inside

ELL = np.array([(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 4.0), (0.0, 4.0)])
"""A polygon with a corner that goes inwards."""
places = st.tuples(st.floats(-2, 6), st.floats(-2, 6))


def in_ell(x, y):
    return (0 < x < 4 and 0 < y < 1) or (0 < x < 1 and 0 < y < 4)


def to_ell(x, y):
    """Metres from a place to the two rectangles of the polygon."""
    boxes = (((0, 4), (0, 1)), ((0, 1), (0, 4)))
    return min(np.hypot(x - np.clip(x, *across), y - np.clip(y, *along)) for across, along in boxes)


@given(places)
def test_places_are_inside_of_a_polygon_that_is_not_convex(place):
    if min(abs(value - side) for value in place for side in (0, 1, 4)) > 1e-9:
        assert inside(ELL, np.array(place)) == in_ell(*place)


@given(places, places)
@example((2.0, 2.0), (3.0, 3.0))
@example((0.5, 0.5), (0.6, 0.5))
@example((-1.0, 2.0), (2.0, 2.0))
def test_the_clearance_of_a_way_is_that_of_its_nearest_place(tail, head):
    tail, head = np.array(tail), np.array(head)
    along = [to_ell(*(tail + share * (head - tail))) for share in np.linspace(0, 1, 401)]
    found = clearance(tail[None], head[None], ELL)[0]
    step = np.hypot(*(head - tail)) / 400
    assert min(along) - step - 1e-9 <= found <= min(along) + 1e-9


@given(places, st.floats(-3, 3), st.floats(0.1, 3))
@example((0.5, 0.5), 0.0, 0.1)
@example((2.0, 2.0), 0.0, 3.0)
def test_bodies_touch_a_polygon_if_a_place_of_them_does(place, yaw, half):
    square = np.array([(half, half), (-half, half), (-half, -half), (half, -half)])
    grid = np.linspace(-half, half, 41)
    inner = np.array([(x, y) for x in grid for y in grid])
    nearest = min(to_ell(x, y) for x, y in placed(inner, (*place, yaw)))
    found = touches(placed(square, (*place, yaw)), ELL)
    if nearest == 0.0:
        assert found
    elif nearest > half / 20:
        assert not found


def test_offsets_are_to_the_left_of_the_nearest_leg():
    line = np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0)])
    place = np.array([(1.0, 0.5), (1.0, -0.5), (1.5, 1.5), (2.25, 1.0), (-1.0, 0.25), (2.5, 3.0)])
    assert offsets(place, line).tolist() == [0.5, -0.5, 0.5, -0.25, 0.25, -0.5]
