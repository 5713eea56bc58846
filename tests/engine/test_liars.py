"""A component of any kind that lies about its work, or changes its inputs, gains nothing, and is named."""

import numpy as np
import pytest

from mrpbench_core import run
from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.observers import Observers
from mrpbench_core.engine.pipeline import execute
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

LIARS = """
import time

import attrs
import numpy as np

from mrpbench_core.api import Controller, ControllerSession
from mrpbench_core.api import Assigner, Dispatcher, Localizer, LocalizerSession, Metric, Column, Planner, option
from mrpbench_core.api.format import FormatWriter, WritableFormat
from mrpbench_core.api.navigator import Navigator, NavigatorSession
from mrpbench_core.api.planner import Promise
from mrpbench_core.builtin.dispatchers.all_at_once import AllAtOnce
from mrpbench_core.builtin.navigators.waypoints import Waypoints
from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.builtin.roadmaps.lanes import Lanes
from mrpbench_core.builtin.scenarios.random import Random
from mrpbench_core.model.execution.motion import Mode, Motion
from mrpbench_core.model.execution.observation import Estimate
from mrpbench_core.model.planning.assignment import Assignment
from mrpbench_core.model.planning.plan import Path, Plan, PlanResult, PlanStatus
from mrpbench_planners_example import Example


def stay(problem):
    return Plan(paths=tuple(Path(edge=[], enter=[], leave=[]) for _ in problem.goals))


def write(array, values):
    array.setflags(write=True)
    array[:] = values


class Cheap(Plan):
    sum_of_costs = 0


@attrs.frozen(kw_only=True)
class LyingPlanner(Planner):
    how: str = option(help="to lie")
    promises = frozenset({Promise.CONFLICT_FREE, Promise.BOUNDED})
    supports = Example.supports
    w: float = option(1.0, help="bound")

    def plan(self, problem, budget):
        if self.how == "goals":
            object.__setattr__(problem, "goals", tuple(((int(at),),) for at in problem.start))
            return PlanResult(status=PlanStatus.SOLVED, plan=stay(problem), lower_bound=0.0)
        if self.how == "start":
            write(problem.start, [goals[0][0] for goals in problem.goals])
            return PlanResult(status=PlanStatus.SOLVED, plan=stay(problem), lower_bound=0.0)
        honest = Example().plan(problem, budget)
        if self.how == "late":
            time.sleep(budget.wall_s + 0.3)
        if self.how == "bound":
            object.__setattr__(self, "w", 1e9)
            return attrs.evolve(honest, lower_bound=1.0)
        if self.how == "class":
            return attrs.evolve(honest, plan=Cheap(paths=honest.plan.paths))
        return honest


@attrs.frozen(kw_only=True)
class LyingAssigner(Assigner):
    def assign(self, problem):
        write(problem.costs, 0.0)
        return Assignment(task=np.arange(len(problem.costs)), cost=0.0)


class _Claims(NavigatorSession):
    def __init__(self, session, robots):
        self.session, self.robots = session, robots

    def adopt(self, routes, cut=None):
        raise AssertionError

    def step(self, now, observation, orders):
        if self.session is None:
            return Motion(
                twist=np.zeros((self.robots, 2)), reached=orders.released, cleared=orders.released,
                mode=np.full(self.robots, Mode.WAITING),
            )
        motion = self.session.step(now, observation, orders)
        write(observation.estimate.pose, 0.0)
        write(observation.odometry.pose, 0.0)
        return motion


@attrs.frozen(kw_only=True)
class LyingNavigator(Navigator):
    how: str = option(help="to lie")

    def start(self, fleet, world, routes, controller, period, seed):
        session = None
        if self.how == "inputs":
            session = Waypoints().start(fleet, world, routes, controller, period, seed)
        return _Claims(session, len(fleet))


def speed_up(fleet):
    for robot in fleet.robots:
        object.__setattr__(robot, "max_speed", 99.0)


@attrs.frozen(kw_only=True)
class LyingController(Controller):
    def start(self, robot, world, period):
        object.__setattr__(robot, "max_speed", 99.0)
        return Stop()


class Stop(ControllerSession):
    def command(self, observation):
        return 0.0, 0.0


class _Shift(LocalizerSession):
    def update(self, now, odometry, scans, truth):
        return Estimate(pose=truth)


@attrs.frozen(kw_only=True)
class LyingLocalizer(Localizer):
    needs_truth = True
    changes: bool = option(False, help="the fleet")

    def start(self, fleet, world, placements, seed):
        if self.changes:
            speed_up(fleet)
        return _Shift()


@attrs.frozen(kw_only=True)
class LyingSimulator(Kinematic):
    how: str = option(help="to lie")

    def open(self, world, fleet, placements, seed, period, movers=(), levels=None):
        if self.how == "fleet":
            speed_up(fleet)
        if self.how == "placement":
            placements = placements + [3.0, 0, 0]
        simulation = super().open(world, fleet, placements, seed, period, movers, levels)
        if self.how == "teleport":
            step = simulation.step
            simulation.step = lambda inputs: (lambda s: attrs.evolve(s, pose=s.pose + [5.0, 0, 0]))(step(inputs))
        return simulation


@attrs.frozen(kw_only=True)
class LyingDispatcher(AllAtOnce):
    def start(self, problem, plan):
        session = super().start(problem, plan)
        update = session.update
        def lie(now, view):
            write(view.reached, 10**6)
            write(view.pose, 0.0)
            return update(now, view)
        session.update = lie
        return session


@attrs.frozen(kw_only=True)
class LyingRoadmap(Lanes):
    def build(self, world, fleet):
        roadmap = super().build(world, fleet)
        object.__setattr__(world.levels[0], "walls", np.zeros((0, 4)))
        return roadmap


@attrs.frozen(kw_only=True)
class LyingScenario(Random):
    def draw(self, world, roadmap, fleet, seed):
        scenario = super().draw(world, roadmap, fleet, seed)
        object.__setattr__(fleet.robots[0], "max_speed", 99.0)
        return scenario


class _Junk(FormatWriter):
    def __init__(self, folder):
        self.folder = folder

    def write(self, chunk):
        pass

    def close(self):
        for file in self.folder.glob("*run.zip*"):
            file.write_bytes(b"junk")


@attrs.frozen(kw_only=True)
class LyingFormat(WritableFormat):
    writes: bool = option(True, help="into the recording")

    def open(self, context, destination):
        speed_up(context.fleet)
        for route in context.routes:
            write(route.waypoint, 0.0)
        return _Junk(destination.parent.parent if self.writes else destination)


@attrs.frozen(kw_only=True)
class LyingMetric(Metric):
    columns = (Column("zero", "", "lower", "changes the run"),)
    requires = frozenset({"truth"})

    def measure(self, run):
        object.__setattr__(run.context, "routes", ())
        write(run.channel("truth"), 0.0)
        return {"zero": 0}
"""
HONEST = {
    "name": "liars",
    "world": "office",
    "scenario": {"plugin": "random", "robots": 2},
    "assigner": "identity",
    "planner": "example",
    "localizer": "ground_truth",
    "metrics": ["planning", "execution"],
    "limits": {"planning": 5.0, "execution": 120.0},
    "recording": {"keep": "all"},
}
SHORT = {"planning": 5.0, "execution": 15.0}
"""For what need not arrive."""


