"""The suites catch what they are for: plugins with one fault each fail the check of that fault."""

import attrs
import numpy as np
import pytest

from mrpbench_core import testing
from mrpbench_core.api import (
    Assigner,
    AssignmentError,
    Column,
    Controller,
    ControllerSession,
    Crowd,
    Dispatcher,
    DispatcherSession,
    Exporter,
    ExporterSession,
    Metric,
    Planner,
    Promise,
    option,
)
from mrpbench_core.builtin.assigners.identity import Identity
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.builtin.localizers.ground_truth import GroundTruth
from mrpbench_core.builtin.navigators.waypoints import Waypoints
from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.builtin.scenarios.random import Random
from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.builtin.worlds.shipped import Office
from mrpbench_core.model.assignment import Assignment
from mrpbench_core.model.execution import Orders
from mrpbench_core.model.plan import Path, Plan, PlanResult, PlanStatus
from mrpbench_core.model.problem import Feature
from mrpbench_core.testing.asking import ask
from mrpbench_core.testing.drawing import problem
from mrpbench_core.testing.outcome import Fault
from mrpbench_core.testing.room import fleet

frozen = attrs.frozen(kw_only=True)


def failures(component):
    """Reasons of failed checks, by name."""
    return {
        check.name: check.reason
        for check in testing.run_checks(testing.suite_for(component))
        if check.outcome == "failed"
    }


def changed(base, **methods):
    """A component like `base` with other methods or class attributes."""
    name = f"Changed{len(globals())}"
    made = frozen(type(name, (base,), {"__doc__": "Changed.", "__module__": __name__, **methods}))
    globals()[name] = made  # where pickle and configurations look for it
    return made


# Components -----------------------------------------------------------------------------------------------------------


@frozen
class Silent(Identity):
    """It has an option without help, and one that cannot be hashed."""

    mute: int = 3
    listed: list[int] = option(attrs.Factory(list), help="cannot be hashed")


@attrs.define(kw_only=True)
class Soft(Metric):
    """It can be changed."""

    columns = (Column("level", "", "neither", "of softness"),)
    level: int = option(1, help="of softness")

    def measure(self, run):
        return {"level": self.level}


@frozen
class Private(Identity):
    """It has an option that no file can express."""

    function: type = option(int, help="a class")


def test_an_option_without_help_and_one_without_hash():
    found = failures(Silent())
    assert "mute" in found["is documented with all its options"]
    assert "hash" in found["equal components are equal and print alike"]


def test_a_component_that_can_be_changed():
    found = failures(Soft())
    assert "frozen" in found["keeps the contract of components"]
    assert found["cannot be changed"] == "option level can be set"


def test_an_option_that_no_file_can_express():
    found = failures(Private())
    assert {"has a schema for editors", "can be written in a configuration"} <= found.keys()


# Planners -------------------------------------------------------------------------------------------------------------


@frozen
class Still(Planner):
    """Plans that nobody moves."""

    def plan(self, problem, budget):
        nothing = Path(edge=[], enter=[], leave=[])
        return PlanResult(status=PlanStatus.SOLVED, plan=Plan(paths=(nothing,) * len(problem)))


class Bfs:
    """Shortest paths of robots alone, with conflicts."""

    @staticmethod
    def plan(asked):
        paths = []
        if len(asked) > 10:
            return None
        for robot, start in enumerate(asked.start.tolist()):
            ways = {start: []}
            queue = [start]
            for vertex in queue:
                for edge, (tail, head) in enumerate(asked.roadmap.edges.tolist()):
                    if tail == vertex and head not in ways and asked.duration(robot)[edge] > 0:
                        ways[head] = [*ways[vertex], edge]
                        queue.append(head)
            edges = ways.get(asked.goals[robot][0][0])
            if edges is None:
                return None
            paths.append(Path(edge=edges, enter=np.arange(len(edges)), leave=np.arange(len(edges)) + 1))
        return Plan(paths=tuple(paths))


