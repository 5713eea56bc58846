"""Whole executions in the office with each controller: every robot arrives, and none touches anything."""

import pytest

import mrpbench_core

pytestmark = pytest.mark.usefixtures("kept_workers")
NOISE = {"lidar": 0.01, "lidar_dropout": 0.01, "odometry": 0.01, "actuation": 0.05}
CONTROLLERS = ["rpp", "graceful", {"plugin": "rotation_shim", "primary_controller": "rpp"}, "mppi"]


@pytest.mark.parametrize("controller", CONTROLLERS, ids=["rpp", "graceful", "rotation_shim", "mppi"])
def test_robots_drive_through_the_office_without_contact(tmp_path, controller):
    pytest.importorskip("mrpbench_planners_mapf")
    study = {
        "world": "office",
        "scenario": {"plugin": "random", "robots": 3},
        "planner": "prioritized",
        "controller": controller,
        "simulator": "planar",
        "noise": NOISE,
        "metrics": ["execution"],
        "seed": 1,
    }
    (record,) = mrpbench_core.run(study, out=tmp_path)
    assert record["status"] == "succeeded", record.get("error")
    assert record["metrics"]["execution.robot_contacts"] == 0
    assert record["metrics"]["execution.wall_contacts"] == 0