@pytest.fixture
def record(tmp_path, monkeypatch):
    """Return a function: the record of a run in this process with some components replaced; it leaves `run.zip`."""
    (tmp_path / "liars.py").write_text(LIARS)
    monkeypatch.chdir(tmp_path)

    def make(observers=None, **changes):
        (point,) = load_study({**HONEST, **changes}).runs
        paths = RunPaths(recording=tmp_path / "run.zip", exports=tmp_path / "exports")
        return execute(point.config, point.run_id, paths, lambda stage, facts: None, observers).message()

    return make


def liar(name, **options):
    return {"plugin": f"./liars.py:Lying{name}", **options}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"planner": liar("Planner", how="goals")}, "the planner LyingPlanner changed the problem.goals"),
        ({"planner": liar("Planner", how="start")}, "the planner LyingPlanner changed the problem.start"),
        ({"planner": liar("Planner", how="class")}, "the planner returned the class Cheap instead of Plan itself"),
        ({"assigner": liar("Assigner")}, "the assigner LyingAssigner changed the assignment problem.costs"),
        ({"roadmap": liar("Roadmap")}, "the roadmap LyingRoadmap changed world or fleet"),
        ({"scenario": liar("Scenario", robots=2)}, "the scenario LyingScenario changed world, roadmap or fleet"),
        (
            {"simulator": liar("Simulator", how="fleet")},
            "the simulator LyingSimulator changed the context.fleet.robots.max_speed",
        ),
        (
            {"localizer": liar("Localizer", changes=True), "grant_truth": True},
            "the localizer LyingLocalizer changed the context.fleet.robots.max_speed",
        ),
        (
            {"controller": liar("Controller")},
            "the controller LyingController changed the context.fleet.robots.max_speed",
        ),
        ({"simulator": liar("Simulator", how="teleport")}, "for robot 0: a position that it cannot have reached"),
        ({"simulator": liar("Simulator", how="placement")}, "for robot 0: a position that it cannot have reached"),
    ],
)
def test_a_component_that_changes_what_it_is_judged_by_breaks_its_contract(record, changes, message):
    with pytest.raises(BrokenContractError) as caught:
        record(**changes)
    assert message in str(caught.value)


