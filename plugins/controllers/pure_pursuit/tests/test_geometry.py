import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mrpbench_controllers_pure_pursuit.geometry import carrots, path_lengths, stopping_speed


def carrot(path, x, y, distance):
    points, one = np.array(path, float), np.ones(1, int)
    place = np.array([[x, y]], float)
    return tuple(carrots(points[:1], points, one, one * len(path), place, distance)[0].tolist())


def path_length(path, enough):
    points, one = np.array(path, float), np.ones(1, int)
    return path_lengths(points[:1], points, one, one * len(path), np.array([enough]))[0]


def test_the_carrot_lies_on_the_path_at_the_distance_asked_for():
    path = [(0, 0), (1, 0), (1, 1)]
    assert carrot(path, 0, 0, 0.5) == (0.5, 0)
    assert carrot([(0.2, 0), *path[1:]], 0.2, 0.3, 0.5) == pytest.approx((0.6, 0))
    assert carrot([(0.9, 0), (1, 0), (1, 1)], 0.9, 0, 0.5) == pytest.approx((1, math.sqrt(0.24)))


def test_beyond_the_end_the_path_goes_on_straight():
    assert carrot([(0.8, 0), (1, 0)], 0.9, 0, 0.5) == pytest.approx((1.4, 0))
    assert carrot([(0.8, 0), (1, 0), (1, 0)], 0.9, 0, 0.5) == pytest.approx((1.4, 0))


def test_a_path_that_begins_too_far_away_is_entered_at_its_beginning():
    assert carrot([(2, 0), (3, 0)], 0, 0, 0.5) == (2, 0)
    assert carrot([(1, 1)], 1, 1, 0.5) == (1, 1)


coordinate = st.floats(-2, 2)
point = st.tuples(coordinate, coordinate)


@settings(deadline=None, max_examples=100)
@given(point, st.floats(-3, 3), st.floats(0, 0.99), st.lists(point, min_size=1, max_size=4), st.floats(0.05, 1))
def test_the_carrot_is_at_the_lookahead_distance_on_any_path(robot, angle, share, rest, distance):
    first = robot[0] + share * distance * math.cos(angle), robot[1] + share * distance * math.sin(angle)
    assume(any(math.dist(other, first) > 1e-6 for other in rest))
    assert math.dist(robot, carrot([first, *rest], *robot, distance)) == pytest.approx(distance, abs=1e-6)


def test_length_is_counted_as_far_as_needed():
    path = [(0, 0), (1, 0), (1, 1), (5, 1)]
    assert path_length(path, math.inf) == 6
    assert 1.5 <= path_length(path, 1.5) <= 2
    assert path_length([(3, 3)], 1.0) == 0


@settings(deadline=None, max_examples=50)
@given(st.floats(0, 5), st.floats(0.1, 5), st.floats(0.01, 0.2))
def test_from_the_stopping_speed_a_robot_stops_in_time_and_no_sooner(distance, acceleration, period):
    speed = stopping_speed(distance, acceleration, period)
    assert speed * period + speed**2 / (2 * acceleration) == pytest.approx(distance, abs=1e-9)


def test_paths_of_many_robots_do_not_disturb_one_another():
    points = np.array([(1, 0), (1, 1), (5, 5), (0, 7), (0, 9)], float)
    first, begin, end = np.array([(0, 0), (5, 4.9), (0, 6.9)], float), np.array([0, 2, 3]), np.array([2, 3, 5])
    place = first + 0.01
    together = carrots(first, points, begin, end, place, 0.5)
    alone = [carrot([first[i], *points[begin[i] : end[i]]], *place[i], 0.5) for i in range(3)]
    assert np.allclose(together, alone, rtol=0, atol=1e-15)
    lengths = path_lengths(first, points, begin, end, np.full(3, 1.5))
    assert lengths == pytest.approx([2.0, 0.1, 2.1])
