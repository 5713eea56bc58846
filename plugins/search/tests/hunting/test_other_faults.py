"""The planted faults: each shows in the situation that it is about, where the honest component does well."""

from pathlib import Path

import pytest

from mrpbench_core.store.results import load

HALL = """\
@@@@@@.@@@@@
@@@@@@.@@@@@
@@@@@@.@@@@@
............
....@.......
............
.@........@.
......@.....
............
"""
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
DISPATCHED = """\
name: dispatched
world: {plugin: movingai, file: hall.map, resolution: 0.5}
roadmap: grid
scenario: {plugin: file, file: starts.yaml}
fleet: {robot: turtlebot3_burger, lidar: none}
assigner: identity
planner: example
dispatcher: DISPATCHER
limits: {execution: 60 s}
control_rate: 10
metrics: [execution]
"""
QUEUE = """\
mrpbench_scenario: 1
robots:
  - {x: 2.75, y: 2.25}
  - {x: 3.25, y: 2.75}
  - {x: 4.25, y: 2.25}
  - {x: 3.75, y: 2.75}
  - {x: 3.75, y: 2.25}
tasks:
  - {goals: [{x: 3.75, y: 2.75}]}
  - {goals: [{x: 1.25, y: 1.75}]}
  - {goals: [{x: 2.25, y: 2.75}]}
  - {goals: [{x: 1.75, y: 0.25}]}
  - {goals: [{x: 1.25, y: 2.25}]}
"""
"""A case that a hunt found: robots of the hall stand waiting in a row."""
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
    Path("hall.map").write_text(f"type octile\nheight 9\nwidth 12\nmap\n{HALL}")

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
    ("dispatcher", "expected"), [("./other_faults.py:LosesWakeUp", "goals_missed"), ("adg", "succeeded")]
)
def test_the_last_one_of_four_robots_that_wait_in_a_row_is_lost(status, dispatcher, expected):
    assert status(DISPATCHED.replace("DISPATCHER", f'{{plugin: "{dispatcher}"}}'), QUEUE) == expected


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
