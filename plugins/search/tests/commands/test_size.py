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
limits: {execution: 4 min, iterations: 5}
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


def test_robots_are_added_until_the_orders_are_served(floor):
    words = ("size", "floor.yaml", "--orders", "240/h", "--p95", "3min", "--budget", "9runs", "--json")
    code, output, errors = floor(*words)
    answer = json.loads(output)
    low, high = answer["interval"]
    verdicts = {fleet["robots"]: fleet["verdict"] for fleet in answer["fleets"]}
    assert verdicts[1] == "does not"  # an order takes 10 s and the way, and there are four a minute
    assert low > 1
    assert verdicts[high] == "serves", errors
    assert answer["answer"].startswith(f"floor: {high} robots serve 240/h orders within 3min (p95 ")
    assert code == int(low != high)
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
