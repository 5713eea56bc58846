"""Tasks that cannot have been done as recorded are named; those that can have been are not."""

import numpy as np
import pytest

from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.referee.tasks import tasks_fault

RATE, STEPS = 2.0, 41
EVENTS = [
    (1.0, 0, "released", -1, -1),
    (1.0, 0, "assigned", 0, -1),
    (6.0, 0, "begun", 0, -1),
    (8.0, 0, "errand", 0, 0),
    (14.0, 0, "errand", 0, 1),
    (14.0, 0, "done", 0, -1),
    (14.5, 1, "released", -1, -1),
]
"""A robot rests at one place from 6 s to 8 s, and comes by another one at 14 s."""


@pytest.fixture
def fault(run_context):
    """Return a function: the fault of a run with these events, after a change of its channels."""
    position = run_context.problem.roadmap.position
    there, next_ = position[0], position[1]

    def find(events=EVENTS, change=lambda channels: None, driven=True):
        time = np.arange(STEPS) / RATE
        truth = np.zeros((STEPS, len(run_context.fleet), 3))
        truth[:, 0, :2] = np.where((time < 11)[:, None], there, next_)
        when, index, kind, robot, errand = zip(*events, strict=True)
        channels = {
            "time": time,
            "truth": truth,
            "truth_twist": np.zeros((STEPS, len(run_context.fleet), 2)),
            "level": np.zeros((STEPS, len(run_context.fleet)), int),
            "errand_task": np.array([0, 0, 1]),
            "errand_number": np.array([0, 1, 0]),
            "errand_time": np.array([1.0, 1.0, 14.5]),
            "errand_goal": np.array([[*there, np.nan], [*next_, np.nan], [*there, np.nan]]),
            "errand_level": np.zeros(3, int),
            "errand_service": np.array([2.0, 0.0, 0.0]),
            "task_time": np.array(when),
            "task_index": np.array(index),
            "task_event": np.array(kind),
            "task_robot": np.array(robot),
            "task_errand": np.array(errand),
        }
        change(channels)
        loaders = {name: (lambda rows=rows: rows) for name, rows in channels.items()}
        return tasks_fault(FinishedRun(context=run_context, executed=True, channels=loaders), driven)

    return find


def test_tasks_that_robots_can_have_done_have_no_fault(fault):
    assert fault() is None


def test_a_robot_that_drives_by_between_two_samples_may_have_been_there(fault):
    def late(channels):
        channels["time"] = channels["time"] + np.where(channels["time"] == 14.0, 0.2, 0.0)
        channels["truth"][28, 0, 0] += 0.3

    assert fault(change=late) is None


def moved(events, at, **changes):
    """The events, with some columns of one of them changed."""
    row = dict(zip(("stamp", "task", "kind", "robot", "errand"), events[at], strict=True)) | changes
    return [*events[:at], tuple(row.values()), *events[at + 1 :]]


@pytest.mark.parametrize(
    ("events", "said"),
    [
        pytest.param(moved(EVENTS, 3, robot=1), "is begun by robot_0 and done by robot_1", id="another robot"),
        pytest.param(moved(EVENTS, 4, stamp=9.0), "errand 1 of task 0 is done at 9 s, but robot_0 is", id="elsewhere"),
        pytest.param([*EVENTS[:3], *EVENTS[4:]], "errand 1 of task 0 is done at 14 s out of its order", id="order"),
        pytest.param([*EVENTS[:4], *EVENTS[5:]], "is done at 14 s without all of its errands", id="left out"),
        pytest.param([*EVENTS, (15.0, 0, "done", 0, -1)], "task 0 is done at 15 s after it was done", id="twice"),
        pytest.param(EVENTS[1:], "task 0 is assigned at 1 s and was not released", id="not released"),
        pytest.param(moved(EVENTS, 6, stamp=14.0), "at 14 s, before its release at 14.5 s", id="too early"),
        pytest.param([*EVENTS, (15.0, 7, "done", 0, -1)], "task 7 is done at 15 s and was not released", id="no task"),
        pytest.param(moved(EVENTS, 5, robot=-1), "task 0 is done by no robot", id="no robot"),
        pytest.param(
            [*EVENTS[:3], (7.0, 1, "released", -1, -1), (7.0, 1, "begun", 0, -1)],
            "before its release",
            id="begun before it is released",
        ),
        pytest.param(
            [*EVENTS[:5], EVENTS[6], (15.0, 1, "begun", 0, -1)],
            "robot_0 does task 1 at 15 s before it has ended task 0",
            id="two at once",
        ),
    ],
)
def test_tasks_that_cannot_have_been_done_are_named(fault, events, said):
    assert said in fault(events)


def test_a_service_without_rest_is_named(fault):
    def drives(channels):
        channels["truth_twist"][14, 0, 0] = 0.2

    assert "robot_0 does not rest there for its service time" in fault(change=drives)


def test_places_are_not_judged_where_no_simulator_moves_the_robots_in_control_periods(fault):
    assert fault(moved(EVENTS, 4, stamp=9.0), driven=False) is None
