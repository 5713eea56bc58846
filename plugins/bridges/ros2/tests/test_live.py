"""Over loopback, with nodes in other processes that know nothing of mrpbench."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from mrpbench_core import run
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.recording import Recording
from mrpbench_core.store.results import Results

pytest.importorskip("rclpy", reason="ROS 2 is not here: see docs/how-to/live-ros.md, or `make ros`")

MAP = "type octile\nheight 6\nwidth 8\nmap\n" + "........\n" * 6
STUDY = {
    "name": "live",
    "world": {"plugin": "movingai", "file": "free.map"},
    "roadmap": "grid",
    "scenario": {"plugin": "random", "robots": 2},
    "assigner": "identity",
    "planner": "example",
    "metrics": ["execution"],
}
HERE = Path(__file__).parent


@pytest.fixture(autouse=True)
def alone(tmp_path, monkeypatch):
    """A folder with a map, and a ROS domain of this test's own that ends at this machine."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ROS_DOMAIN_ID", str(1 + os.getpid() % 100))
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    (tmp_path / "free.map").write_text(MAP)


@pytest.fixture
def started():
    """Starts programs of this folder; they end with the test."""
    running = []

    def start(name, *words):
        running.append(subprocess.Popen([sys.executable, str(HERE / name), *words], stdout=subprocess.PIPE, text=True))
        return running[-1]

    yield start
    for process in running:
        process.kill()
        process.wait()
        process.stdout.close()


def recording(record):
    return Recording(Results(ResultsFolder(Path("results/live"))).folder.run(record["run_id"]).recording)


def test_an_outside_stack_drives_the_robots_to_their_goals(started):
    started("outside.py", "drive", "robot_0", "robot_1")
    (record,) = run({**STUDY, "navigator": {"plugin": "ros2", "pace": 4.0, "silence": "2 s"}})
    assert (record["status"], record.get("error")) == ("succeeded", None)
    assert record["provenance"]["live"] is True
    assert record["metrics"]["execution.goals_reached"] == 2


def test_a_robot_stops_when_its_stack_falls_silent(started):
    started("outside.py", "mute", "robot_0", "robot_1")
    (record,) = run({**STUDY, "limits": {"execution": "8 s"}, "navigator": {"plugin": "ros2", "pace": 2.0}})
    assert record["status"] == "goals_missed"
    found = recording(record)
    time, turn = found.channel("time"), found.channel("command")[..., 1]
    found.close()
    told = time[turn.any(axis=1)]  # one robot may wait for the other all the time
    assert len(told) > 2
    assert told[-1] - told[0] < 3  # of 8 s: the stack spoke for one, and was heeded for another half
    assert told[-1] < 7


def test_without_a_stack_the_run_is_refused_in_one_line():
    with pytest.raises(Exception, match="no node publishes /robot_0/cmd_vel"):
        run({**STUDY, "navigator": {"plugin": "ros2", "patience": "0.2 s"}})


def test_watching_a_run_does_not_change_it(started, monkeypatch):
    robot = {"robot": "turtlebot3_burger", "lidar": {"beams": 30, "range": 3.5}}
    study = {**STUDY, "fleet": [robot], "limits": {"execution": "4 s"}}
    (alone,) = run({**study, "name": "alone"})
    listener = started("listener.py", "3.9", "robot_0", "robot_1")
    assert listener.stdout.readline() == "ready\n"
    monkeypatch.setenv("MRPBENCH_ROS2", "2")
    (record,) = run(study)
    assert record["metrics"] == alone["metrics"]
    assert record["provenance"]["live"] is False
    assert record["timing"]["execution_wall_s"] >= 1.9
    heard = json.loads(listener.communicate(timeout=30)[0])
    found = recording(record)
    goals = found.context().goal
    found.close()
    steps = np.diff(heard["stamps"])
    assert (steps > 0).all()
    assert heard["ends"] == {f"robot_{index}": list(goal[:2]) for index, goal in enumerate(goals)}
    assert heard["free"] == heard["cells"] > 0
    assert heard["frames"] == ["robot_0/odom", "robot_1/odom"]
    assert heard["beams"] == [30]
    assert heard["counts"]["robot_0/base_footprint"] >= 0.9 * len(heard["stamps"])
    assert heard["counts"]["robot_1/base_scan"] >= 10
