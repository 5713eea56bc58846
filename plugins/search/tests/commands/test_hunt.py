"""`mrpbench hunt STUDY --for FAILURE`."""

import json
from contextlib import closing
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
"""A hall with one junction of three ways."""
STUDY = """\
name: hall
world: {plugin: movingai, file: hall.map}
roadmap: grid
scenario: {plugin: random, robots: 4}
assigner: identity
planner: {plugin: "./faulty.py:SwapsAtJunctions"}
simulator: none
metrics: [planning]
"""
RANDOM = 364
"""Random seeds that it takes to find the fault, in the mean: 11 of the seeds 0 to 3999 do. 10 searches take 19 in the
mean; `make hunts` counts them."""


@pytest.fixture
def hall(mrpbench):
    for needed in ("planners_example", "controllers_pure_pursuit", "assigners_greedy"):
        pytest.importorskip(f"mrpbench_{needed}")
    for name in ("faulty.py", "other_faults.py"):
        Path(name).write_text((Path(__file__).parents[1] / "hunting" / name).read_text())
    Path("hall.map").write_text(f"type octile\nheight 9\nwidth 12\nmap\n{HALL}")
    Path("hall.yaml").write_text(STUDY)
    return mrpbench


def test_a_fault_at_one_junction_is_found_shrunk_and_repeated(hall):
    words = ("hunt", "hall.yaml", "--for", "invalid", "--most", "1", "--seed", "6", "--budget", "60runs", "--json")
    code, output, errors = hall(*words)
    assert code == 1, errors
    answer = json.loads(output)
    (failure,) = answer["failures"]
    assert failure["found_after"] <= RANDOM / 5
    assert failure["robots"] <= 3
    assert failure["smallest"]
    assert (failure["again"], failure["repeats"]) == (20, 20)
    assert "swap conflict of robots" in failure["reason"]
    assert answer["answer"] == f"hall: 1 failure in {answer['cases']} cases: invalid with {failure['robots']} robots"
    assert answer["runs"] == len(load("results/hall-hunt"))
    code, again, errors = hall(*words)
    assert (code, again) == (1, output)
    assert "[1/" not in errors
    assert hall("run", failure["files"]["study"], "--out", "again")[0] == 0
    (record,) = load("again")
    assert record["status"] == "plan_invalid"
    assert record["error"]["message"].partition(" (")[0] == failure["reason"].partition(" (")[0]


def test_the_robots_of_the_smallest_case_drive_as_in_the_case_that_was_found(hall):
    def ways(run_id):
        with closing(runs.recording(run_id)) as recording:
            problem = recording.instance().problem
        return set(zip(problem.start.tolist(), problem.goals, strict=True))

    words = ("planner=example", "assigner=hungarian", "--for", "planning.makespan > 0", "--most", "1", "--json")
    code, output, errors = hall("hunt", "hall.yaml", *words)
    assert code == 1, errors
    (failure,) = json.loads(output)["failures"]
    assert (failure["robots"], failure["found_after"]) == (1, 1)
    runs = load("results/hall-hunt")
    assert ways(failure["runs"][0]) <= ways(next(iter(runs))["run_id"])


@pytest.mark.parametrize(
    "chosen",
    [
        ("planner=example", "dispatcher=./faulty.py:ReleasesEarly"),
        ("planner=example", "controller=./faulty.py:BlindLeft"),
        ("planner=./other_faults.py:ForgetsParked",),
        ("planner=example", "dispatcher=./other_faults.py:LosesWakeUp"),
    ],
)
def test_the_faults_that_make_hunts_searches_for_are_rare(hall, chosen):
    words = ("simulator=kinematic", "control_rate=5", "limits.execution=90 s", "seed=0")
    world = "world={plugin: movingai, file: hall.map, resolution: 1}"
    assert hall("run", "hall.yaml", *words, world, "scenario.robots=2", "metrics=[execution]", *chosen)[0] == 0
    (record,) = load("results/hall")
    assert record["status"] == "succeeded"
    assert record["metrics"]["execution.robot_contacts"] == 0


