"""`mrpbench saturate STUDY`."""

import json
from pathlib import Path

import pytest
from mrpbench_search.commands.saturate import Search

STUDY = """\
name: shuttle
world: {plugin: movingai, file: two.map, resolution: 0.5}
roadmap: grid
scenario: {plugin: random, robots: 1}
fleet: {robot: turtlebot3_burger, lidar: none}
tasks: {plugin: trace, file: even.txt, errands: 1, service: 2 s}
assigner: identity
planner: {plugin: rolling_horizon, planner: pibt}
limits: {execution: 150 s, iterations: 5}
control_rate: 1
metrics: [tasks]
matrix: {seed: 0..2}
"""


@pytest.fixture
def shuttle(mrpbench):
    """Return the command in a folder with a study of one robot between two places, one task in 3 s for scale 1."""
    pytest.importorskip("mrpbench_planners_mapf")
    Path("two.map").write_text("type octile\nheight 1\nwidth 2\nmap\n..\n")
    Path("even.txt").write_text("".join(f"{3 * i}\n" for i in range(100)))
    Path("shuttle.yaml").write_text(STUDY)
    return mrpbench


def test_the_interval_holds_the_rate_of_a_robot_that_is_always_busy(shuttle):
    words = ("saturate", "shuttle.yaml", "tasks.scale=4", "--resolution", "1", "--json")
    code, output, errors = shuttle(*words)
    assert code == 0, errors
    (found,) = json.loads(output)["combinations"]
    low, high = found["interval"]
    records = [
        json.loads(line)
        for file in Path("results/shuttle-saturate/runs").iterdir()
        for line in file.read_text().splitlines()
    ]
    assert len(records) == 3 * len(found["tried"])
    assert all(rate["failed"] == 0 for rate in found["tried"])
    assert "trying 0.25 1/scale: shuttle\n" in errors
    assert "shuttle: growth " in errors
    busy = [record for record in records if record["config"]["tasks"]["scale"] == 1 / high]
    capacity = sum(record["metrics"]["tasks.per_hour"] for record in busy) / len(busy) / 1200
    assert capacity < 3 / 2  # an errand takes 2 s, without driving
    assert low < capacity / 0.95 < high
    code, again, errors = shuttle(*words)
    assert (code, again) == (0, output)
    assert "[1/" not in errors  # nothing is done twice


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("tasks=none",), "no task source"),
        (("tasks=closed_pool",), "'closed_pool' has no rate"),
        (("seed=3",), "two seeds or more"),
        (("--resolution", "0"), "--resolution 0: from 0.01"),
    ],
)
def test_mistakes_are_one_line(shuttle, words, message):
    code, _, errors = shuttle("saturate", "shuttle.yaml", *words)
    assert code == 2
    assert message in errors
    assert len(errors.splitlines()) == 1


CHARGING = """\
{plugin: charging, tasks: {plugin: poisson, rate: 30, service: 5 s}, energy: {chargers: ['*'],
 battery: {capacity: 0.5, voltage: 10, ambient: 100, charging_current: 20}}}"""


def test_the_tasks_of_robots_with_batteries_have_a_rate(shuttle):
    words = (
        "world=office",
        "roadmap=graph",
        f"tasks={CHARGING}",
        "seed=0..1",
        "--resolution",
        "1",
        "--budget",
        "2runs",
    )
    code, output, errors = shuttle("saturate", "shuttle.yaml", *words, "--json")
    assert code == 1, errors
    (found,) = json.loads(output)["combinations"]
    assert [each["rate"] for each in found["tried"]] == [30]
    assert found["tried"][0]["mean"] > 0.5  # two errands take more than the 2 s between tasks


def test_runs_that_did_not_succeed_are_counted():
    search = Search("all", 8.0)
    ends = enumerate(["succeeded", "execution_aborted"])
    metrics = {"tasks.open_growth": 0.0}
    search.judge(8.0, [{"run_id": "a", "seed": seed, "status": status, "metrics": metrics} for seed, status in ends])
    assert search.row(8.0) == ["8", "0.000", "0.000", "0.000", "bounded", "1 failed"]
