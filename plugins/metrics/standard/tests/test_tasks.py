"""The metric `tasks` on events counted by hand, and Little's law on drawn ones."""

import attrs
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mrpbench_metrics_standard import Execution, Tasks


@pytest.fixture
def served(executed):
    """Tasks as (release, assigned, begun, done, robot, deadline), None = never, in 100 s of two robots."""

    def make(tasks):
        run = executed([0, 100], [[(0, 0)] * 2] * 2, [[0, 0]] * 2, [[(0, 0)]] * 2)
        events = [(task[0], index, "released", -1) for index, task in enumerate(tasks)]
        for index, (_, assigned, begun, done, robot, _) in enumerate(tasks):
            named = zip((assigned, begun, done), ("assigned", "begun", "done"), strict=True)
            events += [(time, index, kind, robot) for time, kind in named if time is not None]
        events.sort(key=lambda event: event[0])
        columns = list(zip(*events, strict=True)) or [()] * 4
        channels = {
            "task_time": np.array(columns[0], float),
            "task_index": np.array(columns[1], "i4"),
            "task_event": np.array(columns[2], "U9"),
            "task_robot": np.array(columns[3], "i4"),
            "errand_time": np.array([task[0] for task in tasks], float),
            "errand_task": np.arange(len(tasks), dtype="i4"),
            "errand_deadline": np.array([task[5] for task in tasks], float),
        }
        loaders = {name: (lambda rows=rows: rows) for name, rows in channels.items()}
        return attrs.evolve(run, channels={**run.channels, **loaders})

    return make


TASKS = [
    (0, 0, 10, 20, 0, 15.0),
    (10, 20, 40, 50, 0, 60.0),
    (30, 30, 50, None, 1, 80.0),
    (90, None, None, None, -1, np.inf),
]


def test_tasks_are_measured_as_counted_by_hand(served):
    values = Tasks().measure(served(TASKS))
    assert (values["released"], values["done"], values["open_end"], values["refused"]) == (4, 2, 2, 0)
    assert values["per_hour"] == pytest.approx(72)
    assert values["service_mean_s"] == pytest.approx(30)
    assert values["wait_mean_s"] == pytest.approx((10 + 30 + 20) / 3)
    assert values["age_max_s"] == pytest.approx(70)
    assert values["open_mean"] == pytest.approx((20 + 40 + 70 + 10) / 100)
    assert (values["late"], values["tardiness_mean_s"]) == (2, pytest.approx((5 + 0 + 20) / 3))
    assert values["utilisation"] == pytest.approx((20 + 30 + 70) / 200)
    assert values["jain"] == pytest.approx(0.5)


def test_a_robot_without_a_task_is_not_blocked_and_no_robot_arrives(executed):
    """Of 10 s at one place, a robot has a task from 2 s to 7 s; the other one has it all the time."""
    time = np.arange(0, 11.0)
    run = executed(time, [[(0, 0)] * 11, [(0, 4)] * 11], [[0] * 11] * 2, [[(0, 0), (5, 0)], [(0, 4), (5, 4)]])
    columns = {"time": [0, 2, 7.0], "event": ["assigned", "assigned", "done"], "robot": [1, 0, 0]}
    channels = {f"task_{name}": (lambda rows=rows: np.array(rows)) for name, rows in columns.items()}
    values = Execution(blocked_window=1.0).measure(attrs.evolve(run, channels={**run.channels, **channels}))
    assert values["time_blocked_s"] == pytest.approx((7 - 2) + 10)
    assert [values[name] for name in ("success", "duration_s", "goals_reached")] == [None] * 3


def test_distances_are_split_by_what_robots_carry(executed):
    run = executed(
        [0, 10, 20, 30, 40],
        [[(0, 0), (2, 0), (2, 4), (2, 4), (8, 4)], [(0, 9), (1, 9), (1, 9), (5, 9), (5, 9)]],
        [[0] * 2] * 5,
        [[(0, 0)]] * 2,
    )
    events = [
        (0, 0, "released", -1, -1), (0, 1, "released", -1, -1), (5, 1, "begun", 1, -1), (10, 0, "errand", 0, 0),
        (15, 1, "errand", 1, 0), (20, 0, "errand", 0, 1), (20, 0, "done", 0, -1),
    ]  # fmt: skip
    kinds = {"time": float, "index": "i4", "event": "U9", "robot": "i4", "errand": "i4"}
    columns = {
        f"task_{name}": np.array(row, kinds[name]) for name, row in zip(kinds, np.array(events, object).T, strict=True)
    }
    columns |= {"errand_time": np.zeros(2), "errand_task": np.arange(2), "errand_deadline": np.full(2, np.inf)}
    channels = {name: (lambda rows=rows: rows) for name, rows in columns.items()}
    values = Tasks().measure(attrs.evolve(run, channels={**run.channels, **channels}))
    assert values["loaded_m"] == pytest.approx(4 + 4)  # the task of robot 1 is not done yet
    assert values["empty_m"] == pytest.approx(2 + 6 + 1)


def test_throughput_leaves_out_the_warm_up(served):
    assert Tasks(warm_up=30.0).measure(served(TASKS))["per_hour"] == pytest.approx(3600 / 70)
    assert Tasks(warm_up=100.0).measure(served(TASKS))["per_hour"] is None


def test_without_tasks_times_are_null(served):
    values = Tasks().measure(served([]))
    assert (values["per_hour"], values["done"], values["service_mean_s"], values["jain"]) == (0, 0, None, None)


@settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.tuples(st.integers(0, 50), st.integers(1, 49)), min_size=1, max_size=20))
def test_when_all_are_done_littles_law_holds(served, drawn):
    """L = λW: the mean number of open tasks is the throughput times the mean service time."""
    values = Tasks().measure(
        served([(release, release, release, release + service, 0, np.inf) for release, service in drawn])
    )
    assert values["open_mean"] == pytest.approx(values["per_hour"] / 3600 * values["service_mean_s"])


@pytest.mark.parametrize("left", [0.0, 0.25, 1.0])
def test_the_growth_is_the_share_of_tasks_that_pile_up(served, left):
    """One task a second; of four in turn, 4 * `left` are never done, and the others are done at once."""
    tasks = [(i, i, i, None if i % 4 < 4 * left else i, 0, np.inf) for i in range(100)]
    assert Tasks().measure(served(tasks))["open_growth"] == pytest.approx(left, abs=0.02)


def test_the_growth_leaves_out_the_warm_up(served):
    early = [(i / 10, None, None, None, -1, np.inf) for i in range(100)]
    tasks = early + [(i, i, i, i + 1, 0, np.inf) for i in range(50, 100)]
    assert Tasks(warm_up=40.0).measure(served(tasks))["open_growth"] == pytest.approx(0, abs=0.05)
    assert Tasks(warm_up=98.5).measure(served(tasks))["open_growth"] is None


def test_the_service_level_counts_tasks_whose_time_has_passed(served):
    run = served(TASKS)  # done after 20 s and 40 s, never, and released 10 s before the end
    assert Tasks().measure(run)["service_level"] is None
    assert Tasks(within=40.0).measure(run)["service_level"] == pytest.approx(1 / 2)  # of those after the beginning
    assert Tasks(within=39.0).measure(run)["service_level"] == 0
    assert Tasks(within=10.0, warm_up=30.0).measure(run)["service_level"] == 0
    assert Tasks(within=40.0, warm_up=30.0).measure(run)["service_level"] is None
