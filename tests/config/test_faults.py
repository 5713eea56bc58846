"""The key `faults`: what it accepts, what it refuses, and what has no effect."""

import pytest

from mrpbench_core.config.study import load_study
from mrpbench_core.files.errors import InputErrors

STUDY = {"world": "office", "scenario": {"plugin": "random", "robots": 2}, "planner": "prioritized"}
STOP = {"kind": "stop", "at": 20}


def loaded(**changes):
    (point,) = load_study(STUDY | changes).runs
    return point.config


def test_there_are_no_faults_by_default():
    assert not loaded().faults


def test_the_same_run_without_its_faults_is_another_run_with_the_same_scenario():
    study = load_study(STUDY | {"faults": {"events": [STOP]}, "matrix": {"faults.active": [True, False]}})
    faulty, twin = (point.config for point in study.runs)
    assert faulty.faults
    assert not twin.faults
    assert faulty.scenario == twin.scenario


@pytest.mark.parametrize(
    ("event", "said"),
    [
        ({"kind": "stop"}, "'mtbf' (drawn times) or 'at' (one time) must be given"),
        ({"kind": "stop", "at": 1, "mtbf": 9}, "and not both"),
        ({"kind": "slow", "at": 1, "facility": "door"}, "'facility' is for faults of the kind out_of_order, not slow"),
        ({"kind": "blocked", "at": 1, "robot": 1}, "'robot' is for faults of the kind stop or slow or lidar"),
        ({"kind": "stop", "at": 1, "place": [0, 1]}, "'place' is for faults of the kind blocked"),
        ({"kind": "explode", "at": 1}, "explode"),
    ],
)
def test_an_entry_that_means_nothing_is_refused(event, said):
    with pytest.raises(InputErrors, match=r"(?s).*") as error:
        load_study(STUDY | {"faults": {"events": [event]}})
    assert said in str(error.value)


@pytest.mark.parametrize(
    ("faults", "said"),
    [
        ({"events": [{"kind": "lidar", "at": 1}]}, "faults.events.0: means nothing in `execution: schedule_only`"),
        ({"events": [STOP], "reaction": "replan"}, "faults.reaction: must be `wait` in `execution: schedule_only`"),
    ],
)
def test_what_needs_physics_or_new_plans_is_refused_without_them(faults, said):
    with pytest.raises(InputErrors) as error:
        load_study(STUDY | {"execution": "schedule_only", "faults": faults})
    assert said in str(error.value)


def test_options_without_faults_are_named_as_idle():
    notes = load_study(STUDY | {"faults": {"patience": 9}}).notes
    assert any("faults.patience: has no effect: there are no events" in note for note in notes)
