"""Whole runs on PyBullet: the same bytes anywhere, and the same figures as on other simulators within bounds."""

import numpy as np
import pytest

import mrpbench_core
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.execution import Inputs
from mrpbench_core.model.fleet import Fleet
from mrpbench_core.model.world import Level, World

pytest.importorskip("pybullet", reason="PyBullet has no wheel for this Python")
from mrpbench_simulators_pybullet import PyBullet

PERIOD = 0.05
EMPTY = World(name="empty", levels=(Level(name="L1"),))
STUDY = {
    "world": "office",
    "scenario": {"plugin": "random", "robots": 4},
    "assigner": "identity",
    "planner": "example",
    "metrics": ["execution"],
}


def test_recordings_are_the_same_at_any_number_of_workers(tmp_path):
    """With noise, scans and localisation on."""
    pytest.importorskip("mrpbench_localizers_amcl")
    study = {
        **STUDY,
        "metrics": [],
        "localizer": "amcl",
        "noise": {"lidar": 0.01, "lidar_dropout": 0.05, "odometry": 0.005, "actuation": 0.05, "start_jitter": "1 s"},
        "recording": {"scans": True},
        "limits": {"execution": "4 s"},
        "matrix": {"simulator": ["pybullet", {"plugin": "pybullet", "model": "body"}], "seed": [0, 1]},
    }

    def recordings(name, workers):
        mrpbench_core.run(study, out=tmp_path / name, workers=workers)
        return {file.name: file.read_bytes() for file in (tmp_path / name).rglob("recordings/*.zip")}

    one, two = recordings("one", 1), recordings("two", 2)
    assert len(one) == 4
    assert one == two


def test_positions_drift_apart_slowly_under_the_same_commands():
    """Commands of a minute that change every second: where wheels slip, errors of heading grow to errors of place."""
    planar = pytest.importorskip("mrpbench_simulators_planar").Planar()
    fleet, starts = Fleet(robots=(load_robot("turtlebot3_burger"),) * 6), np.zeros((6, 3))
    starts[:, 0] = np.arange(6) * 10.0
    random = np.random.default_rng(11)
    commands = [random.uniform([0.05, -1.0], [0.22, 1.0], (6, 2)) for _ in range(60)]

    def poses(simulator):
        with simulator.open(EMPTY, fleet, starts, 0, PERIOD) as simulation:
            return np.array([simulation.step(Inputs(twist=commands[step // 20])).pose for step in range(1200)])

    exact = poses(planar)
    for model, bounds in (("body", (1e-6, 1e-6, 1e-6)), ("wheels", (0.03, 0.1, 0.25))):
        off = np.hypot(*np.moveaxis(poses(PyBullet(model=model)) - exact, -1, 0)[:2])
        for seconds, bound in zip((5, 20, 60), bounds, strict=True):
            assert off[: seconds * 20].max() < bound, (model, seconds)


def test_the_same_scenario_has_like_figures_on_every_simulator(tmp_path):
    pytest.importorskip("mrpbench_simulators_planar")
    simulators = ["planar", "kinematic", "pybullet", {"plugin": "pybullet", "model": "body"}]
    robots = {"fleet": {"robot": "turtlebot3_burger", "lidar": "none"}, "scenario": {"plugin": "random", "robots": 3}}
    records = mrpbench_core.run({**STUDY, **robots, "matrix": {"simulator": simulators}}, out=tmp_path)
    metrics = [record["metrics"] for record in records]
    assert [record["status"] for record in records] == ["succeeded"] * 4
    assert len({record["scenario_id"] for record in records}) == 1
    duration = np.array([found["execution.duration_s"] for found in metrics])
    nearest = np.array([found["execution.min_distance_m"] for found in metrics])
    assert np.ptp(duration) < 0.02 * duration.min()
    assert np.ptp(nearest) < 0.05
    for name in ("goals_reached", "robot_contacts", "wall_contacts"):
        assert len({found[f"execution.{name}"] for found in metrics}) == 1
