"""Whole runs with tasks that keep coming."""

from collections import Counter

import numpy as np
import pytest

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

pytest.importorskip("mrpbench_planners_mapf")
BASE = {
    "world": "office",
    "roadmap": "graph",
    "scenario": {"plugin": "random", "robots": 3},
    "tasks": {"plugin": "poisson", "rate": 12, "service": 1},
    "assigner": "identity",
    "planner": {"plugin": "rolling_horizon", "planner": "pbs"},
    "fleet": {"robot": "turtlebot3_burger", "lidar": "none"},
    "control_rate": 5,
    "limits": {"execution": 100, "iterations": 5},
    "metrics": ["planning"],
}
PLANNERS = '''
import attrs
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.api import PlannerSession
from mrpbench_planners_mapf.prioritized import Prioritized


@attrs.frozen(kw_only=True)
class Moody(Prioritized):
    """Finds no plan in every other call."""

    def start(self):
        return Session(self)


@attrs.frozen(kw_only=True)
class Hopeless(Prioritized):
    """Finds no plan."""

    def plan(self, problem, budget):
        return PlanResult(status=PlanStatus.GAVE_UP)


class Session(PlannerSession):
    def __init__(self, planner):
        self.planner, self.calls = planner, 0

    def plan(self, problem, budget):
        self.calls += 1
        if self.calls % 2:
            return PlanResult(status=PlanStatus.GAVE_UP)
        return self.planner.plan(problem, budget)
'''


def run(folder, **changes):
    """The record, the channels of the recording, and as one more the seconds of a tick."""
    (point,) = load_study({**BASE, **changes}, []).runs
    paths = RunPaths(recording=folder / "run.zip", exports=folder / "exports", picture=None)
    record = execute(point.config, point.run_id, paths, lambda stage, facts: None).message()
    if record["status"] == "skipped":
        return record, {}
    recording = Recording(paths.recording)
    channels = {name: load() for name, load in recording.channels.items()}
    channels["tick"] = np.array(recording.first_context().problem.roadmap.tick)
    recording.close()
    return record, channels


def happened(channels, kind):
    """Times, tasks and robots of one kind of events."""
    rows = channels["task_event"] == kind
    return list(zip(*(channels[f"task_{name}"][rows].tolist() for name in ("time", "index", "robot")), strict=True))


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    return run(tmp_path_factory.mktemp("first"))


def test_planned_times_do_not_run_ahead_of_the_clock(first):
    _, channels = first
    time, robot = channels["route_time"], channels["route_robot"]
    begins = np.flatnonzero(np.append(True, (np.diff(time) > 0) | (np.diff(robot) != 0)))
    reached = begins[time[begins] > 0]  # of each new route, the waypoint at which the robot has been last
    assert len(reached) > 20
    assert (channels["route_leave"][reached] * channels["tick"] <= time[reached] + 1e-6).all()


def test_tasks_are_done_where_they_are_and_after_their_service(first):
    record, channels = first
    assert record["status"] == "succeeded", record
    done = happened(channels, "done")
    assert len(done) >= 2
    begun = {task: (time, robot) for time, task, robot in happened(channels, "begun")}
    for time, task, robot in done:
        assert begun[task][1] == robot
        assert time >= begun[task][0] + 1.0 - 1e-9
        goal = channels["errand_goal"][channels["errand_task"] == task][-1]
        sample = int(np.searchsorted(channels["time"], time)) - 1
        assert np.hypot(*(channels["truth"][sample, robot, :2] - goal[:2])) <= 0.75


def test_another_planner_meets_the_same_tasks_at_the_same_times(first, tmp_path):
    record, channels = run(tmp_path, planner={"plugin": "rolling_horizon", "planner": "pibt"})
    assert record["scenario_id"] == first[0]["scenario_id"]
    for name in ("errand_time", "errand_task", "errand_goal"):
        assert np.array_equal(channels[name], first[1][name], equal_nan=True)
    other, _ = run(tmp_path, tasks={"plugin": "poisson", "rate": 6}, limits={"execution": 1})
    assert other["scenario_id"] != record["scenario_id"]


