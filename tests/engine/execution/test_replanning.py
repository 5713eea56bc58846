"""New plans during execution: when they are wanted, when they take effect, and what happens without one."""

import attrs
import numpy as np
import pytest

from mrpbench_core.config.settings import Replanning
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.execution.destinations import Destinations
from mrpbench_core.engine.execution.replanning import RETRY_S, Replanner, replanning_fault
from mrpbench_core.engine.run import execute
from mrpbench_core.model.execution.orders import FleetView
from mrpbench_core.model.planning.plan import Plan, PlanResult, PlanStatus
from mrpbench_core.model.runs.routing import Router
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

HELD = """
import attrs

from mrpbench_core.api import Controller, ControllerSession
from mrpbench_controllers_pure_pursuit import PurePursuit


class Session(ControllerSession):
    held = False

    def __init__(self, inner):
        self.inner = inner

    def command(self, observation):
        stopped = self.held and 5 < observation.now < 45
        return (0.0, 0.0) if stopped else self.inner.command(observation)


@attrs.frozen(kw_only=True)
class FirstHeld(Controller):
    def start(self, robot, world, period):
        return Session(PurePursuit().start(robot, world, period))

    def start_fleet(self, robots, world, period, seed):
        fleet = super().start_fleet(robots, world, period)
        fleet.sessions[0].held = True
        return fleet
"""

ONCE = """
import attrs

from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_planners_mapf.prioritized import Prioritized


@attrs.frozen(kw_only=True)
class Once(Prioritized):
    def plan(self, problem, budget):
        if problem.commitments:
            return PlanResult(status=PlanStatus.GAVE_UP)
        return super().plan(problem, budget)
"""


def view(reached):
    robots = len(reached)
    return FleetView(
        revision=0,
        reached=reached,
        cleared=reached,
        pose=np.zeros((robots, 3)),
        level=np.zeros(robots),
        mode=np.zeros(robots),
    )


def replans(run_context, ask=None, prediction=None, **settings):
    problem, plan = run_context.problem, run_context.result.plan
    router = Router(problem, np.full(len(problem), np.nan), np.full(len(problem.roadmap.edges), np.inf))
    ask = ask or (lambda _: (run_context.result, None, 0.0))
    return Replanner(Replanning(**settings), ask, router, problem, plan, prediction=prediction)


def request(asked, now, reason):
    """Ask for a plan to the goals of the first one, with nothing released."""
    problem = asked.problem
    to = Destinations(goals=problem.goals, yaw=asked.yaw, errands=((),) * len(problem))
    asked.request(now, reason, view([0, 0]), np.zeros(2, np.int32), to, problem.roadmap)


class OneMore:
    """A prediction that adds a robot to problems."""

    def constrained(self, problem, now):
        assert now == 4.0
        both = {name: np.append(getattr(problem, name), getattr(problem, name)[:1]) for name in ("start", "ready")}
        return attrs.evolve(problem, goals=(*problem.goals, problem.goals[0]), **both)


def test_new_plans_are_asked_for_with_what_is_predicted_and_lead_the_robots_alone(run_context):
    asked_for = []

    def ask(problem):
        asked_for.append(len(problem))
        paths = run_context.result.plan.paths
        return attrs.evolve(run_context.result, plan=Plan(paths=[*paths, paths[0]])), None, 0.0

    asked = replans(run_context, ask, OneMore(), period=4.0)
    request(asked, 4.0, "4 s have passed")
    assert asked_for == [3]
    revision = asked.take_due(4.0)
    assert (len(revision.problem), len(revision.plan.paths)) == (2, 2)


def test_a_planner_that_cannot_keep_away_from_what_is_predicted_is_asked_without_it(run_context):
    asked_for = []

    def ask(problem):
        asked_for.append(len(problem))
        if len(problem) == 3:
            return PlanResult(status=PlanStatus.GAVE_UP), "no plan", 0.5
        return run_context.result, None, 0.25

    asked = replans(run_context, ask, OneMore(), period=4.0)
    request(asked, 4.0, "4 s have passed")
    assert asked_for == [3, 2]
    assert asked.take_due(4.5) is None
    revision = asked.take_due(4.75)
    assert (revision.fault, revision.reason) == ("", "4 s have passed; not around what is predicted: no plan")


@pytest.mark.parametrize(("planner", "fits"), [("prioritized", True), ("token_passing", False), ("example", False)])
def test_planners_that_cannot_be_given_what_is_predicted_are_refused(tmp_path, planner, fits):
    pytest.importorskip("mrpbench_predictors_tracking")
    text = (
        f"world: office\nplanner: {planner}\nscenario: {{plugin: random, robots: 2}}\n"
        "replanning: {period: 3, prediction: constant_velocity}\n"
    )
    (tmp_path / "study.yaml").write_text(text)
    (config,) = (run.config for run in load_study(tmp_path / "study.yaml").runs)
    assert (replanning_fault(config) is None) is fits


def test_a_plan_is_kept_unless_the_configuration_says_otherwise(run_context):
    assert replans(run_context).reason(1e6, view([0, 0]), None) is None


