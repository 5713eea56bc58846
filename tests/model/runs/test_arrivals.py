"""A robot has arrived where its true poses say so, whatever its navigator reports."""

import attrs
import numpy as np
import pytest

from mrpbench_core.model.runs.arrivals import arrival_times
from mrpbench_core.model.runs.run import FinishedRun

TIME = np.arange(4.0)


@pytest.fixture
def run(run_context):
    """Return a function: the run of two robots that are at their goals from 2 s on, with some channels replaced."""

    def make(context=run_context, **changes):
        truth = np.zeros((4, 2, 3))
        truth[:, :, 1] = 0.5
        truth[:, 0, 0], truth[:, 1, 0] = [0.5, 1.0, 1.5, 1.5], [1.5, 2.0, 2.5, 2.5]
        channels = {
            "time": TIME,
            "truth": truth,
            "truth_twist": np.zeros((4, 2, 2)),
            "level": np.zeros((4, 2), int),
            "mode": np.zeros((4, 2), int),
            "command": np.zeros((4, 2, 2)),
            "reached": np.array([[0, 0], [1, 0], [2, 1], [2, 1]]),
            **changes,
        }
        loaders = {name: (lambda rows=rows: rows) for name, rows in channels.items() if rows is not None}
        return FinishedRun(context=context, executed=True, channels=loaders)

    return make


def test_robots_arrive_when_they_complete_their_last_move(run):
    assert arrival_times(run()).tolist() == [2.0, 2.0]


def test_a_robot_that_is_only_said_to_arrive_has_not_arrived(run):
    truth = run().channel("truth").copy()
    truth[:, 0, 0] = 0.5
    assert np.isnan(arrival_times(run(truth=truth))).tolist() == [True, False]


def test_a_robot_within_the_tolerance_of_its_goal_has_arrived(run, run_context):
    truth = run().channel("truth").copy()
    truth[-1, 0, 0] -= 0.6
    assert arrival_times(run(truth=truth)).tolist() == [2.0, 2.0]
    strict = attrs.evolve(run_context, goal_tolerance=0.5)
    assert np.isnan(arrival_times(run(strict, truth=truth))).tolist() == [True, False]


def test_a_robot_that_still_drives_or_is_on_another_level_has_not_arrived(run):
    twist, level = np.zeros((4, 2, 2)), np.zeros((4, 2), int)
    twist[-1, 0, 0] = 0.3
    level[-1, 1] = 1
    assert np.isnan(arrival_times(run(truth_twist=twist))).tolist() == [True, False]
    assert np.isnan(arrival_times(run(level=level))).tolist() == [False, True]


def test_without_physics_a_robot_rests_where_its_path_ends(run):
    twist = np.full((4, 2, 2), 0.3)
    assert arrival_times(run(truth_twist=twist, command=None)).tolist() == [2.0, 2.0]


def test_goals_before_the_last_one_are_passed_in_their_order(run, run_context):
    def passes(*sequence):
        goals = (tuple((vertex,) for vertex in sequence), ((2,),))
        near = attrs.evolve(run_context, problem=attrs.evolve(run_context.problem, goals=goals), goal_tolerance=0.2)
        return not np.isnan(arrival_times(run(near))[0])

    assert passes(0, 1)
    assert not passes(2, 1)
    assert not passes(1, 0, 1)


def test_of_other_fleets_only_the_completed_path_is_known(run):
    truth = np.zeros((4, 2, 3))
    assert arrival_times(run(truth=truth, mode=None)).tolist() == [2.0, 2.0]