def alone(self, asked, budget):
    plan = Bfs.plan(asked)
    return PlanResult(status=PlanStatus.SOLVED if plan else PlanStatus.UNSOLVABLE, plan=plan)


def gives_up(self, asked, budget):
    return PlanResult(status=PlanStatus.GAVE_UP)


PLANNERS = {
    "finds the way of a robot alone": {"plan": gives_up},
    "plans are valid": {"plan": alone},
    "does not claim that a solvable problem is unsolvable": {
        "plan": lambda self, asked, budget: PlanResult(status=PlanStatus.UNSOLVABLE)
    },
    "is complete": {"plan": gives_up, "promises": frozenset({Promise.COMPLETE})},
    "declares features and promises": {"plan": gives_up, "supports": {"footprints"}},
    "skips what it does not support": {"plan": gives_up, "skip": lambda self, asked: None},
    "has a problem for every feature it supports": {
        "plan": gives_up,
        "supports": frozenset({Feature.GOAL_SETS}),
        "skip": lambda self, asked: (
            "likes no choice" if Feature.GOAL_SETS in asked.features else Planner.skip(self, asked)
        ),
    },
    "bounds hold": {
        "plan": lambda self, asked, budget: PlanResult(status=PlanStatus.GAVE_UP, lower_bound=1000.0),
    },
    "is within its bound": {"plan": gives_up, "promises": frozenset({Promise.BOUNDED})},
}


@pytest.mark.parametrize("check", PLANNERS)
def test_a_planner(check):
    assert check in failures(changed(Still, **PLANNERS[check])())


def test_a_planner_that_leaves_robots_where_they_are():
    assert "ends at vertex 0 instead of its goal" in failures(Still())["plans are valid"]


def test_a_planner_whose_optimum_is_none():
    def slow(self, asked, budget):
        plan = Bfs.plan(asked)
        if plan is None or len(asked) > 1:
            return PlanResult(status=PlanStatus.GAVE_UP)
        late = Path(
            edge=[-1, *plan.paths[0].edge], enter=[0, *plan.paths[0].enter + 1], leave=[1, *plan.paths[0].leave + 1]
        )
        return PlanResult(status=PlanStatus.SOLVED, plan=Plan(paths=(late,)))

    found = failures(changed(Still, plan=slow, promises=frozenset({Promise.CONFLICT_FREE, Promise.OPTIMAL}))())
    assert found["is optimal"] == "a robot alone: costs 4, the optimum is 3"
    assert "plans are valid" not in found


def test_a_planner_that_changes_its_mind():
    calls = iter(range(10_000))

    def moody(self, asked, budget):
        return alone(self, asked, budget) if next(calls) % 2 else gives_up(self, asked, budget)

    promises = frozenset({Promise.DETERMINISTIC})
    assert "gives the same plan again" in failures(changed(Still, plan=moody, promises=promises)())


def test_a_planner_that_ignores_its_budget(monkeypatch):
    monkeypatch.setattr("mrpbench_core.testing.asking.MARGIN", 0.05)
    monkeypatch.setattr("mrpbench_core.testing.asking.PATIENCE", 0.1)
    from threading import Event

    woken = Event()

    def sleeps(self, asked, budget):
        woken.wait(20)
        return PlanResult(status=PlanStatus.GAVE_UP)

    with pytest.raises(Fault, match="still runs"):
        ask(changed(Still, plan=sleeps)(), problem("a A"), wall_s=0.05)
    woken.set()


def test_a_planner_that_raises_is_located():
    def breaks(self, asked, budget):
        raise KeyError("left")

    reason = failures(changed(Still, plan=breaks)())["plans are valid"]
    assert reason.startswith("raises KeyError: 'left' (")
    assert "test_catches.py:" in reason


# Assigners ------------------------------------------------------------------------------------------------------------


