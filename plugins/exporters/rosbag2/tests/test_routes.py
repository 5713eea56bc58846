"""New plans in the bag, and back."""

import numpy as np
import pytest
from mrpbench_exporters_rosbag2 import Rosbag2
from mrpbench_exporters_rosbag2.reading.importer import FromRosbag2

from mrpbench_core import run
from mrpbench_core.engine.analysis import Analysis, analyze
from mrpbench_core.model.run import latest_routes
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


def test_the_last_routes_and_all_rows_come_back(bag, context):
    observed = FromRosbag2().read(bag)
    for name, rows in NEW.items():
        np.testing.assert_array_equal(observed.channels[name], rows)
    expected = latest_routes(context.routes, {name: lambda rows=rows: rows for name, rows in NEW.items()})
    for found, wanted in zip(observed.context.routes, expected, strict=True):
        np.testing.assert_array_equal(found.waypoint, wanted.waypoint)
        np.testing.assert_array_equal(found.speed, wanted.speed)


def test_a_run_with_new_plans_comes_back_with_its_numbers(tmp_path, monkeypatch):
    pytest.importorskip("mrpbench_planners_mapf")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "free.map").write_text("type octile\nheight 6\nwidth 12\nmap\n" + "............\n" * 6)
    (record,) = run(
        {
            "name": "replanned",
            "world": {"plugin": "movingai", "file": "free.map"},
            "roadmap": "grid",
            "scenario": {"plugin": "random", "robots": 3},
            "assigner": "identity",
            "planner": "prioritized",
            "replanning": {"delay": "2 s"},
            "noise": {"start_jitter": "6 s"},
            "metrics": ["execution", "tracking", "stops"],
            "export": ["rosbag2"],
        }
    )
    bag = tmp_path / f"results/replanned/exports/{record['run_id']}/rosbag2"
    metrics = {name: Registry(_metric()).get(name)() for name in ("execution", "tracking", "stops")}
    found = analyze(Analysis(bag=bag, importer=FromRosbag2(), metrics=metrics, out=tmp_path / "back"))
    assert "route_time" in FromRosbag2().read(bag).channels
    assert found["status"] == record["status"]
    for name, value in record["metrics"].items():
        assert found["metrics"][name] == pytest.approx(value, abs=1e-6), name


def _metric():
    from mrpbench_core.api import Metric

    return Metric
