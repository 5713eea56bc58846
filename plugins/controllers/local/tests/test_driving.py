"""Whole executions in the office with each controller: every robot arrives, and none touches anything."""

import numpy as np
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


def raster_map(folder, seed):
    """A ROS map of 15 m x 12 m with thin pillars and diagonal walls."""
    draws, grey = np.random.default_rng(seed), np.full((240, 300), 254)
    grey[[0, -1]], grey[:, [0, -1]] = 0, 0
    for _ in range(40):
        row, column, size = draws.integers([12, 12, 1], [228, 288, 4])
        grey[row : row + size, column : column + size] = 0
    for _ in range(7):
        start, angle = draws.uniform([20, 20], [220, 280]), draws.uniform(0, np.pi)
        along = np.arange(0, draws.uniform(20, 60), 0.5)[:, None]
        rows, columns = np.clip(start + along * [np.sin(angle), np.cos(angle)], 1, [238, 298]).astype(int).T
        grey[rows, columns] = 0
    (folder / "map.pgm").write_text(f"P2\n300 240\n255\n{' '.join(map(str, grey.ravel()))}\n")
    (folder / "map.yaml").write_text(
        "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n"
    )
    return str(folder / "map.yaml")


@pytest.mark.parametrize("seed", [5, 16, 21])  # where robots touched something before hits were exact
def test_dwb_keeps_clear_of_thin_pillars_and_diagonal_walls(tmp_path, seed):
    study = {
        "world": {"plugin": "ros_map", "file": raster_map(tmp_path, seed)},
        "roadmap": {"plugin": "grid", "cell_size": 0.5},
        "scenario": {"plugin": "random", "robots": 8},
        "planner": "prioritized",
        "controller": "dwb",
        "simulator": "planar",
        "metrics": ["execution"],
        "seed": seed,
    }
    (record,) = mrpbench_core.run(study, out=tmp_path / "results")
    assert record["status"] == "succeeded", record.get("error")
    assert record["metrics"]["execution.wall_contacts"] == 0


@pytest.mark.parametrize("seed", [6, 8, 18])  # rpp begins to drive before it heads along the lane, and meets a shelf
def test_a_robot_that_finds_a_collision_ahead_turns_to_its_path_and_arrives(tmp_path, seed):
    pytest.importorskip("mrpbench_planners_mapf")
    study = {
        "world": "warehouse",
        "scenario": {"plugin": "random", "robots": 6},
        "planner": "cbs",
        "controller": "rpp",
        "simulator": "planar",
        "metrics": ["execution"],
        "seed": seed,
    }
    (record,) = mrpbench_core.run(study, out=tmp_path)
    assert record["status"] == "succeeded", record.get("error")


def test_burgers_that_make_room_for_a_waffle_with_dwb_clear_the_crossing(tmp_path):
    study = {
        "world": "warehouse",
        "scenario": {"plugin": "random", "robots": 4},
        "fleet": [{"robot": "turtlebot3_burger", "count": 3}, "turtlebot3_waffle"],
        "planner": "prioritized",
        "controller": "dwb",
        "simulator": "planar",
        "metrics": ["execution"],
        "limits": {"execution": 200.0},
        "seed": 0,
    }
    (record,) = mrpbench_core.run(study, out=tmp_path)
    assert record["status"] == "succeeded", record.get("error")


def test_a_robot_that_mppi_leaves_beside_a_bend_drives_on(tmp_path):
    pytest.importorskip("mrpbench_planners_mapf")
    study = {
        "world": "office",
        "scenario": {"plugin": "random", "robots": 5},
        "planner": "eecbs",
        "controller": "mppi",
        "simulator": "planar",
        "metrics": ["execution"],
        "seed": 2,
    }
    (record,) = mrpbench_core.run(study, out=tmp_path)
    assert record["status"] == "succeeded", record.get("error")
    assert record["metrics"]["execution.duration_s"] < 58  # 65 s where the robot waits for its recoveries