@frozen
class Greedy(Assigner):
    """Takes the cheapest pair that is left: feasible but not optimal."""

    def assign(self, problem):
        costs, task = problem.costs.copy(), np.full(len(problem.costs), -1)
        for _ in range(min(costs.shape)):
            robot, chosen = np.unravel_index(costs.argmin(), costs.shape)
            if not np.isfinite(costs[robot, chosen]):
                raise AssignmentError("stuck")
            task[robot] = chosen
            costs[robot], costs[:, chosen] = np.inf, np.inf
        rows = np.flatnonzero(task >= 0)
        return Assignment(task=task, cost=problem.costs[rows, task[rows]].sum())


def test_an_assigner_that_is_greedy():
    found = failures(Greedy())
    assert "is optimal" in found
    assert "gives each task to one robot" not in found
    assert "raises an assignment error when nothing is feasible" not in found


def test_an_assigner_that_gives_all_the_first_task():
    def assign(self, problem):
        return Assignment(task=np.zeros(len(problem.costs), int), cost=0.0)

    found = failures(changed(Greedy, assign=assign)())
    assert {
        "gives each task to one robot",
        "is optimal",
        "avoids what is forbidden",
        "raises an assignment error when nothing is feasible",
    } <= found.keys()


# Dispatchers ----------------------------------------------------------------------------------------------------------


class Session(DispatcherSession):
    """Releases everything."""

    def __init__(self, problem, plan):
        self.adopt(problem, plan)

    def adopt(self, problem, plan):
        self.length = np.array([len(path) for path in plan.paths])

    def update(self, now, view):
        return Orders(released=self.length)


def session(**methods):
    made = type("Changed", (Session,), methods)
    return changed(Dispatcher, start=lambda self, problem, plan: made(problem, plan))()


def test_a_dispatcher_that_takes_back():
    found = failures(
        session(update=lambda self, now, view: Orders(released=self.length if now < 1 else 0 * self.length))
    )
    assert "takes back" in found["releases ever more of each path"]


def test_a_dispatcher_that_releases_nothing():
    found = failures(session(update=lambda self, now, view: Orders(released=0 * self.length)))
    assert "wait for ever" in found["plans drain under delays"]
    assert "goes on with a new plan" in found


def test_a_dispatcher_that_claims_to_keep_robots_apart():
    def start(self, problem, plan):
        Adg().start(problem, plan)  # refuses conflicts
        return Session(problem, plan)

    found = failures(changed(Dispatcher, start=start)())
    assert set(found) == {"delays do not make robots meet"}


def test_a_dispatcher_that_says_it_keeps_robots_apart():
    class Suite(testing.DispatcherConformance):
        keeps_apart = True

        def make(self):
            return made

    made = session()
    found = {check.name for check in testing.run_checks(Suite()) if check.outcome == "failed"}
    assert found == {"delays do not make robots meet", "refuses or survives plans with conflicts"}


# Controllers ----------------------------------------------------------------------------------------------------------


def controller(command):
    made = type("Changed", (ControllerSession,), {"command": command})
    return changed(Controller, start=lambda self, robot, world, period: made())()


@pytest.mark.parametrize(
    ("command", "check"),
    [
        (lambda self, seen: (5.0, 0.0), "commands are within the limits of the robot"),
        (lambda self, seen: (float("nan"), 0.0), "commands are within the limits of the robot"),
        (lambda self, seen: (0.2, 0.0), "keeps the speed that is allowed"),
        (lambda self, seen: (0.0, 0.0), "comes to the end of a straight path and stops"),
        (lambda self, seen: (0.1, 0.0), "a robot at the end stays"),
        (lambda self, seen: (0.0, 0.5), "turns towards the path"),
        (lambda self, seen: (0.1, 0.0), "comes round a corner and stops"),
        (
            lambda self, seen: (np.random.default_rng().random() / 10, 0.0),
            "the same observations give the same commands",
        ),
    ],
)
def test_a_controller(command, check):
    assert check in failures(controller(command))


def test_a_controller_with_memory_in_its_recipe():
    class Shared(ControllerSession):
        calls = 0

        def command(self, seen):
            Shared.calls += 1
            return (0.1 if Shared.calls % 3 else 0.0), 0.0

    found = failures(changed(Controller, start=lambda self, robot, world, period: Shared())())
    assert "robots do not disturb one another" in found