def test_a_budget_ends_a_hunt_that_finds_nothing(hall):
    code, output, _ = hall("hunt", "hall.yaml", "planner=example", "--budget", "8runs", "--for", "invalid")
    assert code == 0
    assert "hall: nothing breaks `invalid` in 8 cases" in output
    assert "the budget is spent" in output


def test_a_budget_that_ends_before_shrinking_does_is_named(hall):
    words = ("hunt", "hall.yaml", "planner=example", "--for", "planning.makespan > 0", "--most", "1")
    code, output, errors = hall(*words, "--budget", "4runs")
    assert code == 1, errors
    assert "makespan > 0 after 1 case: " in output
    assert "smallest case so far: 4 robots: " in output
    assert "shrinking has not ended: the same command with a higher --budget continues" in output
    assert "shrinking" not in hall(*words)[1]


def test_a_hunt_goes_on_where_no_task_is_released_with_the_first_seed(hall):
    world = "world={plugin: movingai, file: hall.map, resolution: 1}"
    words = (world, "planner={plugin: rolling_horizon, planner: pibt}", "simulator=kinematic", "control_rate=5")
    tasks = ("tasks={plugin: poisson, rate: 0.5}", "limits.execution=10 s", "scenario.robots=2", "assigner=hungarian")
    code, output, errors = hall("hunt", "hall.yaml", *words, *tasks, "--budget", "4runs", "--for", "crash", "--json")
    assert code == 0, errors
    assert json.loads(output)["cases"] == 4


def test_cases_that_a_component_refuses_are_no_cases_in_which_nothing_breaks(hall):
    Path("passing.yaml").write_text("""\
name: passing
world: warehouse
roadmap: graph
scenario: {plugin: named, starts: [dock_1, dock_2], goals: [bay_1, bay_2]}
tasks: {plugin: pickup_delivery, rate: 4, pickups: [dock_*], dropoffs: [pick_station_*]}
assigner: token_passing
planner: {plugin: rolling_horizon, planner: token_passing}
replanning: {parking: home}
limits: {execution: 30 s, iterations: 5}
""")
    code, output, errors = hall("hunt", "passing.yaml", "--budget", "4runs")
    assert code == 0, errors
    assert "passing: nothing breaks `failure` in 0 cases" in output
    assert "4 further cases left out, e.g. run " in output
    assert ": needs well-formed tasks: robot " in output


def test_the_smallest_case_of_two_candidates_is_a_study_of_both(hall):
    words = ("planner=[cbs, example]", "--for", "example worse than cbs by 0.1 %", "--metric", "planning.sum_of_costs")
    code, output, errors = hall("hunt", "hall.yaml", *words, "--most", "1", "--budget", "200runs", "--json")
    assert code == 1, errors
    (failure,) = json.loads(output)["failures"]
    code, _, errors = hall("run", failure["files"]["study"], "--out", "again")
    assert code == 0, errors
    costs = {
        record["config"]["planner"]["plugin"]: record["metrics"]["planning.sum_of_costs"] for record in load("again")
    }
    assert costs["example"] > 1.001 * costs["cbs"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--for", "boredom"), "--for boredom: not a failure that can be searched for"),
        (("planner=[example, cbs]",), "the study has 2 candidates"),
        (("--for", "cbs worse than example by 20 %"), "the study has no candidate 'cbs'"),
        (("--most", "0"), "--most 0: at least 1"),
        (("tasks=closed_pool", "simulator=kinematic"), "releases tasks when others are done"),
        (("tasks={plugin: poisson, rate: 0.0001}", "simulator=kinematic"), "tasks: none is released"),
    ],
)
def test_mistakes_are_one_line(hall, words, message):
    code, _, errors = hall("hunt", "hall.yaml", *words)
    assert code == 2
    assert message in errors
    assert len(errors.splitlines()) == 1