def test_a_run_with_a_budget_of_iterations_repeats_bit_for_bit(tmp_path):
    changes = {"planner": {"plugin": "rolling_horizon", "planner": "lns"}, "limits": {"execution": 15, "iterations": 3}}
    for name in ("a", "b"):
        run(tmp_path / name, **changes)
    assert (tmp_path / "a" / "run.zip").read_bytes() == (tmp_path / "b" / "run.zip").read_bytes()


@pytest.mark.parametrize(
    "changes",
    [
        {"dispatcher": "adg", "assigner": "insertion", "delays": {"p_delay": 0.01, "speed": 0.3}},
        {"dispatcher": "gses", "navigator": {"plugin": "waypoints", "waypoints": "stop"}},
    ],
)
def test_it_changes_nothing_that_driven_segments_are_left_out_of_plans(tmp_path, monkeypatch, changes):
    changes = {"planner": {"plugin": "rolling_horizon", "planner": "pibt"}, "roadmap": "grid", **changes}
    _, shorter = run(tmp_path / "cut", **changes)
    lengths = []

    def nothing(plan, reached, _cleared):
        lengths.append(max(len(path) for path in plan.paths))
        return np.zeros_like(reached)

    monkeypatch.setattr("mrpbench_core.engine.execution.replanning.driven", nothing)
    _, whole = run(tmp_path / "whole", **changes)
    assert shorter.keys() == whole.keys()
    for name, rows in shorter.items():
        assert np.array_equal(rows, whole[name], equal_nan=rows.dtype.kind == "f"), name
    assert "done" in whole["task_event"]
    assert lengths[-1] > 40


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"replanning": {"period": 2, "window": 20}},
        {
            "planner": {"plugin": "rolling_horizon", "planner": "pibt"},
            "roadmap": "grid",
            "replanning": {"period": 2, "window": 5},
        },
    ],
)
def test_a_finite_stream_ends_the_run(tmp_path, changes):
    finite = {"tasks": {"plugin": "closed_pool", "per_robot": 1, "total": 4}, "limits": {"execution": 400}}
    record, channels = run(tmp_path, **finite, **changes)
    assert record["status"] == "succeeded"
    assert not len(channels["contact"])
    assert Counter(channels["task_event"].tolist())["done"] == 4
    assert channels["time"][-1] < 300


def test_a_planner_that_fails_now_and_then_does_not_end_the_run(tmp_path):
    (tmp_path / "moody.py").write_text(PLANNERS)
    planner = {"plugin": "rolling_horizon", "planner": f"{tmp_path}/moody.py:Moody"}
    record, channels = run(tmp_path, planner=planner)
    assert record["status"] == "succeeded", record
    assert "replan_failed" in channels["event_kind"]
    assert happened(channels, "done")


def test_a_run_in_which_no_plan_is_found_does_not_succeed(tmp_path):
    (tmp_path / "hopeless.py").write_text(PLANNERS)
    planner = {"plugin": "rolling_horizon", "planner": f"{tmp_path}/hopeless.py:Hopeless"}
    record, _ = run(tmp_path, planner=planner, limits={"execution": 12})
    assert record["status"] == "goals_missed"
    assert "no plan was found and no task was done within 12 simulated seconds" in record["error"]["message"]


def test_a_task_of_a_file_takes_a_robot_to_another_floor(tmp_path):
    (tmp_path / "tasks.csv").write_text("release,errands,service\n2,pharmacy_pickup;ward_21_dropoff,3;1\n")
    record, channels = run(
        tmp_path,
        world="hospital",
        scenario={"plugin": "named", "starts": ["L1_charger_west_south"], "goals": ["L1_charger_west_south"]},
        tasks={"plugin": "file", "file": str(tmp_path / "tasks.csv")},
        control_rate=2,
        limits={"execution": 500, "iterations": 5},
    )
    assert record["status"] == "succeeded"
    ((_, task, robot),) = happened(channels, "done")
    assert (task, robot) == (0, 0)
    assert channels["level"][-1].tolist() == [1]


