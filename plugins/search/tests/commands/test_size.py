"""`mrpbench size STUDY --orders RATE`."""

import json
from pathlib import Path

import pytest

STUDY = """\
name: floor
world: {plugin: movingai, file: floor.map, resolution: 0.5}
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
    words = ("size", "floor.yaml", "--orders", "1200/h", "--p95", "1min", "--budget", "6runs", "--json")
    code, output, errors = floor(*words)
    assert code == 1, errors
    answer = json.loads(output)
    verdicts = {fleet["robots"]: fleet["verdict"] for fleet in answer["fleets"]}
    assert list(verdicts) == [1, 2]
    assert verdicts[1] == "does not"  # an order takes 10 s and the way, and there are twenty a minute
    assert answer["interval"] == [2 + (verdicts[2] == "does not"), None]
    assert answer["ended"] == "the budget is spent"
    assert answer["answer"].startswith("floor: up to 2 robots no fleet is shown to serve 1200/h orders within 1min: ")
    code, again, errors = floor(*words)
    assert again == output
    assert "[1/" not in errors


def test_a_budget_without_a_run_prints_no_empty_table(floor):
    code, output, _ = floor("size", "floor.yaml", "--orders", "60/h", "--budget", "1runs")
    assert code == 1
    assert (
        "floor: nothing is shown\n0 runs in results/floor-size; the search ended before: the budget is spent" in output
    )


ENERGY = "{chargers: ['*'], battery: {capacity: 0.5, voltage: 10, ambient: 100, charging_current: 20}}"
"""Empty within three minutes; full again in a minute and a half."""
SHIFT = STUDY.replace("world: {plugin: movingai, file: floor.map, resolution: 0.5}", "world: office").replace(
    "roadmap: grid", "roadmap: graph"
)
SHIFT = SHIFT.replace(
    "{plugin: poisson, rate: 1, service: 10 s}", "{plugin: charging, tasks: {plugin: poisson, rate: 1}, energy: ENERGY}"
)
SHIFT = SHIFT.replace("[execution, tasks]", "[execution, tasks, {plugin: energy, energy: ENERGY}]").replace(
    "0..2", "0..1"
)


def test_robots_with_batteries_are_measured_and_priced(floor):
    Path("shift.yaml").write_text(SHIFT.replace("ENERGY", ENERGY))
    Path("prices.yaml").write_text("{currency: EUR, robot: 1000, charger: 500, service_hours: 1000, kwh: 0.5}")
    words = ("--orders", "60/h", "--prices", "prices.yaml", "--budget", "2runs", "--json")
    code, output, errors = floor("size", "shift.yaml", *words)
    assert code == 1, errors
    (fleet,) = json.loads(output)["fleets"]
    assert fleet["energy_wh"] > 90, "a robot takes at least 100 W, of which a charger gives some"
    assert fleet["cost_per_hour"] == pytest.approx(1 + fleet["chargers"] / 2 + fleet["energy_wh"] / 2000)
    assert Path("results/floor-size/size.html").is_file()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("metrics=[execution, tasks]",), "robots have batteries, so add the metric `energy`"),
        (("metrics=[execution, tasks, energy]",), "the metric `energy` has other batteries or chargers than `tasks`"),
    ],
)
def test_batteries_need_a_metric_that_knows_them(floor, words, message):
    Path("shift.yaml").write_text(SHIFT.replace("ENERGY", ENERGY))
    code, _, errors = floor("size", "shift.yaml", "--orders", "60/h", *words)
    assert code == 2
    assert message in errors


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
