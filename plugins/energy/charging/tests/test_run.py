"""A whole run: robots run low, charge and go on, and the metric computes it from the recording."""

import numpy as np
import pytest

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

pytest.importorskip("mrpbench_planners_mapf")
ENERGY = {
    "battery": {
        "capacity": 0.2,
        "voltage": 10,
        "mass": 1,
        "inertia": 0.01,
        "ambient": 18,
        "charging_current": 12,
        "initial": 0.7,
    }
}
"""A quarter of a percent a second for devices; a charge takes half a minute."""
STUDY = {
    "world": "office",
    "roadmap": "graph",
    "scenario": {"plugin": "random", "robots": 3},
    "tasks": {
        "plugin": "charging",
        "tasks": {"plugin": "poisson", "rate": 12},
        "energy": ENERGY,
        "below": 0.6,
        "to": 0.9,
    },
    "assigner": "hungarian",
    "planner": {"plugin": "rolling_horizon", "planner": "pibt"},
    "fleet": {"robot": "turtlebot3_burger", "lidar": "none"},
    "control_rate": 5,
    "limits": {"execution": 220, "iterations": 5},
    "metrics": [{"plugin": "energy", "energy": ENERGY}],
}


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """The record and the channels of the recording."""
    folder = tmp_path_factory.mktemp("run")
    (point,) = load_study(STUDY, []).runs
    paths = RunPaths(recording=folder / "run.zip", exports=folder / "exports", picture=None)
    record = execute(point.config, point.run_id, paths, lambda stage, facts: None).message()
    recording = Recording(paths.recording)
    channels = {name: load() for name, load in recording.channels.items()}
    world = recording.first_context().world
    recording.close()
    return record, channels, world


def test_robots_charge_and_go_on(finished):
    record, channels, _ = finished
    assert record["status"] == "succeeded", record
    metrics = record["metrics"]
    assert metrics["energy.charges"] >= 2
    assert metrics["energy.empty"] == 0
    assert 0.1 < metrics["energy.least_charge"] < 0.6
    done = channels["task_time"][channels["task_event"] == "done"]
    assert len(done) > 0


def test_a_robot_that_charges_has_no_task(finished):
    _, channels, world = finished
    docks = np.array([(it.x, it.y) for it in world.vertices if it.parameters.get("is_charger") is True])
    time, pose = channels["time"], channels["truth"]
    gap = np.hypot(*(pose[:, :, None, :2] - docks).transpose(3, 0, 1, 2)).min(axis=2)
    still = (abs(channels["truth_twist"]) < 0.005).all(axis=2) & (gap < 0.5)
    held = 0
    for robot in range(pose.shape[1]):
        mine = channels["task_robot"] == robot
        for at in time[still[:, robot]][50:-1:50]:
            before = mine & (channels["task_time"] <= at)
            if before.any():
                last = channels["task_event"][before][-1]
                held += last in ("begun", "errand")
    assert held == 0


def test_the_metric_is_the_formula_applied_to_the_recording(finished):
    record, channels, _ = finished
    metrics = record["metrics"]
    time, speed = channels["time"], abs(channels["truth_twist"][:, :, 0])
    friction = 0.22 * 1 * 9.81 * ((speed[1:] + speed[:-1]) / 2 * np.diff(time)[:, None]).sum() / 3600
    devices = 18 * (time[-1] - time[0]) * 3 / 3600
    assert metrics["energy.energy_wh"] - metrics["energy.motion_wh"] == pytest.approx(devices, rel=0.01)
    assert metrics["energy.motion_wh"] == pytest.approx(friction, rel=0.05)
    balance = 3 * 2.0 * 0.7 - metrics["energy.energy_wh"] + metrics["energy.charged_wh"]
    spared = metrics["energy.charging_share"] * devices  # chargers supply devices
    assert metrics["energy.charge_end"] * 3 * 2.0 == pytest.approx(balance + spared, rel=0.02)
