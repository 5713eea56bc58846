"""Studies with tasks that keep coming give the same recordings however they are executed."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest

from mrpbench_core import run

pytest.importorskip("mrpbench_planners_mapf")
STUDY = {
    "name": "tasks",
    "world": "office",
    "roadmap": "graph",
    "scenario": {"plugin": "random", "robots": 2},
    "tasks": {"plugin": "poisson", "rate": 20, "service": 1},
    "assigner": "identity",
    "planner": {"plugin": "rolling_horizon", "planner": "lns"},
    "fleet": {"robot": "turtlebot3_burger", "lidar": "none"},
    "control_rate": 5,
    "limits": {"execution": 10, "iterations": 3},
    "metrics": ["tasks"],
    "matrix": {"seed": [0, 1]},
}


def recordings(folder):
    return {file.name: file.read_bytes() for file in folder.rglob("recordings/*.zip")}


def measured(records):
    return {record["run_id"]: (record["status"], record["metrics"]) for record in records}


def test_two_workers_and_a_killed_study_give_the_recordings_of_an_undisturbed_one(tmp_path):
    records = list(run(STUDY, out=tmp_path / "one", workers=1))
    undisturbed = recordings(tmp_path / "one")
    assert len(undisturbed) == 2
    program = f"from mrpbench_core import run; run({json.dumps(STUDY)}, out={str(tmp_path / 'two')!r}, workers=2)"
    killed = subprocess.Popen([sys.executable, "-c", program], start_new_session=True)
    give_up = time.monotonic() + 60
    while not recordings(tmp_path / "two") and killed.poll() is None and time.monotonic() < give_up:
        time.sleep(0.01)
    os.killpg(killed.pid, signal.SIGKILL)
    killed.wait()
    resumed = list(run(STUDY, out=tmp_path / "two", workers=2))
    assert recordings(tmp_path / "two") == undisturbed
    assert measured(resumed) == measured(records)
