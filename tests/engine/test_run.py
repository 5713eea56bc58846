"""Whole runs in this process: every way to end, and the same result again."""

import hashlib
import re
from pathlib import Path

import numpy as np
import pytest

from mrpbench_core.api import hookimpl
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.scenario import write_scenario
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.plugins.hooks import Hooks
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

FIRST = {
    "world": "office",
    "scenario": {"plugin": "random", "robots": 3},
    "assigner": "identity",
    "planner": "example",
    "limits": {"execution": "200 s"},
}
SHORT = {"execution": "20 s"}
"""For what need not arrive."""


def execute_first(tmp_path: Path, *overrides: str, hooks: Hooks | None = None, **changes):
    """Record of the run that `FIRST` describes with some settings replaced, and the stages announced."""
    (point,) = load_study({**FIRST, **changes}, overrides).runs
    stages = []
    paths = RunPaths(recording=tmp_path / "run.zip", exports=tmp_path / "exports", picture=None)
    record = execute(point.config, point.run_id, paths, lambda stage, facts: stages.append(stage), hooks).message()
    return record, stages


def digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    """The run that `FIRST` describes: its record, the stages announced, its folder."""
    folder = tmp_path_factory.mktemp("first")
    return *execute_first(folder), folder


TIMED = """
import time

import attrs

from mrpbench_core.model.planning.plan import AnytimePoint
from mrpbench_planners_example import Example


@attrs.frozen(kw_only=True)
class Timed(Example):
    def plan(self, problem, budget):
        point = AnytimePoint(seconds=time.perf_counter(), cost=1.0)
        return attrs.evolve(super().plan(problem, budget), history=(point,))
"""


def test_recordings_hold_no_wall_times(tmp_path):
    (tmp_path / "timed.py").write_text(TIMED)
    made = [
        execute_first(tmp_path / name, planner=f"{tmp_path}/timed.py:Timed", limits=SHORT)[0] for name in ("a", "b")
    ]
    assert made[0]["timing"]["planning_history"] != made[1]["timing"]["planning_history"]
    assert digest(tmp_path / "a" / "run.zip") == digest(tmp_path / "b" / "run.zip")


WITHOUT_PLAN = """
import attrs

from mrpbench_core.api import option
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_planners_example import Example


@attrs.frozen(kw_only=True)
class WithoutPlan(Example):
    status: str = option("gave_up", help="status")
    robot: int = option(1, help="robot")

    def plan(self, problem, budget):
        return PlanResult(status=PlanStatus(self.status), statistics={"failed_robot": float(self.robot)})
"""


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({}, "the planner gave up: it last found no path for robot 1, which starts at ("),
        ({"status": "unsolvable"}, "the planner proved that there is no plan, because of robot 1, which starts at ("),
        ({"robot": 99}, "the planner ended with gave_up"),
        ({"status": "out_of_memory"}, " MiB; the option limits.memory allows the whole run 4096 MiB"),
    ],
)
def test_a_run_without_a_plan_says_where_it_fails(tmp_path, options, words):
    (tmp_path / "mine.py").write_text(WITHOUT_PLAN)
    planner = {"plugin": f"{tmp_path}/mine.py:WithoutPlan"} | options
    record, _ = execute_first(tmp_path, planner=planner, simulator="none", limits={})
    assert words in record["error"]["message"]


def test_a_run_goes_through_every_stage_and_succeeds(first):
    record, stages, folder = first
    before, after = ["scenario", "assignment"], ["execution", "export", "metrics"]
    stages = [stage for stage in stages if stage not in ("world", "roadmap")]  # which runs before may have made
    assert stages == [*before, "planning", "checking", *after]  # the limit of planning ends with the planner
    assert record["status"] == "succeeded"
    assert record["metrics"]["execution.success"] is True
    assert record["metrics"]["execution.goals_reached"] == 3
    assert record["metrics"]["execution.robot_contacts"] == 0
    assert record["timing"]["real_time_factor"] > 1
    assert (folder / "run.zip").is_file()


def test_robots_end_within_tolerance_of_their_goals(first):
    recording = Recording(first[-1] / "run.zip")
    end, goal = recording.channel("truth")[-1, :, :2], np.array(recording.context().goal)[:, :2]
    recording.close()
    assert np.hypot(*(end - goal).T).max() <= 0.11


