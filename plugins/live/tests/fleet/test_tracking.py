"""Recorded robots follow reports of vehicles within the limits of their models, and arrive where vehicles stand."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_live.fleet.pace import Pace
from mrpbench_live.fleet.reported import OutsideRobots, ReportedFleet
from mrpbench_live.fleet.tracking import Tracker, corners_between, corners_of, straight_ahead

from mrpbench_core.api import Fleet, RobotModel, wrapped

PERIOD = 0.1
ROBOT = RobotModel(
    name="box",
    footprint=[(0.2, 0.15), (-0.2, 0.15), (-0.2, -0.15), (0.2, -0.15)],
    max_speed=0.8,
    max_turn_rate=1.5,
    acceleration=0.6,
    turn_acceleration=2.0,
)
number, speed = st.floats(-3, 3), st.floats(-0.5, 0.8)
reports = st.lists(
    st.tuples(number, number, st.floats(-np.pi, np.pi), speed, st.integers(0, 30)), min_size=1, max_size=12
)


@settings(max_examples=60, deadline=None)
@given(reports)
def test_robots_keep_their_limits_and_arrive(reports):
    tracker = Tracker((ROBOT,), np.zeros((1, 3)), PERIOD)
    poses, steps = [tracker.pose[0]], [steps for *_, steps in reports[:-1]] + [900]
    for (x, y, yaw, speed, _), count in zip(reports, steps, strict=True):
        tracker.report(0, x, y, yaw, 0.0 if count == 900 else speed)
        for _ in range(count):
            tracker.step()
            poses.append(tracker.pose[0])
    poses = np.array(poses)
    shift, turn = np.diff(poses[:, :2], axis=0), wrapped(np.diff(poses[:, 2]))
    assert np.hypot(*shift.T).max() <= ROBOT.max_speed * PERIOD + 1e-9
    assert np.abs(turn).max() <= ROBOT.max_turn_rate * PERIOD + 1e-9
    heading = poses[:-1, 2] + turn / 2
    ahead = (shift[:, 0] * np.cos(heading) + shift[:, 1] * np.sin(heading)) / PERIOD
    assert np.abs(np.diff(ahead)).max() <= ROBOT.acceleration * PERIOD + 1e-6
    assert np.abs(np.diff(turn / PERIOD)).max() <= ROBOT.turn_acceleration * PERIOD + 1e-6
    assert abs(ahead[0]) <= ROBOT.acceleration * PERIOD / 2 + 1e-6  # it begins at rest
    assert abs(turn[0] / PERIOD) <= ROBOT.turn_acceleration * PERIOD / 2 + 1e-6
    x, y, yaw, *_ = reports[-1]
    assert np.hypot(*(poses[-1, :2] - (x, y))) < 0.05
    assert abs(wrapped(poses[-1, 2] - yaw)) < 0.05


ROUTE = np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (4.0, 2.0)])


def test_corners_between_two_places_beside_a_route():
    assert corners_between(ROUTE, (1.5, 0.1), (2.1, 1.5)) == [(2.0, 0.0)]
    assert corners_between(ROUTE, (1.0, 0.0), (3.5, 2.2)) == [(2.0, 0.0), (2.0, 2.0)]
    assert corners_between(ROUTE, (0.5, 0.0), (1.5, 0.0)) == []  # on one leg
    assert corners_between(ROUTE, (3.5, 2.0), (1.0, 0.0)) == []  # against the route
    assert corners_between(ROUTE, (1.0, 0.0), (9.0, 9.0)) == []
    there_and_back = np.concatenate([ROUTE, ROUTE[-2::-1]])
    assert corners_between(there_and_back, (1.5, 0.0), (2.0, 1.0)) == [(2.0, 0.0)]
    assert corners_between(there_and_back, (2.0, 1.0), (1.0, 0.0)) == [(2.0, 0.0)]


def test_a_route_is_its_corners():
    dense = np.concatenate([np.linspace(*leg, 5)[:-1] for leg in itertools.pairwise(ROUTE)] + [ROUTE[-1:]])
    assert corners_of(dense).tolist() == ROUTE.tolist()
    assert [len(corners_of(ROUTE[:count])) for count in range(4)] == [0, 1, 2, 3]


def test_a_robot_stays_beside_its_route_as_far_as_the_next_corner():
    assert straight_ahead(ROUTE, (1.5, 0.0), 0.0) == pytest.approx(0.5)
    assert straight_ahead(ROUTE, (2.0, 0.0), np.pi / 2) == pytest.approx(2.0)
    assert straight_ahead(ROUTE, (2.0, 0.0), np.pi / 4) == 0.0  # it turns
    assert straight_ahead(ROUTE[:0], (2.0, 0.0), 0.0) == np.inf


class Silent(OutsideRobots):
    """A robot that says once where it is, when it has driven around two corners."""

    def serve(self, due):
        self.due = due

    def reports(self):
        yield 0, 4.0, 2.0, 0.0, 0.0

    def route(self, robot):
        return ROUTE

    def close(self):
        self.due = None


def test_a_robot_that_was_not_heard_for_long_goes_along_its_route():
    fleet = Fleet(robots=(ROBOT,))
    simulation = ReportedFleet(Silent(), Pace(1e6), fleet, np.zeros((1, 3)), np.zeros(1, np.int16), PERIOD)
    poses = np.array([simulation.step(None).pose[0] for _ in range(300)])
    assert np.hypot(*(poses[-1, :2] - ROUTE[-1])) < 0.05
    off = [min(_distance(place, *leg) for leg in itertools.pairwise(ROUTE)) for place in poses[:, :2]]
    assert max(off) < 0.15


def _distance(place, tail, head):
    share = np.clip((place - tail) @ (head - tail) / ((head - tail) @ (head - tail)), 0, 1)
    return np.hypot(*(tail + share * (head - tail) - place))
