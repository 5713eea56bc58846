"""Whole runs of robots that visit several goals in order."""

import attrs
import numpy as np
import pytest
from mrpbench_assigners_greedy.insertion import Insertion
from mrpbench_tests.execution.task_steps import TaskSteps, until_done
from mrpbench_tests.instances.problems import grid_of, problem_on

from mrpbench_core.builtin.task_sources.listed import ListedStream
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.execution.visits import Visits
from mrpbench_core.engine.run import execute
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

prioritized = pytest.importorskip("mrpbench_planners_mapf.prioritized")
BATCH = """\
name: batch
world: {plugin: movingai, file: room.map, resolution: 1.0}
roadmap: grid
scenario: {plugin: file, file: tasks.yaml}
fleet: {robot: turtlebot3_burger, lidar: none}
assigner: identity
planner: prioritized
control_rate: 10
limits: {execution: 2 min}
metrics: [planning]
"""
TASKS = """\
mrpbench_scenario: 1
robots: [{x: 0.5, y: 0.5}, {x: 5.5, y: 1.5}]
tasks:
  - goals: [{x: 4.5, y: 1.5}, {x: 1.5, y: 1.5}, {x: 1.5, y: 1.5}, {x: 0.5, y: 0.5}]
  - goals: [{x: 3.5, y: 0.5}]
"""
ROOM = "type octile\nheight 2\nwidth 6\nmap\n......\n......\n"
CLAIMING = """\
import attrs
import numpy as np
from mrpbench_core.api.navigator import Navigator, NavigatorSession
from mrpbench_core.model.execution.motion import Mode, Motion


@attrs.frozen(kw_only=True)
class Claiming(Navigator):
    def start(self, fleet, world, routes, controller, period, seed):
        return Standing()


class Standing(NavigatorSession):
    def adopt(self, routes, cut):
        raise AssertionError

    def step(self, now, observation, orders):
        done, count = orders.released, len(orders.released)
        mode = np.full(count, Mode.WAITING, "u1")
        return Motion(twist=np.zeros((count, 2)), reached=done, cleared=done, mode=mode)
"""


def run(folder, tasks=TASKS, **changes):
    """The record of a batch, and the poses f8[k,n,3] of its recording."""
    (folder / "study.yaml").write_text(BATCH)
    (folder / "tasks.yaml").write_text(tasks)
    (folder / "room.map").write_text(ROOM)
    (folder / "claiming.py").write_text(CLAIMING)
    (point,) = load_study(folder / "study.yaml", [f"{key}={value}" for key, value in changes.items()]).runs
    paths = RunPaths(recording=folder / "run.zip", exports=folder / "exports", picture=None)
    record = execute(point.config, point.run_id, paths, lambda stage, facts: None).message()
    if not paths.recording.exists():
        return record, None
    recording = Recording(paths.recording)
    pose = recording.channel("truth")
    recording.close()
    return record, pose


@pytest.mark.parametrize("planner", ["prioritized", "{plugin: rolling_horizon, planner: pbs}"])
def test_a_robot_of_a_batch_drives_over_all_its_goals(tmp_path, planner):
    record, pose = run(tmp_path, planner=planner)
    assert record["status"] == "succeeded", record
    away = [np.hypot(*(pose[:, 0, :2] - place).T) for place in ((4.5, 1.5), (1.5, 1.5), (0.5, 0.5))]
    first = int((away[0] < 0.25).argmax())
    second = first + int((away[1][first:] < 0.25).argmax())
    assert 0 < first < second
    assert away[2][-1] < 0.25


def test_a_planner_that_takes_one_goal_is_not_asked_for_several(tmp_path):
    record, _ = run(tmp_path, planner="cbs")
    assert record["status"] == "skipped"
    assert "goal_sequences" in record["error"]["message"]


EITHER = """\
mrpbench_scenario: 1
robots: [{x: 1.5, y: 0.5}, {x: 2.5, y: 1.5}]
tasks:
  - goals: [[{x: 0.5, y: 0.5, yaw: 1.5}, {x: 4.5, y: 0.5}]]
  - goals: [{x: 0.5, y: 0.5}]
"""


@pytest.mark.parametrize("planner", ["cbs", "pibt"])
def test_a_robot_of_a_batch_goes_to_the_place_that_is_left(tmp_path, planner):
    record, pose = run(tmp_path, EITHER, planner=planner)
    assert record["status"] == "succeeded", record
    assert np.hypot(*(pose[-1, 0, :2] - (4.5, 0.5))) < 0.25
    assert np.hypot(*(pose[-1, 1, :2] - (0.5, 0.5))) < 0.25
    record, _ = run(tmp_path, EITHER.replace("4.5", "0.5"), planner=planner)
    assert record["status"] == "scenario_infeasible"
    assert "robots 0 and 1 share the goal" in record["error"]["message"]


@pytest.mark.parametrize("planner", ["cbs", "pibt"])
def test_the_yaw_is_the_one_of_the_place(tmp_path, planner):
    nearer = EITHER.replace("goals: [{x: 0.5, y: 0.5}]", "goals: [{x: 5.5, y: 1.5}]")
    _, pose = run(tmp_path, nearer, planner=planner)
    assert np.hypot(*(pose[-1, 0, :2] - (0.5, 0.5))) < 0.25
    assert abs(pose[-1, 0, 2] - 1.5) < 0.3


def test_a_robot_that_has_not_been_at_a_goal_has_not_arrived(tmp_path):
    back = "mrpbench_scenario: 1\nrobots: [{x: 0.5, y: 0.5}]\ntasks: [{goals: [{x: 4.5, y: 1.5}, {x: 0.5, y: 0.5}]}]\n"
    record, _ = run(tmp_path, back, navigator="./claiming.py:Claiming", dispatcher="all_at_once")
    assert record["status"] == "goals_missed"
    assert "robot 0 did not come within 0.7 m of goal 0 of its sequence" in record["error"]["message"]


def task(index, *vertices):
    """A task on a row, released at once, without service times."""
    goals = np.array([[float(vertex), 0.0, np.nan] for vertex in vertices])
    count = len(vertices)
    return Task(goals=goals, levels=np.zeros(count, np.int16), service=np.zeros(count), index=index)


def steps(*tasks):
    """An execution of a robot at the end of a row."""
    road = grid_of(["......"])
    return TaskSteps(problem_on(road, [0], [0]), ListedStream(list(tasks)), Insertion(), prioritized.Prioritized())


def test_one_plan_leads_a_robot_over_the_errands_of_its_whole_queue():
    execution = steps(task(0, 3, 1), task(1, 5, 2))
    assert until_done(execution, 100) == 3 + 2 + 4 + 3
    assert execution.plans == 1
    assert not execution.ledger.faults


def test_a_robot_stops_at_errands_that_need_service():
    slow = task(0, 3, 1)
    execution = steps(attrs.evolve(slow, service=np.array([4.0, 0.0])))
    assert until_done(execution, 100) >= 3 + 4 + 2
    assert execution.plans == 2


def test_a_robot_that_misses_errands_on_its_way_stops_at_each(monkeypatch):
    monkeypatch.setattr(Visits, "update", lambda self, place, level, reached: None)
    execution = steps(task(0, 3, 1))
    assert until_done(execution, 100) < np.inf
    assert not execution.ledger.faults