def test_a_dispatcher_may_always_wish_for_a_new_plan(run_context):
    assert replans(run_context).reason(0.0, view([0, 0]), "at the horizon") == "at the horizon"


def test_a_late_robot_calls_for_a_new_plan(run_context):
    plan, tick = run_context.result.plan, run_context.problem.roadmap.tick
    asked = replans(run_context, delay=3.0)
    due = plan.paths[0].leave[0] * tick
    assert asked.reason(due + 3.0, view([0, len(plan.paths[1])]), None) is None
    assert asked.reason(due + 3.5, view([0, len(plan.paths[1])]), None) == "robot 0 is 3.5 s late"
    assert asked.reason(due + 100, view([len(path) for path in plan.paths]), None) is None, "all have arrived"


def test_a_period_calls_for_new_plans_again_and_again(run_context):
    asked = replans(run_context, period=4.0)
    assert asked.reason(3.9, view([0, 0]), None) is None
    assert asked.reason(4.0, view([0, 0]), None) == "4 s have passed"
    request(asked, 4.0, "4 s have passed")
    asked.take_due(4.0)
    assert asked.reason(7.9, view([0, 0]), None) is None
    assert asked.reason(8.0, view([0, 0]), None) is not None


def test_a_new_plan_takes_effect_after_the_latency(run_context):
    asked = replans(run_context, delay=1.0, latency=2.0)
    request(asked, 10.0, "late")
    assert asked.take_due(11.9) is None
    revision = asked.take_due(12.0)
    assert revision.plan is run_context.result.plan
    assert [path.leave.tolist() for path in revision.problem.commitments] == [
        [12.0 / run_context.problem.roadmap.tick]
    ] * 2
    assert asked.pending is None


def test_after_a_failure_the_next_try_waits(run_context):
    nothing = PlanResult(status=PlanStatus.TIMEOUT)
    asked = replans(run_context, lambda _: (nothing, "the planner ended with timeout", 0.0))
    request(asked, 10.0, "late")
    assert asked.take_due(10.0).plan is None
    asked.failed(10.0)
    assert asked.reason(10.0 + RETRY_S / 2, view([0, 0]), "at the horizon") is None
    assert asked.reason(10.0 + RETRY_S, view([0, 0]), "at the horizon") is not None


RUN = {
    "world": "warehouse",
    "scenario": {"plugin": "random", "robots": 9},
    "assigner": "hungarian",
    "planner": "prioritized",
    "controller": {"plugin": "./held.py:FirstHeld"},
    "navigator": {"plugin": "waypoints", "movement_time_allowance": "100 s"},
    "control_rate": "5 Hz",
    "metrics": ["planning", "execution", "delay", "contact", "tracking"],
    "seed": 4,
}


def executed(tmp_path, monkeypatch, **changes):
    pytest.importorskip("mrpbench_planners_mapf")
    pytest.importorskip("mrpbench_assigners_hungarian")
    pytest.importorskip("mrpbench_controllers_pure_pursuit")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "held.py").write_text(HELD)
    (point,) = load_study({**RUN, **changes}).runs
    paths = RunPaths(recording=tmp_path / "run.zip", exports=tmp_path / "exports")
    stages = []
    record = execute(point.config, point.run_id, paths, lambda stage, facts: stages.append(stage)).message()
    return record, stages


@pytest.fixture
def events(tmp_path):
    def read():
        recording = Recording(tmp_path / "run.zip")
        kinds = recording.channel("event_kind").tolist()
        recording.close()
        return kinds

    return read


def test_robots_held_up_by_another_arrive_earlier_with_new_plans(tmp_path, monkeypatch, events):
    without, stages = executed(tmp_path, monkeypatch)
    assert "replanning" not in stages
    assert "replan" not in events()
    record, stages = executed(tmp_path, monkeypatch, replanning={"delay": "5 s", "latency": "0.5 s"})
    assert stages.count("replanning") == events().count("replan") > 0
    assert without["status"] == record["status"] == "succeeded"
    assert record["metrics"]["delay.mean_s"] < 0.9 * without["metrics"]["delay.mean_s"]
    assert record["metrics"]["execution.robot_contacts"] == 0
    assert record["metrics"]["tracking.max_m"] < 0.3, "the routes that were driven are the last plan's"
    assert record["timing"]["replanning_s"] > 0


def test_the_run_goes_on_with_its_plan_when_no_new_one_is_found(tmp_path, monkeypatch, events):
    (tmp_path / "once.py").write_text(ONCE)
    record, _ = executed(tmp_path, monkeypatch, planner={"plugin": "./once.py:Once"}, replanning={"delay": "5 s"})
    assert record["status"] == "succeeded"
    assert set(events()) == {"replan_failed"}


def test_a_planner_that_cannot_begin_with_released_segments_is_skipped(tmp_path, monkeypatch):
    pytest.importorskip("mrpbench_planners_example")
    record, _ = executed(tmp_path, monkeypatch, planner="example", replanning={"period": "5 s"})
    assert record["status"] == "skipped"
    assert "`rolling_horizon` plans with it" in record["error"]["message"]
