"""Times at doors and lifts, by hand."""

import attrs
import numpy as np
import pytest
from mrpbench_metrics_standard import Waiting
from mrpbench_metrics_standard.waiting import CAUSES

from mrpbench_core.model.planning.roadmap import Resource
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.testing.fixtures.building import CABIN, building

DOOR, LIFT, MUTEX = 0, 1, 2


@pytest.fixture
def run(executed):
    """Two robots for four seconds: one waits for the door and drives on, one waits for the lift and rides."""
    x, y = CABIN
    tracks = [[(0, 0), (0, 0), (0, 0), (1, 0), (2, 0)], [(2, y), (2, y), (x, y), (x, y), (x, y)]]
    made = executed([0, 1, 2, 3, 4], tracks, [[0] * 5] * 2, [[(0, 0), (2, 0)], [(2, y), (x, y)]])
    resources = tuple(
        Resource(name=name, kind=kind) for name, kind in (("door", "door"), ("lift", "lift"), ("lane", "mutex"))
    )
    problem = made.context.problem
    problem = attrs.evolve(problem, roadmap=attrs.evolve(problem.roadmap, resources=resources))
    context = attrs.evolve(made.context, world=building(), problem=problem)
    waits = np.array([[DOOR, LIFT], [DOOR, LIFT], [DOOR, LIFT], [-1, LIFT], [MUTEX, -1]], np.int32)
    channels = dict(made.channels) | {
        "waits_for": lambda: waits,
        "level": lambda: np.array([[0, 0], [0, 0], [0, 0], [0, 1], [0, 1]], np.int16),
        "facility": lambda: np.array([[0, 0, 0], [0, 1, 0], [0.5, 0, 1], [1, 0, 2], [0, 0.2, 3.0]]),
    }
    return FinishedRun(context=context, executed=True, channels=channels)


def test_robots_that_stand_with_an_open_request_wait(run):
    values = Waiting().measure(run)
    assert values["doors_s"] == 2.0  # in the third second it drives
    assert values["lifts_s"] == 1.0  # in the second it drives, then it rides
    assert values["mutexes_s"] == 0.0
    assert values["longest_s"] == 2.0


def test_rides_and_openings_are_counted(run):
    values = Waiting().measure(run)
    assert values["rides"] == 1
    assert values["riding_s"] == 2.0
    assert values["openings"] == 3


def test_without_doors_nothing_opens(run):
    channels = {name: load for name, load in run.channels.items() if name != "facility"}
    assert Waiting().measure(attrs.evolve(run, channels=channels))["openings"] is None


def test_time_lost_is_divided_among_its_causes(run):
    """Robot 0 waits for the door, is stopped by a delay, and drives; robot 1 recovers and is out of order."""
    events = {
        "event_time": np.array([2.0, 2.0]),
        "event_kind": np.array(["delay", "fault"]),
        "event_robot": np.array([0, 1], np.int32),
        "event_detail": np.array(["1 s", "stops for good"]),
    }
    rows = events | {
        "mode": np.array([[1, 2], [1, 2], [0, 0], [0, 0], [1, 0]], np.uint8),
        "reached": np.array([[0, 0]] * 4 + [[1, 0]], np.int32),
        "released": np.array([[0, 1], [0, 1], [1, 1], [1, 1], [1, 1]], np.int32),
        "cleared": np.zeros((5, 2), np.int32),
    }
    channels = dict(run.channels) | {name: (lambda values=values: values) for name, values in rows.items()}
    values = Waiting().measure(attrs.evolve(run, channels=channels))
    lost = {name: values[name] for name in CAUSES if values[name]}
    assert lost == {"resources_s": 2.0, "delays_s": 1.0, "recoveries_s": 2.0, "faults_s": 2.0}


def test_without_progress_no_cause_is_known(run):
    values = Waiting().measure(run)
    assert {values[name] for name in CAUSES} == {None}
