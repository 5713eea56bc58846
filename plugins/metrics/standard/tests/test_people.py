"""The metric `people` on encounters counted by hand."""

import math

import attrs
import numpy as np
import pytest
from mrpbench_metrics_standard import People
from mrpbench_metrics_standard.freezing import freezings
from mrpbench_metrics_standard.hunav import FACTOR, social_force
from mrpbench_metrics_standard.people import time_to_collision

from mrpbench_core.model.execution.movers import Mover


@pytest.fixture
def met(executed):
    """A robot (radius 0.2 m) in the origin for 100 s, at `speed`, and a person (0.3 m) along y = 1 from x = -5 to 5."""

    def make(speed=0.0, contacts=(), absent=(), released=1):
        time = np.arange(101.0)
        run = executed(time, [[(0, 0)] * 101], [[0] * 101], [[(0, 0), (3, 0)]], radii=[0.2], contacts=contacts)
        person = np.zeros((101, 1, 5))
        person[:, 0, 0], person[:, 0, 1], person[:, 0, 3] = np.linspace(-5, 5, 101), 1.0, 0.1
        level = np.zeros((101, 1), "i2")
        level[list(absent)] = -1
        twist = np.zeros((101, 1, 2))
        twist[..., 0] = speed
        orders = np.full((101, 1), released, "i4")
        channels = {"truth_twist": twist, "mover": person, "mover_level": level, "released": orders}
        loaders = {name: (lambda rows=rows: rows) for name, rows in channels.items()}
        context = attrs.evolve(run.context, movers=(Mover(radius=0.3),))
        return attrs.evolve(run, context=context, channels={**run.channels, **loaders})

    return make


def test_times_within_hall_s_distances_are_those_of_a_hand_count(met):
    found = People().measure(met())
    assert found["distance_min_m"] == pytest.approx(0.5)
    assert found["intimate_standing_s_per_h"] == found["personal_moving_s_per_h"] == 0
    assert found["personal_standing_s_per_h"] == pytest.approx(27 * 36)  # 27 of 101 samples, a second each, in 100 s
    assert People().measure(met(speed=0.1))["personal_moving_s_per_h"] == pytest.approx(27 * 36)


def test_contacts_count_by_hours_of_robots_and_of_people(met):
    contacts = [(10.0, 0, 1), (10.5, 0, 1), (20.0, 0, 1), (30.0, 0, -1)]
    found = People().measure(met(contacts=contacts))
    assert found["contacts_per_robot_h"] == found["contacts_per_person_h"] == pytest.approx(2 * 36)
    half = People().measure(met(contacts=contacts, absent=range(50, 101)))
    assert half["contacts_per_robot_h"] == pytest.approx(2 * 36)
    assert half["contacts_per_person_h"] == pytest.approx(2 * 72)


def test_time_per_goal_counts_those_who_have_goals(met):
    run = met()
    assert People().measure(run)["goal_time_s"] is None  # recordings of before do not count arrivals
    for arrivals, expected in ((np.arange(101) // 20, 20), (np.zeros(101), None), (np.full(101, -1), None)):
        rows = arrivals.astype("i4")[:, None]
        counted = attrs.evolve(run, channels={**run.channels, "mover_arrivals": lambda rows=rows: rows})
        assert People().measure(counted)["goal_time_s"] == expected


def test_a_robot_freezes_where_a_person_is_near_and_it_may_drive_on(met):
    found = People().measure(met())
    assert found["freezings_per_robot_h"] == pytest.approx(36)
    assert found["freezing_share"] == pytest.approx(0.45)  # the person is less than 2 m away from 28 s to 73 s
    twice = People().measure(met(absent=[*range(30, 41), 44]))  # 28 s to 30 s is too short
    assert twice["freezings_per_robot_h"] == pytest.approx(2 * 36)
    assert twice["freezing_share"] == pytest.approx(0.31)
    for other in (met(released=0), met(speed=0.03)):
        assert People().measure(other)["freezings_per_robot_h"] == 0


def test_a_robot_that_another_one_stops_does_not_freeze():
    time, near, far = np.arange(5.0), np.full((5, 1), 0.5), np.full((5, 1), 0.6)
    waits, stands = np.zeros((5, 1, 2)), np.full((5, 1), True)
    assert freezings(time, waits, stands, person=far, robot=near) == (0, 0.0)
    assert freezings(time, waits, stands, person=near, robot=far) == (1, 4.0)


def test_one_who_is_absent_is_nowhere_near(met):
    assert People().measure(met(absent=range(45, 56)))["distance_min_m"] == pytest.approx(np.hypot(0.6, 1) - 0.5)


@pytest.mark.parametrize(
    ("offset", "expected"),
    [((2, 0), 0.7), ((2, 0.5), 0.834169), ((2, 0.7), np.inf), ((0.5, 0), 0.0), ((-2, 0), np.inf)],
)
def test_the_time_to_a_collision_is_that_of_two_discs(offset, expected):
    found = time_to_collision(np.array(offset, float), np.array([-2.0, 0.0]), np.array(0.6))
    assert found == pytest.approx(expected, abs=1e-6)


def test_hunavsim_s_measures_are_those_of_a_hand_count(met):
    found = People().measure(met())
    expected = {
        "intimate_space_intrusions": 0.0,
        "personal_space_intrusions": 26.733,
        "social_space_intrusions": 51.485,
        "minimum_distance_to_people": 0.5,
        "avg_distance_to_closest_person": 2.303869,
        "avg_pedestrian_velocity": 0.1,
        "avg_closest_pedestrian_velocity": 0.1,
        "time_not_moving": 100.0,
        "path_length": 0.0,
        "cumulative_heading_changes": 0.0,
    }
    assert {name: found[f"hunav.{name}"] for name in expected} == pytest.approx(expected, abs=1e-3)
    assert found["hunav.social_force_on_agents"] > 0
    away = People().measure(met(absent=range(101)))
    assert away["hunav.avg_distance_to_closest_person"] is away["distance_min_m"] is None


@pytest.mark.parametrize(
    ("place", "velocity", "expected"),
    [
        ((2, 0), (-1, 0), (-0.669704, 0)),
        ((2, 0.2), (-1, 0), (-0.546099, -0.626500)),
        ((2, -0.2), (-1, 0), (-0.546099, 0.626500)),
        ((1, -1), (0, 1), (-0.516821, 0.516821)),
        ((1, 0), (0.5, 0), (-0.503267, 0)),
        ((0, 0.7), (1, 0), (0, -0.284204)),
        ((1, 0), (1.3, 0), (-2.1 * math.exp(-1 / (0.35 * 0.4)), 0)),  # who goes ahead and is faster hardly matters
    ],
)
def test_the_social_force_is_that_of_lightsfm(place, velocity, expected):
    force = social_force(np.array(place, float), np.array([1.0, 0.0]) - velocity) * 2.1 / FACTOR
    np.testing.assert_allclose(force, expected, atol=1e-6)


def test_runs_without_movers_have_null(executed):
    run = executed([0, 1], [[(0, 0)] * 2], [[0, 0]], [[(0, 0)]])
    assert set(People().measure(run).values()) == {None}
