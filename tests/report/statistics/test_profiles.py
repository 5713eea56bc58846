"""Cactus plots and performance profiles."""

import numpy as np

from mrpbench_core.report.statistics.profiles import cactus, profiles

NAN = np.nan


def test_a_cactus_plot_counts_the_runs_done_within_a_time():
    times, done = cactus(np.array([3.0, NAN, 1.0, 2.0]))
    assert times.tolist() == [1, 2, 3]
    assert done.tolist() == [1, 2, 3]


def test_profiles_by_hand():
    """Three problems; the second solver fails on the last. At ratio 1 each solver is best on its share."""
    first, second = profiles([np.array([1.0, 4.0, 2.0]), np.array([2.0, 2.0, NAN])])
    assert first[0].tolist() == [1, 1, 2]
    assert second[0].tolist() == [1, 2]
    assert np.allclose(first[1], [1 / 3, 2 / 3, 1])
    assert np.allclose(second[1], [1 / 3, 2 / 3])


def test_a_problem_that_no_planner_solves_keeps_every_profile_below_one():
    first, second = profiles([np.array([1.0, NAN]), np.array([3.0, NAN])])
    assert first[1].tolist() == second[1].tolist() == [0.5]
    assert second[0].tolist() == [3]


def test_costs_of_nothing_are_ties():
    first, second = profiles([np.array([0.0, 0.0]), np.array([0.0, 5.0])])
    assert first[0].tolist() == [1, 1]
    assert second[0].tolist() == [1, np.inf]