@pytest.mark.parametrize("noise", [{}, {"lidar": 0.01, "odometry": 0.02, "start_jitter": "2 s"}])
def test_the_same_run_is_recorded_the_same(tmp_path, noise):
    digests = set()
    for name in ("one", "two"):
        record, _ = execute_first(tmp_path / name, noise=noise, recording={"scans": True}, limits=SHORT)
        digests.add((record["metrics"]["execution.min_distance_m"], digest(tmp_path / name / "run.zip")))
    assert len(digests) == 1


def test_a_repeat_meets_the_same_scenario_with_other_noise(tmp_path):
    noise = {"start_jitter": "5 s"}
    first, _ = execute_first(tmp_path / "0", noise=noise, limits=SHORT)
    again, _ = execute_first(tmp_path / "1", noise=noise, repeat=1, limits=SHORT)
    assert first["scenario_id"] == again["scenario_id"]
    assert first["metrics"]["planning.makespan"] == again["metrics"]["planning.makespan"]
    assert digest(tmp_path / "0" / "run.zip") != digest(tmp_path / "1" / "run.zip")


def test_a_randomised_planner_draws_from_the_runs_repeat_unless_its_own_seed_is_set(tmp_path):
    def costs(seed: int | None) -> list[float]:
        planned = {"simulator": "none", "roadmap": "grid", "limits": {"iterations": 0}, "metrics": ["planning"]}
        planner = {"plugin": "lacam", "seed": seed}
        scenario = {"plugin": "random", "robots": 9}
        records = [
            execute_first(tmp_path, planner=planner, scenario=scenario, repeat=repeat, **planned)[0]
            for repeat in (0, 1, 2, 0)
        ]
        assert len({record["scenario_id"] for record in records}) == 1
        return [record["metrics"]["planning.sum_of_costs"] for record in records]

    drawn, fixed = costs(None), costs(0)
    assert drawn[0] == drawn[3]
    assert len(set(drawn)) > 1
    assert len(set(fixed)) == 1


def test_without_a_simulator_the_run_ends_after_planning(tmp_path):
    record, stages = execute_first(tmp_path, simulator="none")
    assert record["status"] == "succeeded"
    assert "execution" not in stages
    assert record["metrics"]["planning.solved"] is True
    assert record["metrics"]["execution.duration_s"] is None
    assert record["unmeasured"] == {"execution": "not executed"}
    recording = Recording(tmp_path / "run.zip")
    assert recording.first_context().result.plan is not None
    assert recording.channels == {}
    recording.close()


def test_a_planner_does_not_get_problems_that_it_does_not_support(tmp_path):
    record, _ = execute_first(tmp_path, roadmap="graph")
    assert record["status"] == "skipped"
    assert record["error"]["message"] == "does not support edge_durations, footprints"


def test_an_infeasible_scenario_is_named_before_planning(tmp_path):
    places = {"plugin": "named", "starts": ["kitchen", "lounge"], "goals": ["sofa", "sofa"]}
    record, stages = execute_first(tmp_path, scenario=places)
    assert record["status"] == "scenario_infeasible"
    assert "robots 0 and 1 share the goal sofa" in record["error"]["message"]
    assert "planning" not in stages


def test_too_little_time_misses_goals(tmp_path):
    record, _ = execute_first(tmp_path, limits={"execution": "1 s"})
    assert record["status"] == "goals_missed"
    assert record["metrics"]["execution.success"] is False
    assert record["error"]["message"].startswith("not all robots arrived within 1 simulated seconds: robot_0 was under")
    assert record["unarrived"].keys() == {"robot_0", "robot_1", "robot_2"}
    assert re.fullmatch(
        r"was under way at \([\d.-]+, [\d.-]+\), with [\d.]+ m of its path left", record["unarrived"]["robot_0"]
    )


@pytest.mark.parametrize(("keep", "kept"), [("all", True), ("failed", False), ("none", False)])
def test_recordings_of_successes_are_kept_as_asked(tmp_path, keep, kept):
    record, _ = execute_first(tmp_path, "scenario.robots=1", recording={"keep": keep})
    assert record["metrics"]["execution.success"] is True
    assert (tmp_path / "run.zip").exists() is kept


def test_a_failed_run_is_kept_when_failures_are(tmp_path):
    execute_first(tmp_path, recording={"keep": "failed"}, limits={"execution": "1 s"})
    assert (tmp_path / "run.zip").exists()


