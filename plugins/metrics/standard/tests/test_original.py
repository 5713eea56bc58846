"""The original's metrics, counted by hand from its definitions."""

import attrs
import numpy as np
import pytest
from mrpbench_metrics_standard import Execution

CELL = Execution(mrp_bench_cell_size=0.4)


def along_x(xs):
    return [(x, 0.0) for x in xs]


def test_duration_runs_from_the_first_departure_to_the_last_arrival(executed):
    """2 Hz: robot 0 is 0.8 m away at 1.5 s (beyond 0.7 m) and 0.6 m from its goal at 4.0 s; robot 1 never leaves."""
    xs = [0, 0, 0.5, 0.8, 1.2, 1.6, 2.0, 2.2, 2.4, 2.6]
    run = executed(
        np.arange(10) / 2,
        [along_x(xs), [(0, 5)] * 10],
        reached=[[0] * 9 + [1], [0] * 10],
        waypoints=[[(0, 0), (3, 0)], [(0, 5)]],
    )
    values = CELL.measure(run)
    assert values["mrp_bench.success"] is True
    assert values["mrp_bench.goals_reached"] == 2
    assert values["mrp_bench.duration_s"] == 4.0 - 1.5


def test_a_goal_once_reached_stays_reached_and_a_missed_one_costs_the_timeout(executed):
    there_and_away = along_x([0, 1, 2, 3, 2, 1, 0])
    never = [(0, 5), (1, 5), (1, 5), (1, 5), (1, 5), (1, 5), (1, 5)]
    run = executed(np.arange(7) / 2, [there_and_away, never], [[0] * 7] * 2, [[(0, 0), (3, 0)], [(0, 5), (3, 5)]])
    values = Execution(mrp_bench_timeout=600.0).measure(run)
    assert (values["mrp_bench.success"], values["mrp_bench.goals_reached"]) == (False, 1)
    assert values["mrp_bench.duration_s"] == 600.0


def test_the_tolerance_itself_is_not_within(executed):
    run = executed([0, 0.5], [along_x([0, 0.75])], [[0, 0]], [[(0, 0), (1.5, 0)]])
    assert Execution(mrp_bench_tolerance=0.75).measure(run)["mrp_bench.goals_reached"] == 0
    assert Execution(mrp_bench_tolerance=0.76).measure(run)["mrp_bench.goals_reached"] == 1


def test_robots_that_never_leave_have_no_duration(executed):
    run = executed([0, 0.5], [along_x([0, 0])], [[0, 0]], [[(0, 0)]])
    values = CELL.measure(run)
    assert values["mrp_bench.success"] is True
    assert values["mrp_bench.duration_s"] is None


def test_where_tasks_keep_coming_there_is_no_goal_to_measure(executed):
    run = executed([0, 0.5], [along_x([0, 1]), [(0, 5)] * 2], [[0, 1], [0, 0]], [[(0, 0), (1, 0)], [(0, 5)]])
    none = dict.fromkeys(("task_time", "task_event", "task_id", "task_robot", "task_errand"), lambda: np.zeros(0, int))
    tasks = attrs.evolve(run, channels={**run.channels, **none})
    one_goal, many = (CELL.measure(it) for it in (run, tasks))
    assert one_goal["mrp_bench.success"] is True
    lost = {name for name in many if name.startswith("mrp_bench.") and (many[name] is None) != (one_goal[name] is None)}
    parts = ("success", "duration_s", "goals_reached", "time_blocked_s", "time_blocked_max_s")
    assert lost == {f"mrp_bench.{part}" for part in parts}
    assert many["mrp_bench.min_distance_m"] == 5.0


