"""`mrpbench size STUDY --orders RATE`."""

import json
from pathlib import Path

import pytest

STUDY = """\
name: floor
world: {plugin: movingai, file: floor.map, cell_size: 0.5}
roadmap: grid
scenario: {plugin: random, robots: 1}
fleet: {robot: turtlebot3_burger, lidar: none}
tasks: {plugin: poisson, rate: 1, service: 10 s}
assigner: hungarian
planner: {plugin: rolling_horizon, planner: pibt}
limits: {execution: 3 min, iterations: 5}
control_rate: 1
metrics: [execution, tasks]
recording: {keep: none}
matrix: {seed: 0..2}
"""


@pytest.fixture
def floor(mrpbench):
    pytest.importorskip("mrpbench_planners_mapf")
    Path("floor.map").write_text("type octile\nheight 4\nwidth 4\nmap\n....\n....\n....\n....\n")
    Path("floor.yaml").write_text(STUDY)
    return mrpbench


def test_robots_are_added_until_the_budget_is_spent(floor):
    words = ("size", "floor.yaml", "--orders", "360/h", "--p95", "3min", "--budget", "6runs", "--json")
    code, output, errors = floor(*words)
    assert code == 1, errors
    answer = json.loads(output)
    verdicts = {fleet["robots"]: fleet["verdict"] for fleet in answer["fleets"]}
    assert list(verdicts) == [1, 2]
    assert verdicts[1] == "does not"  # an order takes 10 s and the way, and there are six a minute
    assert answer["interval"] == [2 + (verdicts[2] == "does not"), None]
    assert answer["ended"] == "the budget is spent"
    assert answer["answer"].startswith("floor: up to 2 robots no fleet is shown to serve 360/h orders within 3min: ")
    code, again, errors = floor(*words)
    assert again == output
    assert "[1/" not in errors


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--orders", "many"), "--orders many: expected a rate"),
        (("--orders", "3/h", "--p95", "soon"), "--p95 soon: expected a time"),
        (("--orders", "3/h", "tasks=closed_pool"), "tasks: the study has no orders with a rate"),
        (("--orders", "3/h", "seed=1"), "seed: a fleet is judged by two seeds or more"),
    ],
)
def test_mistakes_are_one_line(floor, words, message):
    code, _, errors = floor("size", "floor.yaml", *words)
    assert code == 2
    assert message in errors
    assert len(errors.splitlines()) == 1