def test_the_status_of_a_run_says_that_a_contract_was_broken(record):
    (found,) = run({**HONEST, "planner": liar("Planner", how="goals")}, out="out")
    assert found["status"] == "contract_broken"
    assert "the planner LyingPlanner changed the problem.goals" in found["error"]["message"]


def test_a_plan_after_the_limit_is_a_timeout(record):
    found = record(planner=liar("Planner", how="late"), limits={"planning": 0.5})
    assert found["status"] == "plan_timeout"
    assert found["error"]["message"].startswith("returned after 0.8")
    assert "the limit is 0.5 s" in found["error"]["message"]
    assert found["metrics"]["planning.sum_of_costs"] is None


def test_a_planner_cannot_loosen_its_bound_while_it_plans(record):
    found = record(planner=liar("Planner", how="bound"))
    assert found["status"] == "plan_invalid"
    assert "exceeds 1 times its lower bound" in found["error"]["message"]


def test_robots_that_only_are_said_to_arrive_have_not_arrived(record):
    found = record(navigator=liar("Navigator", how="nothing"))
    assert found["status"] == "goals_missed"
    assert "the navigator reports that robots 0, 1 arrived, but robot" in found["error"]["message"]
    assert found["metrics"]["execution.goals_reached"] == 0
    assert found["metrics"]["execution.success"] is False


@pytest.mark.parametrize(
    "changes", [{"navigator": liar("Navigator", how="inputs")}, {"dispatcher": liar("Dispatcher")}]
)
def test_inputs_that_a_component_changes_in_every_period_change_nothing_that_is_recorded(record, tmp_path, changes):
    honest = {"dispatcher": "all_at_once"} if "dispatcher" in changes else {}
    channels = []
    for components in (honest, changes):
        record(**components, limits=SHORT)
        recording = Recording(tmp_path / "run.zip")
        channels.append([recording.channel(name) for name in ("truth", "estimate", "odometry", "reached")])
        recording.close()
    for one, other in zip(*channels, strict=True):
        assert np.array_equal(one, other)


def test_hooks_and_formats_change_nothing_of_what_components_are_given(record):
    def spoil(context=None, routes=(), **_):
        for route in context.routes if context else routes:
            route.waypoint.setflags(write=True)
            route.waypoint[:] = 0.0
        for robot in context.fleet.robots if context else ():
            object.__setattr__(robot, "max_speed", 99.0)

    honest = record(limits=SHORT)
    for watched in (
        record(limits=SHORT, observers=Observers(planned=spoil, executing=spoil, stepped=spoil)),
        record(limits=SHORT, export=[liar("Format", writes=False)]),
    ):
        assert watched["metrics"]["execution.distance_m"] == honest["metrics"]["execution.distance_m"] > 0
        assert watched["unexported"] == {}


def test_a_recording_that_a_component_changed_is_a_crash_of_the_run_and_no_mistake_of_the_user(record):
    with pytest.raises(RuntimeError, match="the recording was changed after it was written: is not a recording"):
        record(export=[liar("Format")], limits={"planning": 5.0, "execution": 3.0})


def test_true_poses_are_given_only_where_the_configuration_grants_them(record):
    with pytest.raises(Exception, match=r"localizer: LyingLocalizer needs the true poses .*grant_truth: true"):
        record(localizer=liar("Localizer"))
    granted = record(localizer=liar("Localizer"), grant_truth=True, limits=SHORT)
    assert granted["metrics"]["execution.distance_m"] > 0
    assert granted["true_poses"].endswith(":LyingLocalizer")


def test_a_metric_that_changes_the_run_has_no_value_and_changes_no_other_metric(record):
    honest = record(limits=SHORT)
    found = record(metrics=[liar("Metric"), "execution"], limits=SHORT)
    assert found["metrics"]["LyingMetric.zero"] is None
    assert "changed the run" in found["unmeasured"]["LyingMetric"]
    assert found["metrics"]["execution.distance_m"] == honest["metrics"]["execution.distance_m"] > 0