def test_hooks_see_the_plan_and_every_period(tmp_path):
    seen = {"planned": 0, "stepped": [], "told": []}

    class Watching:
        @hookimpl
        def mrpbench_planned(self, problem, result):
            seen["planned"] += len(result.plan.paths) == len(problem)

        @hookimpl
        def mrpbench_executing(self, context):
            seen["told"].append(context)

        @hookimpl
        def mrpbench_stepped(self, now, state, observation, routes):
            seen["stepped"].append(now)
            np.testing.assert_array_equal(observation.estimate.pose, state.pose)
            assert routes is seen.setdefault("routes", routes), "the same object until there is a new plan"

        @hookimpl
        def mrpbench_executed(self):
            seen["told"].append("over")

    hooks = Hooks()
    hooks.register(Watching(), "watching")
    execute_first(tmp_path, hooks=hooks, limits={"execution": "2 s"})
    assert hooks.disabled == ()
    assert seen["told"][1:] == ["over"]
    assert seen["planned"] == 1
    np.testing.assert_allclose(seen["stepped"], np.arange(41) * 0.05)


@pytest.mark.parametrize("dispatcher", ["timed", "all_at_once"])
def test_other_dispatchers_drive_a_single_robot_too(tmp_path, dispatcher):
    record, _ = execute_first(tmp_path, "scenario.robots=1", dispatcher=dispatcher)
    assert record["status"] == "succeeded"


def test_a_slow_dispatch_takes_as_long_as_the_plan(tmp_path):
    record, _ = execute_first(tmp_path, "scenario.robots=1", dispatcher="timed")
    assert record["metrics"]["execution.duration_s"] > record["metrics"]["planning.makespan"] - 2.0


def test_a_robot_without_a_task_makes_way_and_does_not_hinder_planning(tmp_path):
    file = tmp_path / "two_tasks.yaml"
    scenario = load_study(FIRST).runs[0].config.scenario
    world = load_study(FIRST).runs[0].config.world.load()
    places = {vertex.name: (vertex.x, vertex.y, float("nan")) for vertex in world.vertices}
    assert scenario.size() == 3
    start = [places[name] for name in ("kitchen", "lounge", "sofa")]
    tasks = tuple(Task(goals=[places[name]]) for name in ("workshop", "archive"))
    write_scenario(file, Scenario(start=start, start_level=[0, 0, 0], tasks=tasks))
    record, _ = execute_first(
        tmp_path, scenario={"plugin": "file", "file": str(file)}, planner="cbs", assigner="hungarian"
    )
    assert record["status"] == "succeeded", record
    assert record["metrics"]["execution.success"] is True


@pytest.fixture
def choosing(tmp_path, monkeypatch):
    pytest.importorskip("mrpbench_planners_mapf")
    monkeypatch.chdir(tmp_path)
    return {"plugin": "cbs", "assign": True}


def test_a_planner_that_assigns_takes_the_assigners_place(tmp_path, choosing):
    record, stages = execute_first(tmp_path, planner=choosing)
    assert "assignment" not in stages
    assert record["status"] == "succeeded"
    assert record["metrics"]["execution.goals_reached"] == 3
    recording = Recording(tmp_path / "run.zip")
    context = recording.context()
    recording.close()
    assert sorted(context.assigned) == [0, 1, 2]
    for robot, task in enumerate(context.assigned):
        goal = context.scenario.tasks[task].goals[-1, :2]
        assert np.hypot(*(np.array(context.goal[robot][:2]) - goal)) < 0.4, "within a cell of the task's goal"
    fixed, _ = execute_first(tmp_path, planner={**choosing, "assign": False}, simulator="none", metrics=["planning"])
    assert fixed["scenario_id"] == record["scenario_id"]
    assert record["metrics"]["planning.sum_of_costs"] <= fixed["metrics"]["planning.sum_of_costs"]


def test_a_planner_that_assigns_needs_a_task_of_one_goal_for_every_robot(tmp_path, choosing):
    start, goal = np.array([[1.0, 1.0, np.nan]]), np.array([[3.0, 1.0, np.nan]])
    for tasks, said in [((np.vstack([goal, start]),), "several"), ((), "a task for every robot; 0 for 1 robots")]:
        drawn = Scenario(
            start=start,
            start_level=[0],
            tasks=tuple(Task(name="t", goals=goals, levels=[0] * len(goals)) for goals in tasks),
        )
        write_scenario(tmp_path / "drawn.json", drawn)
        with pytest.raises(InputError, match=said):
            execute_first(tmp_path, planner=choosing, scenario={"plugin": "file", "file": "drawn.json"})
