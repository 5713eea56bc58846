"""Faults in whole runs in a simulator: what the fleet does about them, and what recordings and replays say."""

import numpy as np
import pytest
from mrpbench_replay.write_page import write_page

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

pytest.importorskip("mrpbench_planners_mapf")
FLEET = {"robot": "turtlebot3_burger", "lidar": "none"}
BASE = {"world": "office", "scenario": {"plugin": "random", "robots": 3}, "planner": "prioritized", "fleet": FLEET}
BASE |= {"roadmap": "graph", "control_rate": 5, "metrics": []}
TASKS = {"tasks": {"plugin": "poisson", "rate": 12, "service": 1}, "assigner": "hungarian"}
TASKS |= {"planner": {"plugin": "rolling_horizon", "planner": "pbs"}, "limits": {"execution": 40, "iterations": 5}}


OPEN = []
"""Recordings to close after a test."""


def run(folder, events, reaction="wait", **changes):
    """The record and the recording."""
    (point,) = load_study(BASE | changes | {"faults": {"events": events, "reaction": reaction, "patience": 10}}).runs
    paths = RunPaths(recording=folder / "run.zip", exports=folder / "exports")
    record = execute(point.config, point.run_id, paths, lambda stage, facts: None)
    OPEN.append(Recording(paths.recording))
    return record, OPEN[-1]


@pytest.fixture(autouse=True)
def _closed():
    yield
    while OPEN:
        OPEN.pop().close()


def events_of(recording):
    """Times, kinds, robots and texts of the faults."""
    rows = zip(
        *(recording.channel(f"event_{name}").tolist() for name in ("time", "kind", "robot", "detail")), strict=True
    )
    return [row for row in rows if row[1] in ("fault", "fault_over")]


def history(recording, task):
    """What happens to a task from its assignment on: the kind, the robot and the time."""
    names = ("event", "robot", "time", "index")
    rows = zip(*(recording.channel(f"task_{name}").tolist() for name in names), strict=True)
    return [row[:3] for row in rows if row[3] == task and row[0] != "released"]


@pytest.mark.parametrize("reaction", ["wait", "replan"])
def test_a_task_that_a_failed_robot_has_not_begun_goes_to_another_one_if_the_fleet_reacts(tmp_path, reaction):
    _, recording = run(tmp_path, [{"kind": "stop", "robot": 0, "at": 30}], reaction, **TASKS)
    since = [(kind, robot) for kind, robot, time in history(recording, 1) if time >= 30]
    assert since == ([] if reaction == "wait" else [("withdrawn", 0), ("assigned", 2)])


@pytest.mark.parametrize("reaction", ["replan", "give_up"])
def test_a_task_that_a_failed_robot_has_begun_stays_its_own_until_it_is_given_up(tmp_path, reaction):
    _, recording = run(tmp_path, [{"kind": "stop", "robot": 1, "at": 22}], reaction, **TASKS)
    (begun,) = [time for kind, robot, time in history(recording, 0) if kind == "begun"]
    assert begun < 22
    since = [(kind, robot) for kind, robot, time in history(recording, 0) if time >= 22]
    assert since == ([] if reaction == "replan" else [("given_up", 1)])
    others = recording.channel("task_robot")[(recording.channel("task_time") > 22.5)]
    assert 1 not in others[recording.channel("task_event")[recording.channel("task_time") > 22.5] == "assigned"]


def test_doors_and_lifts_that_are_out_of_order_hold_robots_as_long_as_they_are(tmp_path):
    broken = [
        {"kind": "out_of_order", "facility": "recovery_door", "at": 0, "lasts": 30},
        {"kind": "out_of_order", "facility": "lift_b", "at": 0},
    ]
    record, recording = run(tmp_path, broken, world="hospital", limits={"execution": 300})
    names = [resource.name for resource in recording.first_context().problem.roadmap.resources]
    time, waits = recording.channel("time"), recording.channel("waits_for")
    asked = np.argwhere(waits == names.index("recovery_door"))
    assert len(asked)
    (robot,) = set(asked[:, 1].tolist())
    assert time[asked[-1, 0]] == pytest.approx(30, abs=5)
    assert "recovery_door" not in record.unarrived[f"robot_{robot}"]
    assert record.status == "execution_aborted"
    assert "waits for lift_b, which is out of order" in record.unarrived.values()
    assert time[-1] < 200
    assert [event[1:] for event in events_of(recording)] == [
        ("fault", -1, "lift_b is out of order for good"),
        ("fault", -1, "recovery_door is out of order for 30.0 s"),
        ("fault_over", -1, "recovery_door is out of order for 30.0 s"),
    ]


def test_slow_blind_and_silent_robots_arrive_and_recordings_and_replays_name_their_faults(tmp_path):
    faults = [
        {"kind": "slow", "robot": 0, "at": 0, "speed": 0.5},
        {"kind": "silent", "robot": 1, "at": 4, "lasts": 20},
        {"kind": "lidar", "robot": 2, "at": 3, "lasts": 10},
    ]
    scans = {"recording": {"scans": True, "rate": 5}, "fleet": {"robot": "turtlebot3_burger"}}
    record, recording = run(tmp_path, faults, **scans)
    assert record.status == "succeeded", record.error
    time, twist = recording.channel("time"), recording.channel("truth_twist")[:, :, 0]
    assert twist[:, 0].max() == pytest.approx(twist[:, 2].max() / 2, rel=0.05)
    silent = (time > 4.4) & (time < 24)
    released, reached = (recording.channel(name)[silent, 1] for name in ("released", "reached"))
    assert len(set(released.tolist())) == 1
    assert (reached <= released[0]).all()
    at, who = recording.channel("scan_time"), recording.channel("scan_robot")
    assert set(who[(at > 3.4) & (at < 12.8)].tolist()) == {0, 1}
    assert set(who[at > 13.4].tolist()) == {0, 1, 2}
    said = [text for _, kind, _, text in events_of(recording) if kind == "fault"]
    write_page(recording, record.message(), tmp_path / "run.html")
    assert all(text in (tmp_path / "run.html").read_text() for text in said)
    assert said == ["has 0.5 times its usual speed for good", "has no lidar for 10.0 s", "is silent for 20.0 s"]
