"""No component is better off for changing what it is judged by, and no honest run changes because another cheats."""

import shutil

import pytest

from mrpbench_core import load
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.engine.study.options import StudyOptions
from mrpbench_core.engine.study.reading import read_study
from mrpbench_core.engine.study.study import run_study
from mrpbench_core.report.reading.runs import read_runs
from tests.referee import cheating_drivers, cheating_planners

MAP = "type octile\nheight 5\nwidth 6\nmap\n......\n.@@@@.\n......\n.@..@.\n......\n"
STUDY = {
    "name": "cheats",
    "roadmap": "grid",
    "assigner": "identity",
    "seed": 3,
    "planner": "prioritized",
    "limits": {"planning": "5 s", "execution": "20 s", "wall": "60 s"},
}
PLANNED = {"robots": 6, "simulator": "none", "metrics": ["planning"]}
FAILED = {
    "plan_invalid",
    "plan_not_found",
    "contract_broken",
    "crashed",
    "execution_aborted",
    "goals_missed",
}
LOWER = {f"execution.{name}" for name in ("time_blocked_s", "time_blocked_max_s", "distance_m")}
"""Columns that get worse for robots that are said to have reached what is ahead of them."""
COUNTED = ("expansions", "generated", "low_level_expansions")
"""Columns that planners count, as tables say."""