def test_blocked_messages_are_counted_over_ten(executed):
    """40 messages, period 19.5 / 40 s. The robot is at 1 m (beyond the start's cell) in messages 2 to 29: the distance
    ten messages back is first known at 11, so 11 to 29 count; then 0.5 m per message, so that at 30 the oldest is 0.5 m
    nearer or more. Before that, it was in its start's cell, which is not looked at.
    """
    xs = [0, 0.2] + [1.0] * 28 + [1.0 + 0.5 * k for k in range(1, 11)]
    run = executed(np.arange(40) / 2, [along_x(xs)], [[0] * 40], [[(0, 0), (9, 0)]])
    values = CELL.measure(run)
    assert values["mrp_bench.time_blocked_s"] == pytest.approx(19 * 19.5 / 40)
    assert values["mrp_bench.time_blocked_max_s"] == pytest.approx(19 * 19.5 / 40)


def test_a_robot_in_its_starts_cell_is_not_blocked(executed):
    run = executed(np.arange(40) / 2, [along_x([0.3] * 40)], [[0] * 40], [[(0, 0), (9, 0)]])
    assert CELL.measure(run)["mrp_bench.time_blocked_s"] == 0
    near_goal = executed(np.arange(40) / 2, [along_x([0.3] * 40)], [[0] * 40], [[(0, 0), (0.6, 0)]])
    tight = Execution(mrp_bench_cell_size=0.4, mrp_bench_tolerance=0.1)
    assert tight.measure(near_goal)["mrp_bench.time_blocked_s"] == pytest.approx(31 * 19.5 / 40)


def test_messages_come_at_two_hertz_at_any_rate_of_the_recording(executed):
    """At 10 Hz the same motion gives the same messages; the nearest moment, 5.2 s, lies between two."""
    slow, quick = np.arange(21) / 2, np.arange(101) / 10
    runs = [
        executed(
            time,
            [along_x(time), [(t, 1 + 2 * abs(t - 5.2)) for t in time]],
            [[0] * len(time)] * 2,
            [[(0, 0), (10, 0)], [(0, 11.4), (10, 10.6)]],
        )
        for time in (slow, quick)
    ]
    few, many = (CELL.measure(run) for run in runs)
    assert many["min_distance_m"] == pytest.approx(1.0)
    assert many["mrp_bench.min_distance_m"] == few["mrp_bench.min_distance_m"] == pytest.approx(1.4)
    original = [name for name in few if name.startswith("mrp_bench.")]
    assert [many[name] for name in original] == pytest.approx([few[name] for name in original])


def test_distance_at_start_and_its_loss_are_reported(executed):
    run = executed([0, 0.5, 1], [along_x([0, 1, 2]), along_x([5, 4.5, 4])], [[0] * 3] * 2, [[(0, 0), (9, 0)]] * 2)
    values = CELL.measure(run)
    assert values["mrp_bench.min_distance_at_start_m"] == 5
    assert values["mrp_bench.min_distance_m"] == 2
    assert values["mrp_bench.min_distance_delta_m"] == 3


def test_the_last_sample_is_seen_even_between_messages(executed):
    run = executed([0, 0.5, 0.7], [along_x([0, 1, 2.6])], [[0, 0, 1]], [[(0, 0), (3, 0)]])
    values = CELL.measure(run)
    assert values["mrp_bench.success"] is True
    assert values["mrp_bench.duration_s"] == pytest.approx(0.2)


@pytest.mark.parametrize(("away", "blocked"), [(0.5, 31), (0.4, 0)])
def test_a_robot_between_a_cell_and_the_tolerance_from_its_start_may_be_blocked(executed, away, blocked):
    run = executed(np.arange(40) / 2, [along_x([away] * 40)], [[0] * 40], [[(0, 0), (9, 0)]])
    assert CELL.measure(run)["mrp_bench.time_blocked_s"] == pytest.approx(blocked * 19.5 / 40)


@pytest.mark.parametrize(("moved", "blocked"), [(0.5, 1), (0.5625, 0)])
def test_exactly_a_cell_in_ten_messages_is_still_blocked(executed, moved, blocked):
    xs = [1.0] * 9 + [1.0 + moved]
    run = executed(np.arange(10) / 2, [along_x(xs)], [[0] * 10], [[(0, 0), (9, 0)]])
    values = Execution(mrp_bench_cell_size=0.5).measure(run)
    assert values["mrp_bench.time_blocked_s"] == pytest.approx(blocked * 4.5 / 10)
