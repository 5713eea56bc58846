"""New plans in the bag, and back."""

import numpy as np
import pytest
from mrpbench_analysis.analysis import Analysis, analyze
from mrpbench_exporters_rosbag2 import Rosbag2

from mrpbench_core import run
from mrpbench_core.api import Metric
from mrpbench_core.cli.main import main
from mrpbench_core.plugins.registry import Registry

NAN = float("nan")
NEW = {
    "route_time": np.array([2.0] * 3 + [3.0] * 3),
    "route_revision": np.array([1] * 3 + [2] * 3, "i4"),
    "route_robot": np.array([0, 0, 1, 0, 1, 1], "i4"),
    "route_waypoint": np.array([[1, 1, NAN], [1, 3, NAN], [2, 3, 1], [1, 1, NAN], [2, 3, 1], [3, 3, NAN]], float),
    "route_level": np.zeros(6, "i2"),
    "route_speed": np.array([np.inf, 0.1, np.inf, np.inf, np.inf, 0.2]),
}


@pytest.fixture
def bag(context, recording, tmp_path):
    session = Rosbag2(start_time=10.0).open(context, tmp_path / "bag")
    session.write(recording | NEW)
    session.close()
    return tmp_path / "bag"


def test_viewers_get_the_paths_of_every_plan(bag, read):
    said = read(bag)
    for robot, lengths in enumerate(([3, 2, 1], [1, 1, 2])):
        paths = said[f"/robot_{robot}/plan"]
        assert [stamp / 1e9 for stamp, _ in paths] == [10, 12, 13]
        assert [len(message.poses) for _, message in paths] == lengths
    last = said["/robot_1/plan"][-1][1].poses[-1].pose.position
    assert (last.x, last.y, last.z) == (3, 3, 0.5)


def test_the_first_routes_and_all_rows_of_later_ones_come_back(bag, context):
    observed = Rosbag2().read(bag)
    for name, rows in NEW.items():
        np.testing.assert_array_equal(observed.channels[name], rows)
    for found, wanted in zip(observed.context.routes, context.routes, strict=True):
        np.testing.assert_array_equal(found.waypoint, wanted.waypoint)
        np.testing.assert_array_equal(found.speed, wanted.speed)


BESIDE = '''
import attrs
import numpy as np
from mrpbench_core.api import Column, Metric


@attrs.frozen(kw_only=True)
class Beside(Metric):
    """Sums of all estimates, measurements and commands."""

    columns = tuple(Column(name, "", "higher", name) for name in ("estimate", "odometry", "command", "scans", "twist"))
    requires = frozenset({"estimate", "odometry", "command", "scan_time", "scan_robot", "scan_ranges", "truth_twist"})

    def measure(self, run):
        ranges, robot = run.channel("scan_ranges"), run.channel("scan_robot")
        seen = np.where(np.isfinite(ranges), ranges, 0).sum(axis=1, dtype=float)
        return {
            "estimate": float(np.abs(run.channel("estimate") - run.channel("truth")).sum()),
            "odometry": float(np.abs(run.channel("odometry")).sum()),
            "command": float((run.channel("command") ** 2).sum()),
            "scans": float((seen * (1 + robot) * run.channel("scan_time")).mean()),
            "twist": float(np.abs(run.channel("truth_twist")).sum()),
        }
'''


def test_a_run_with_new_plans_comes_back_with_its_numbers(tmp_path, monkeypatch):
    pytest.importorskip("mrpbench_planners_mapf")
    pytest.importorskip("mrpbench_simulators_planar")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "beside.py").write_text(BESIDE)
    names = ("execution", "tracking", "stops")
    (record,) = run(
        {
            "name": "replanned",
            "world": "office",
            "fleet": "turtlebot3_burger",
            "scenario": {"plugin": "random", "robots": 3},
            "planner": "prioritized",
            "replanning": {"delay": "5 s"},
            "noise": {"start_jitter": "8 s", "odometry": 0.05},
            "simulator": "planar",
            "recording": {"scans": True},
            "metrics": [*names, {"plugin": "./beside.py:Beside"}],
            "limits": {"execution": "30 s"},
            "export": ["rosbag2"],
        }
    )
    bag = tmp_path / f"results/replanned/exports/{record['run_id']}/rosbag2"
    local = next(name for name in record["metrics"] if name.endswith(".estimate")).removesuffix(".estimate")
    metrics = {name: Registry(Metric).get(name)() for name in names} | {local: _local(tmp_path / "beside.py")}
    found = analyze(Analysis(bag=bag, format=Rosbag2(), metrics=metrics, out=tmp_path / "back"))
    observed = Rosbag2().read(bag)
    assert "route_time" in observed.channels
    assert (found["status"], found["unmeasured"]) == (record["status"], {})
    assert found["metrics"].keys() == record["metrics"].keys()
    for name, value in record["metrics"].items():
        assert found["metrics"][name] == pytest.approx(value, abs=1e-6), name

    assert main(["export", "results/replanned", "--to", "rosbag2", "--out", "again"]) == 0
    again = Rosbag2().read(tmp_path / "again")
    for one, other in zip(observed.context.routes, again.context.routes, strict=True):
        np.testing.assert_array_equal(one.waypoint, other.waypoint)
    assert observed.channels.keys() == again.channels.keys()
    for name, rows in observed.channels.items():
        np.testing.assert_array_equal(rows, again.channels[name])


def _local(file):
    space = {"__name__": "beside"}
    exec(file.read_text(), space)
    return space["Beside"]()
