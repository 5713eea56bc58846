"""The metric `deadlock` on standstills timed by hand."""

import attrs
import numpy as np
from mrpbench_metrics_standard import Deadlock

METRIC = Deadlock(window=2.0, distance=0.5)
WAY = [(0, 0), (9, 0)]


def along_x(xs):
    return [(x, 0.0) for x in xs]


def test_a_deadlock_begins_a_window_after_all_robots_stand(executed):
    """Both stand from t = 2; robot 0 goes on at 6, so that at 7 it has advanced 1 m in 2 s: the three
    seconds that end at 4, 5 and 6 count.
    """
    both = [along_x([0, 1, 2, 2, 2, 2, 2, 3, 4]), along_x([0, 1, 2, 2, 2, 2, 2, 2, 2])]
    values = METRIC.measure(executed(range(9), both, [[0] * 9] * 2, [WAY] * 2))
    assert values == {"time_s": 3.0, "longest_s": 3.0, "count": 1, "unresolved": False}


def test_progress_of_one_robot_is_no_deadlock(executed):
    one_goes = [along_x(range(9)), along_x([0] * 9)]
    values = METRIC.measure(executed(range(9), one_goes, [[0] * 9] * 2, [WAY] * 2))
    assert values == {"time_s": 0.0, "longest_s": 0.0, "count": 0, "unresolved": False}


def test_robots_that_arrived_do_not_count(executed):
    """Robot 0 arrives at 3 while robot 1 stands all along: from 3 to the end at 8 no robot makes progress."""
    tracks = [along_x([0, 3, 6, 9, 9, 9, 9, 9, 9]), along_x([0] * 9)]
    reached = [[0, 0, 0, 1, 1, 1, 1, 1, 1], [0] * 9]
    values = METRIC.measure(executed(range(9), tracks, reached, [WAY] * 2))
    assert values == {"time_s": 6.0, "longest_s": 6.0, "count": 1, "unresolved": True}


def test_when_all_have_arrived_nothing_is_stuck(executed):
    values = METRIC.measure(executed(range(9), [along_x([9] * 9)], [[1] * 9], [WAY]))
    assert (values["time_s"], values["unresolved"]) == (0.0, False)


def test_two_spells_are_counted_and_the_longest_is_told(executed):
    xs = [0, 0, 0, 0, 0, 1, 2, 2, 2, 3]
    values = METRIC.measure(executed(range(10), [along_x(xs)], [[0] * 10], [WAY]))
    assert values == {"time_s": 4.0, "longest_s": 3.0, "count": 2, "unresolved": False}


def test_a_recording_with_holes_in_its_positions_is_not_measured(executed):
    run = executed(range(3), [along_x([0, np.nan, 0])], [[0] * 3], [WAY])
    assert set(METRIC.measure(run).values()) == {None}
    assert set(METRIC.measure(attrs.evolve(run, channels={})).values()) == {None}
