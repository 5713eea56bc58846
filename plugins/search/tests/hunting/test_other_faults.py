"""The planted faults: each shows in the situation that it is about, where the honest component does well."""

from pathlib import Path

import pytest

from mrpbench_core.store.results import load

OPEN = "type octile\nheight 3\nwidth 20\nmap\n" + ("." * 20 + "\n") * 3
PLANNED = """\
name: planned
world: {plugin: movingai, file: open.map}
roadmap: grid
scenario: {plugin: file, file: starts.yaml}
assigner: identity
planner: PLANNER
simulator: none
metrics: [planning]
"""
OVER_TIME = """\
name: over_time
world: {plugin: movingai, file: open.map, resolution: 0.5}
roadmap: grid
scenario: {plugin: file, file: starts.yaml}
fleet: {robot: turtlebot3_burger, lidar: none}
tasks: {plugin: file, file: starts.yaml}
assigner: ASSIGNER
planner: {plugin: rolling_horizon, planner: pibt}
limits: {execution: 60 s}
control_rate: 10
metrics: [execution]
"""


@pytest.fixture
def status(mrpbench):
    """Return the status of a run of a study on an open field."""
    for needed in ("mrpbench_planners_example", "mrpbench_assigners_greedy"):
        pytest.importorskip(needed)
    Path("other_faults.py").write_text((Path(__file__).parent / "other_faults.py").read_text())
    Path("open.map").write_text(OPEN)

    def run(study, starts):
        Path("starts.yaml").write_text(starts)
        Path("study.yaml").write_text(study)
        mrpbench("run", "study.yaml", "--out", "results")
        (record,) = load("results")
        return record["status"]

    return run


def scenario(robots, tasks, size=1.0):
    """A scenario file with robots and goals at cells of the middle row, and the releases of the tasks."""
    robots = [f"  - {{x: {size * (cell + 0.5)}, y: {size * 1.5}}}" for cell in robots]
    tasks = [
        f"  - {{release: {release}, goals: [{{x: {size * (cell + 0.5)}, y: {size * 1.5}}}]}}" for cell, release in tasks
    ]
    return "\n".join(["mrpbench_scenario: 1", "robots:", *robots, "tasks:", *tasks]) + "\n"


@pytest.mark.parametrize(
    ("planner", "goal", "expected"),
    [
        ("./other_faults.py:ForgetsParked", 16, "plan_invalid"),  # the other one comes 16 ticks later
        ("./other_faults.py:ForgetsParked", 10, "succeeded"),  # after 10 ticks it is not forgotten yet
        ("example", 16, "succeeded"),
    ],
)
def test_a_robot_that_stands_at_its_goal_is_forgotten_after_some_time(status, planner, goal, expected):
    starts = scenario([goal, 0], [(goal, 0), (19, 0)])
    assert status(PLANNED.replace("PLANNER", f'{{plugin: "{planner}"}}'), starts) == expected


@pytest.mark.parametrize(
    ("assigner", "cells", "expected"),
    [
        ("./other_faults.py:KeyedByGoal", (6, 6), "crashed"),
        ("./other_faults.py:KeyedByGoal", (6, 7), "succeeded"),
        ("greedy", (6, 6), "succeeded"),
    ],
)
def test_one_of_two_tasks_with_the_same_goal_is_lost(status, assigner, cells, expected):
    starts = scenario([0, 3], [(cell, 0) for cell in cells], 0.5)
    assert status(OVER_TIME.replace("ASSIGNER", f'{{plugin: "{assigner}"}}'), starts) == expected
