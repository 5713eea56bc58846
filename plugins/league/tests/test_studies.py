"""Discrete executions as runs of studies."""

import json

import numpy as np
import pytest
from mrpbench_league.files.output import read_output
from mrpbench_league.files.problem import read_problem
from mrpbench_league.planner import StepPlanner
from mrpbench_league.scoring.rescore import rescore
from mrpbench_league.simulator import League

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording
from mrpbench_core.testing import DiscreteSimulatorConformance
from mrpbench_core.testing.suites.planner import PlannerConformance

MAP = "type octile\nheight 6\nwidth 8\nmap\n........\n.@@..@@.\n........\n........\n.@@..@@.\n........\n"
TASKS = ("40,7", "0,47,20", "23", "25,5", "44,16,2")


class TestSteps(DiscreteSimulatorConformance):
    def make(self):
        return League()


class TestTicks(DiscreteSimulatorConformance):
    def make(self):
        return League(season=2026, counter=4, size=0.8, period=5)


class TestStepPlanner(PlannerConformance):
    def make(self):
        return StepPlanner()


def problem(folder, version="2024 LoRR", **others):
    (folder / "small.map").write_text(MAP)
    (folder / "small.agents").write_text("5\n0\n7\n40\n47\n19\n")
    (folder / "small.tasks").write_text("\n".join((str(len(TASKS)), *TASKS)) + "\n")
    files = {"mapFile": "small.map", "agentFile": "small.agents", "taskFile": "small.tasks"}
    fields = {"version": version, "teamSize": 5, "numTasksReveal": 1.5, **files, **others}
    file = folder / "problem.json"
    file.write_text(json.dumps(fields))
    return str(file)


def study(folder, **changes):
    return {
        "name": "league",
        "world": {"plugin": "movingai", "file": str(folder / "small.map")},
        "roadmap": "grid",
        "scenario": {"plugin": "lorr", "file": str(folder / "problem.json")},
        "tasks": {"plugin": "lorr", "file": str(folder / "problem.json")},
        "fleet": {"robot": "turtlebot3_burger", "lidar": "none"},
        "planner": "league",
        "simulator": "league",
        "limits": {"execution": 150, "iterations": 10},
        "metrics": ["execution", "tasks"],
        **changes,
    }


def run(folder, **changes):
    (point,) = load_study(study(folder, **changes), []).runs
    paths = RunPaths(recording=folder / "run.zip", exports=folder / "exports", picture=None)
    return execute(point.config, point.run_id, paths, lambda stage, facts: None).message(), paths


@pytest.mark.parametrize("season", [2024, 2026])
def test_the_output_of_a_run_keeps_the_rules_and_agrees_with_its_record(tmp_path, season):
    delays = {"minDelay": 2, "maxDelay": 6, "eventModel": "bernoulli", "pDelay": 0.01, "durationModel": "uniform"}
    others = {"agentCounter": 3, "delayConfig": delays} if season == 2026 else {}
    file = problem(tmp_path, f"{season} LoRR", **others)
    simulator = {"plugin": "league", "rules": file, "step": "1 s"}
    record, paths = run(tmp_path, simulator=simulator)
    assert record["status"] == "succeeded", record
    score = rescore(read_problem(tmp_path / "problem.json"), read_output(paths.exports / "output.json"))
    assert score.faults.kept == []
    assert record["metrics"]["tasks.done"] == score.tasks > 5
    assert record["metrics"]["tasks.open_end"] == 7
    assert record["timing"]["replanning_overruns"] == 0
    assert 0 < record["timing"]["preprocessing_s"] < record["timing"]["execution_wall_s"]


def test_robots_are_recorded_where_the_output_has_them(tmp_path):
    problem(tmp_path)
    _, paths = run(tmp_path, recording={"rate": 0.5})
    motion = read_output(paths.exports / "output.json").motion[0].letters.tobytes().decode()
    recording = Recording(paths.recording)
    time, truth = (recording.channels[name]() for name in ("time", "truth"))
    recording.close()
    assert time.tolist() == list(range(0, 151, 2))
    row, column, heading, poses = 0, 0, 0, [(0.5, 5.5, 0)]
    for letter in motion:
        heading = (heading + {"R": 1, "C": -1}.get(letter, 0)) % 4
        if letter == "F":
            row, column = row + (0, 1, 0, -1)[heading], column + (1, 0, -1, 0)[heading]
        poses.append((column + 0.5, 5.5 - row, heading))
    turned = (-truth[:, 0, 2] / (np.pi / 2)).round() % 4
    assert np.array_equal(np.column_stack([truth[:, 0, :2], turned]), poses[::2])


def test_all_planners_of_a_study_meet_the_same_tasks(tmp_path):
    problem(tmp_path)
    tasks = {"plugin": "closed_pool", "errands": 2}
    goals = []
    for method in ("pibt", "epibt"):
        record, paths = run(tmp_path, tasks=tasks, planner={"plugin": "league", "method": method})
        recording = Recording(paths.recording)
        goals.append((record["scenario_id"], recording.channels["errand_goal"]()[:12].tobytes()))
        recording.close()
    assert goals[0] == goals[1]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"world": "office"}, "is not the map of the problem"),
        ({"world": "office", "scenario": {"plugin": "random", "robots": 2}, "tasks": "closed_pool"}, "needs a raster"),
        ({"tasks": {"plugin": "poisson", "rate": 1}}, "needs tasks from the start on"),
        ({"tasks": {"plugin": "closed_pool", "total": 9}}, "needs a pool without end"),
        ({"tasks": {"plugin": "closed_pool", "service": 1}}, "take no service time"),
        ({"tasks": {"plugin": "closed_pool", "places_per_errand": 2}}, "have one place each"),
        ({"tasks": "none"}, "needs a task source"),
        ({"delays": {"p_delay": 0.1}}, "means nothing with league, which counts steps"),
        ({"limits": {"execution": 0.5}}, "are 0 steps of 1 s"),
        ({"scenario": {"plugin": "lorr", "file": "problem.json", "robots": 6}}, "has 5 robots, not 6"),
    ],
)
def test_what_does_not_fit_is_said_in_one_line(tmp_path, monkeypatch, changes, message):
    monkeypatch.chdir(tmp_path)
    problem(tmp_path)
    with pytest.raises((InputError, InputErrors), match=message):
        run(tmp_path, **changes)


def test_a_planner_of_whole_runs_is_skipped(tmp_path):
    problem(tmp_path)
    record, _ = run(tmp_path, planner={"plugin": "rolling_horizon", "planner": "prioritized"})
    assert record["status"] == "skipped"
    assert record["error"]["message"] == "`simulator: league` executes `planner: league` alone"


def test_problems_of_2023_are_refused(tmp_path):
    (tmp_path / "single.tasks").write_text("2\n3\n5\n")
    problem(tmp_path, "2023 LoRR", taskFile="single.tasks", numTasksReveal=1)
    with pytest.raises(InputError, match=r"problem.json: is of 2023"):
        run(tmp_path)