# Simulators -----------------------------------------------------------------------------------------------------------


def simulator(**methods):
    """The kinematic simulator with other methods of its simulation."""

    def opened(self, *arguments, **named):
        inner = Kinematic().open(*arguments, **named)
        inner.__class__ = type("Changed", (type(inner),), methods)
        return inner

    return changed(Kinematic, open=opened)()


PLANE = type(Kinematic().open(Office().load(), fleet(1), np.ones((1, 3)), 0, 0.05))


def ghost(self, inputs):
    """Robots that pass through everything, at any speed."""
    twist = inputs.twist
    direction = np.column_stack([np.cos(self._pose[:, 2]), np.sin(self._pose[:, 2])])
    self._pose = self._pose + np.column_stack([direction * twist[:, :1], twist[:, 1]]) * self._period
    self._periods += 1
    self._scans += self._take_scans()
    self._state = attrs.evolve(self._state, pose=self._pose, twist=twist)
    return self._state


def mirrored(self, inputs):
    return PLANE.step(self, attrs.evolve(inputs, twist=inputs.twist * (1, -1)))


def drifting(self, inputs):
    self._pose = self._pose + (0, 0, 0.001)
    return PLANE.step(self, inputs)


def noisy(self, inputs):
    self._pose = self._pose + (1e-7 * np.random.default_rng().random(), 0, 0)
    return PLANE.step(self, inputs)


@pytest.mark.parametrize(
    ("methods", "checks"),
    [
        (
            {"step": ghost},
            {
                "no robot is faster than its limits",
                "walls stop robots and are reported",
                "robots do not pass through one another",
            },
        ),
        ({"step": mirrored}, {"a positive turn rate turns counter clockwise"}),
        ({"step": drifting}, {"a robot commanded straight moves straight", "robots without a command stay"}),
        ({"step": noisy}, {"runs are equal to the last bit"}),
        ({"scans": lambda self: self._scans}, {"scans come once and in order"}),
        ({"scans": lambda self: ()}, {"scans come once and in order", "scans measure walls and robots"}),
        (
            {
                "scans": lambda self: tuple(
                    attrs.evolve(scan, ranges=scan.ranges[:, ::-1]) for scan in PLANE.scans(self)
                )
            },
            {"scans measure walls and robots"},
        ),
        ({"close": lambda self: self.__dict__.pop("_pose")}, {"closes twice"}),
        (
            {"state": property(lambda self: attrs.evolve(self._state, pose=self._state.pose + 0.1))},
            {"begins with the placements", "states have the shapes of the contract"},
        ),
    ],
)
def test_a_simulator(methods, checks):
    assert checks <= failures(simulator(**methods)).keys()


# Metrics and exporters ------------------------------------------------------------------------------------------------


@frozen
class First(Metric):
    """Where the first robot ended."""

    columns = (Column("x", "m", "neither", "of the first robot"),)
    requires = frozenset({"truth"})

    def measure(self, run):
        return {"x": float(run.channel("truth")[-1, 0, 1])}


def one(value, *names):
    return lambda self, run: dict.fromkeys(names or ("x",), value)


@pytest.mark.parametrize(
    ("changes", "check"),
    [
        ({}, "does not depend on the order of robots"),
        ({"measure": one(float("nan"))}, "gives exactly its columns"),
        ({"measure": one("far")}, "gives exactly its columns"),
        ({"measure": one(1.0, "x", "y")}, "gives exactly its columns"),
        ({"measure": one(1.0, "y")}, "gives exactly its columns"),
        ({"requires": frozenset({"truths"})}, "requires channels that exist"),
        ({"requires": frozenset()}, "needs no channel that it does not require"),
        ({"columns": ()}, "describes its columns"),
        ({"columns": First.columns * 2}, "describes its columns"),
        ({"measure": lambda self, run: {"x": np.random.default_rng().random()}}, "measures the same again"),
        ({"measure": lambda self, run: {"x": run.channel("truth").sort() or 1.0}}, "gives exactly its columns"),
    ],
)
def test_a_metric(changes, check):
    assert check in failures(changed(First, **changes)())