ROOM = ["type octile", "height 3", "width 7", "map", ".......", ".@.@.@.", "......."]
DOCKS = {"0.5": "0.5 0.5", "3.5": "3.5 0.5", "6.5": "6.5 0.5"}


@pytest.mark.parametrize(
    ("planner", "replanning"),
    [("pbs", {}), ("pibt", {}), ("pibt", {"period": 2, "window": 10}), ("prioritized", {"period": 2, "window": 10})],
)
def test_three_robots_use_three_docks_at_once_where_any_will_do(tmp_path, planner, replanning):
    (tmp_path / "room.map").write_text("\n".join([*ROOM, ""]))
    any_dock = "|".join(DOCKS.values())
    (tmp_path / "tasks.csv").write_text("release,errands,service\n" + f"0,{any_dock},30\n" * 3)
    starts = "".join(f"- {{x: {x}, y: 2.5}}\n" for x in (2.5, 3.5, 4.5))
    (tmp_path / "starts.yaml").write_text(f"mrpbench_scenario: 1\nrobots:\n{starts}tasks: []\n")
    record, channels = run(
        tmp_path,
        world={"plugin": "movingai", "file": f"{tmp_path}/room.map"},
        roadmap="grid",
        scenario={"plugin": "file", "file": f"{tmp_path}/starts.yaml"},
        tasks={"plugin": "file", "file": f"{tmp_path}/tasks.csv"},
        planner={"plugin": "rolling_horizon", "planner": planner},
        replanning=replanning,
        limits={"execution": 120, "iterations": 5},
    )
    assert record["status"] == "succeeded", record
    done = happened(channels, "done")
    places = set()
    for time, _, robot in done:
        x, y = channels["truth"][int(np.searchsorted(channels["time"], time)) - 1, robot, :2]
        places.add(min(DOCKS.values(), key=lambda it: np.hypot(*(np.array(it.split(), float) - (x, y)))))
        assert min(np.hypot(*(np.array(it.split(), float) - (x, y))) for it in DOCKS.values()) <= 0.75
    assert len(done) == len(places) == 3, "each robot has a dock of its own"
    assert max(time for time, *_ in done) < 90, "none waited for the service of another"
    assert channels["errand_number"].tolist() == [0] * 9


def test_token_passing_does_well_formed_tasks_and_refuses_others(tmp_path):
    (tmp_path / "room.map").write_text("\n".join([*ROOM, ""]))
    (tmp_path / "tasks.csv").write_text("release,errands\n0,2.5 1.5;4.5 1.5\n0,4.5 1.5;2.5 1.5\n1,2.5 1.5\n")

    def started(second):
        starts = f"robots:\n- {{x: 0.5, y: 1.5}}\n- {{x: {second}, y: 1.5}}\n"
        (tmp_path / "starts.yaml").write_text(f"mrpbench_scenario: 1\n{starts}tasks: []\n")
        return run(
            tmp_path,
            world={"plugin": "movingai", "file": f"{tmp_path}/room.map"},
            roadmap="grid",
            scenario={"plugin": "file", "file": f"{tmp_path}/starts.yaml"},
            tasks={"plugin": "file", "file": f"{tmp_path}/tasks.csv"},
            assigner={"plugin": "token_passing", "task_swaps": True},
            planner={"plugin": "rolling_horizon", "planner": "token_passing"},
            replanning={"parking": "home"},
        )

    record, channels = started(6.5)
    assert record["status"] == "succeeded", record
    assert {task for _, task, _ in happened(channels, "done")} == {0, 1, 2}
    assert "replan_failed" not in channels["event_kind"]
    record, _ = started(2.5)
    assert record["status"] == "skipped"
    assert "needs well-formed tasks: robot 1 starts at (2.5, 1.5)" in record["error"]["message"]
