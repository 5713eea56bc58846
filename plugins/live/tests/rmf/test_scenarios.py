"""The two scenarios that the prototype publishes, with mrpbench in place of its robots, and of its traffic modules."""

import json
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import pytest

pytest.importorskip("cyclonedds", reason="mrpbench-live[rmf] is not installed")
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.store.instances import InstanceFolder
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

MAP = "type octile\nheight 12\nwidth 14\nmap\n" + "..............\n" * 12
STARTS = "mrpbench_scenario: 1\nrobots: [{x: 1.5, y: 5.5, yaw: 0}, {x: 4.5, y: 5.5, yaw: 0}]\ntasks: []\n"
WORLD = {
    "name": "rmf",
    "world": {"plugin": "movingai", "file": "free.map"},
    "roadmap": "grid",
    "scenario": {"plugin": "file", "file": "starts.yaml"},
    "tasks": "live",
    "metrics": ["execution"],
}


@pytest.fixture
def run(tmp_path, monkeypatch, domain):
    """Execute a study beside a double; return its record, its events, and what the double saw."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "free.map").write_text(MAP)
    (tmp_path / "starts.yaml").write_text(STARTS)
    running = []

    def execute_beside(part, scenario, study, seconds, pace):
        words = [sys.executable, str(Path(__file__).with_name("double.py")), part, scenario, str(domain), str(pace)]
        running.append(subprocess.Popen(words, stdout=subprocess.PIPE, text=True))
        (point,) = load_study({**WORLD, **study, "limits": {"execution": f"{seconds} s"}}, []).runs
        paths = RunPaths(recording=tmp_path / "recordings" / "run.zip", exports=tmp_path / "exports")
        paths.recording.parent.mkdir()
        paths.instances.mkdir()
        record = execute(point.config, point.run_id, paths)
        with closing(Recording(paths.recording, InstanceFolder(paths.instances))) as recording:
            columns = [recording.channels[f"event_{key}"]().tolist() for key in ("kind", "robot", "detail")]
        said, _ = running[0].communicate(timeout=60)
        return record, list(zip(*columns, strict=True)), json.loads(said)

    yield execute_beside
    for process in running:
        process.kill()
        process.wait()


def robots(domain, pace):
    interface = {"plugin": "rmf", "domain": domain, "rate": 20.0}
    return {
        "simulator": "planar",
        "planner": "live",
        "dispatcher": {"plugin": "live", "pace": pace, "interface": interface},
    }


def traffic(domain, pace, dispatcher):
    return {
        "simulator": {"plugin": "rmf", "domain": domain, "pace": pace},
        "navigator": "rmf",
        "localizer": "ground_truth",
        "planner": {"plugin": "rmf", "planner": "prioritized"},
        "dispatcher": {"plugin": "rmf", "dispatcher": dispatcher},
    }


def test_robots_are_redirected_by_an_outside_plan_server(run, domain):
    record, events, seen = run("server", "redirect", robots(domain, 25), 150, 25)
    assert record.status == "succeeded"
    assert (seen["arrived"], seen["redirected"], seen["named"]) == ([True, True], True, ["robot_0", "robot_1"])
    assert record.metrics["execution.robot_contacts"] == 0
    accepted = [detail for kind, robot, detail in events if kind == "plan_accepted" and robot == 0]
    assert len(accepted) == 2


def test_outside_robots_follow_one_another(run, domain):
    record, events, seen = run("robots", "follow", traffic(domain, 8, {"plugin": "adg", "lookahead": 1000}), 60, 8)
    assert record.status == "succeeded"
    assert seen["arrived"] == [True, True]
    assert seen["least"] >= 0.95
    assert {robot for kind, robot, _ in events if kind == "destination"} == {0, 1}