@frozen
class Text(Exporter):
    """Counts samples in a text file."""

    mode: str = option("w", help="how to open the file")
    scratch: bool = option(False, help="leave a scratch file behind")
    careless: bool = option(False, help="forget to remove the file of a failed run")

    def open(self, context, destination):
        return TextSession(self, destination)


class TextSession(ExporterSession):
    def __init__(self, options, destination):
        self.options, self.file = options, destination.with_suffix(".txt")
        self.stream = self.file.open(options.mode)

    def write(self, chunk):
        self.stream.write(f"{len(chunk.get('time', ()))} samples, written one after another\n")

    def close(self):
        self.stream.close()
        if self.options.scratch:
            self.file.with_name("scratch").write_text("forgotten")

    def abandon(self):
        self.stream.close()
        if not self.options.careless:
            self.file.unlink()


def test_an_exporter():
    assert not failures(Text())
    assert set(failures(Text(mode="a"))) == {"replaces what is there"}
    assert set(failures(Text(scratch=True))) == {"writes a run", "replaces what is there"}
    assert set(failures(Text(careless=True))) == {"leaves nothing of a run that failed"}


# The rest -------------------------------------------------------------------------------------------------------------


def wrapped(base, method, change):
    """A component whose `method` returns what `change` makes of it."""
    return changed(base, **{method: lambda self, *arguments: change(getattr(base, method)(self, *arguments))})


def test_a_world_with_a_lane_to_nowhere():
    def cut(world):
        return attrs.evolve(world, vertices=world.vertices[:-1])

    assert set(failures(wrapped(Office, "load", cut)())) == {"lanes join vertices that exist"}


def test_a_roadmap_through_walls():
    def through(roadmap):
        far = [[0, len(roadmap.position) - 1]]
        return attrs.evolve(
            roadmap,
            edges=np.concatenate([roadmap.edges, far]),
            duration=np.concatenate([roadmap.duration, [[1]]], axis=1),
        )

    assert set(failures(wrapped(Graph, "build", through)())) == {"robots keep clear of walls"}


def test_a_roadmap_with_instant_edges():
    found = failures(wrapped(Graph, "build", lambda made: attrs.evolve(made, duration=0 * made.duration))())
    assert "arrays fit together" in found


def test_a_scenario_that_is_drawn_anew():
    def draw(self, world, roadmap, fleet, seed):
        return Random.draw(self, world, roadmap, fleet, int(np.random.default_rng().integers(1 << 30)))

    assert "the same seed draws the same scenario" in failures(changed(Random, draw=draw)(robots=4))


def test_a_localizer_that_is_lost():
    def start(self, *arguments):
        inner = GroundTruth().start(*arguments)
        inner.__class__ = type(
            "Lost",
            (type(inner),),
            {
                "update": lambda lost, now, *seen: attrs.evolve(
                    type(inner).__mro__[1].update(lost, now, *seen), pose=seen[2] + now
                )
            },
        )
        return inner

    assert "follows robots whose sensors are exact" in failures(changed(GroundTruth, start=start)())


def test_a_navigator_that_stands_still():
    def start(self, *arguments):
        inner = Waypoints.start(self, *arguments)
        step = inner.step
        inner.step = lambda *seen: attrs.evolve(step(*seen), twist=np.zeros((2, 2)))
        return inner

    found = failures(changed(Waypoints, start=start)())
    assert {"drives robots to the ends of their routes", "goes on with longer routes"} <= found.keys()


def test_a_crowd():
    class Walk:
        radii = (0.3,)

        def __init__(self, speed):
            self.speed, self.x = speed, 0.0

        def step(self, dt, state):
            self.x += dt
            return np.array([(self.x, 0.0, self.speed, 0.0)])

    def crowd(speed):
        return changed(Crowd, start=lambda self, world, seed: Walk(speed))()

    assert not failures(crowd(1.0))
    assert set(failures(crowd(3.0))) == {"speeds are those of the motion"}
