"""`mrpbench calibrate DIR`."""

import json
from pathlib import Path

import pytest

STUDY = """\
name: drives
world: {plugin: movingai, file: open.map, resolution: 0.4}
roadmap: {plugin: grid, duration_model: kinodynamic}
scenario: {plugin: random, robots: 1}
fleet: {robot: turtlebot3_burger, lidar: none}
assigner: identity
planner: astar
controller: pure_pursuit
simulator: planar
metrics: [planning, throughput]
matrix: {seed: 0..5}
"""


@pytest.fixture
def calibrate(mrpbench):
    """Return the command line in a folder with a study of drives, and its gap with some options of the roadmap."""
    for plugin in ("mrpbench_planners_mapf", "mrpbench_simulators_planar", "mrpbench_controllers_pure_pursuit"):
        pytest.importorskip(plugin)
    Path("open.map").write_text("type octile\nheight 8\nwidth 8\nmap\n" + "........\n" * 8)
    Path("drives.yaml").write_text(STUDY)
    return mrpbench


def gap(folder):
    lines = [line for file in Path(folder, "runs").iterdir() for line in file.read_text().splitlines()]
    metrics = [json.loads(line)["metrics"] for line in lines]
    executed = sum(found["throughput.service_mean_s"] for found in metrics)
    return executed / sum(found["planning.sum_of_costs"] for found in metrics) - 1


def test_plans_with_the_options_found_predict_the_drives(calibrate):
    assert calibrate("run", "drives.yaml", "--out", "before")[0] == 0
    code, output, errors = calibrate("calibrate", "before", "--json")
    assert code == 0, errors
    (found,) = json.loads(output)
    assert found["drives"] == 6
    assert found["before"] == pytest.approx(gap("before"), abs=1e-6)
    options = [f"roadmap.{name}={value}" for name, value in found["options"].items()]
    assert calibrate("run", "drives.yaml", *options, "--out", "after")[0] == 0
    assert abs(gap("after")) < 0.02 < abs(gap("before"))
    assert "speed_share" in calibrate("calibrate", "before")[1]
    code, _, errors = calibrate("calibrate", "after")
    assert code == 2
    assert "was planned with penalties" in errors


def test_plans_by_constant_durations_are_refused(calibrate):
    assert calibrate("run", "drives.yaml", "roadmap.duration_model=constant", "seed=0")[0] == 0
    code, _, errors = calibrate("calibrate", "results/drives")
    assert code == 2
    assert "duration_model: kinodynamic" in errors