def does(cls, names):
    """Blocks of a plugin, one for each thing to do."""
    file = "cheating_planners.py" if cls == "Cheat" else "cheating_drivers.py"
    names = names if isinstance(names, list) else [name for name in vars(names) if not name.startswith("_")]
    return [{"plugin": f"./{file}:{cls}", "does": name} for name in names]


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Return a function that does a study in worker processes, which all studies share."""
    folder = tmp_path_factory.mktemp("cheats")
    for module in (cheating_planners, cheating_drivers):
        shutil.copy(module.__file__, folder)
    (folder / "small.map").write_text(MAP)
    with pytest.MonkeyPatch.context() as patch, slots_of_this_process() as slots:
        patch.chdir(folder)

        def do(name, **settings):
            cell = 1.0 if settings.get("simulator") == "none" else 0.5
            robots = settings.pop("robots", 3)
            world = {"plugin": "movingai", "file": "small.map", "resolution": cell}
            scenario = {"plugin": "random", "robots": robots}
            study = read_study({**STUDY, "world": world, "scenario": scenario, **settings})
            assert not study.errors
            run_study(study, StudyOptions(out=folder / name), slots)
            return list(load(folder / name))

        yield do


def gains(cheat, honest):
    """What is better for the cheat, or differs, if it did not fail."""
    if cheat["status"] in FAILED:
        return []
    columns = {key: value for key, value in cheat["metrics"].items() if key.rpartition(".")[2] not in COUNTED}
    found = [key for key, value in columns.items() if value != honest["metrics"][key]]
    found += [key for key in ("status", "plan") if cheat.get(key) != honest.get(key)]
    return found + [key for key in cheat["metrics"] if key not in honest["metrics"]]


def by_name(records, key):
    return {record["config"][key].get("does", record["config"][key]["plugin"]): record for record in records}


@pytest.fixture(scope="module")
def planned(results):
    """The records of a study of planners: those that cheat among honest ones."""
    honest = [*does("Cheat", ["nothing"]), "prioritized", "cbs"]
    planners = [*honest[:1], *does("Cheat", cheating_planners.Planning), *honest[1:]]
    return by_name(results("planned", **PLANNED, matrix={"planner": planners}), "planner")


def test_planners_that_change_what_they_are_judged_by_gain_nothing(planned):
    found = {name: gains(record, planned["nothing"]) for name, record in planned.items()}
    assert {name for name, gained in found.items() if gained} == {"bound_too_high", "cbs"}
    slow = planned["slow_clock"]["timing"]
    assert 0.7 < slow["planning_s"] < slow["run_wall_s"]


def test_a_bound_that_another_plan_refutes_makes_a_run_a_failure_in_reports_and_harms_no_other(planned, results):
    runs = read_runs([load("planned")])
    statuses = dict(zip(runs.run_id, runs.status, strict=True))
    refuted = {name for name, record in planned.items() if statuses[record["run_id"]] != record["status"]}
    assert refuted == {"bound_too_high"}
    assert statuses[planned["bound_too_high"]["run_id"]] == "promise_broken"


def test_honest_planners_are_judged_as_without_cheats(planned, results):
    alone = by_name(results("alone", **PLANNED, matrix={"planner": ["prioritized", "cbs"]}), "planner")
    for name, record in alone.items():
        assert all(record[key] == planned[name][key] for key in ("run_id", "status", "metrics", "plan"))
    same = {key: planned["nothing"][key] for key in ("status", "metrics", "plan")}
    assert same == {key: planned["prioritized"][key] for key in same}


DRIVEN = {
    "simulator": [*does("CheatingSimulator", ["nothing"]), *does("CheatingSimulator", cheating_drivers.Simulating)],
    "navigator": ["waypoints", *does("CheatingNavigator", cheating_drivers.Navigating)],
    "localizer": ["ground_truth", *does("CheatingLocalizer", ["odometry", "covers_ears", "patches_truth"])],
    "dispatcher": ["all_at_once", *does("CheatingDispatcher", ["goals", "plan"])],
    "controller": ["pure_pursuit", *does("CheatingController", ["limits", "walls"])],
    "assigner": ["identity", "./cheating_drivers.py:CheatingAssigner"],
}
"""Blocks of each kind, the honest one first."""


@pytest.mark.parametrize("kind", DRIVEN)
def test_components_of_an_execution_that_cheat_gain_nothing(results, kind):
    settings = {"simulator": "kinematic", "metrics": ["planning", "execution"], "matrix": {kind: DRIVEN[kind]}}
    honest, *cheats = results(kind, **settings)
    assert honest["status"] == "succeeded"
    assert len(cheats) == len(DRIVEN[kind]) - 1
    for cheat in cheats:
        differ = set(gains(cheat, honest))
        assert differ <= LOWER, cheat["config"][kind]
        assert all(cheat["metrics"][key] > honest["metrics"][key] for key in differ)


def test_robots_that_pass_through_one_another_are_found(results):
    ways = does("CheatingSimulator", ["nothing"]) + does("CheatingSimulator", cheating_drivers.Ghosts)
    settings = {"planner": "./cheating_planners.py:Careless", "dispatcher": "all_at_once", "metrics": ["execution"]}
    honest, *ghosts = results("ghosts", robots=6, **settings, matrix={"simulator": ways})
    assert honest["metrics"]["execution.robot_contacts"] > 0
    for ghost in ghosts:
        assert ghost["status"] == "contract_broken"
        assert "overlap" in ghost["error"]["message"]
        assert "CheatingSimulator" in ghost["error"]["message"]


def test_robots_that_jerk_are_named(results):
    (jerks,) = results("jerks", simulator=does("CheatingSimulator", ["jerks"])[0], metrics=[])
    assert jerks["status"] == "contract_broken"
    assert "speeds up or slows down at 0.9 s faster than its limits allow" in jerks["error"]["message"]


def test_tasks_that_were_not_done_or_are_not_those_of_their_source_are_named(results):
    settings = {
        "simulator": "kinematic",
        "tasks": {"plugin": "poisson", "rate": 20},
        "assigner": "greedy",
        "planner": {"plugin": "rolling_horizon", "planner": "pibt"},
        "metrics": ["tasks"],
    }
    cheats = does("CheatingNavigator", ["claims_tasks", "withholds_tasks", "nearer_tasks"])
    honest, claims, withholds, nearer = results("tasks", **settings, matrix={"navigator": ["waypoints", *cheats]})
    assert honest["metrics"]["tasks.done"] > 0
    for cheat in (claims, withholds, nearer):
        assert cheat["status"] == "contract_broken"
        assert "the recorded tasks are impossible: " in cheat["error"]["message"]
    assert "from its place" in claims["error"]["message"]
    assert "was to be released before" in withholds["error"]["message"]
    assert "is not as its source releases it" in nearer["error"]["message"]


def test_crowds_and_formats_and_metrics_that_cheat_gain_nothing(results):
    common = {"simulator": "kinematic", "metrics": ["planning", "execution"]}
    (honest,) = results("honest", **common)
    (formats,) = results("formats", **common, export=["./cheating_drivers.py:CheatingFormat"])
    assert not gains(formats, honest)
    crowds = [[block] for block in does("CheatingCrowd", ["nothing", "patches"])]
    people, patched = results("crowds", **common, matrix={"crowds": crowds})
    assert not gains(patched, people)
    metrics = ["./cheating_drivers.py:CheatingMetric", "./cheating_drivers.py:ForgingMetric", *common["metrics"]]
    (measured,) = results("metrics", **{**common, "metrics": metrics})
    own = {key: measured["metrics"].pop(key) for key in ("CheatingMetric.own", "ForgingMetric.own")}
    assert own == {"CheatingMetric.own": 1.0, "ForgingMetric.own": None}
    assert measured["metrics"] == honest["metrics"]
    assert measured["unmeasured"] == {"ForgingMetric": "its process answered something other than numbers"}
