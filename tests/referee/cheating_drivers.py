"""Components of executions that cheat: each does its work, and changes what it is judged by, or what it says.

Local plugins of `test_cheats`.
"""
# ruff: noqa: N805 - the functions of namespaces are called by name, and are no methods

import gc
import sys

import attrs
import numpy as np
from mrpbench_navigators_waypoints import Waypoints

from mrpbench_core.api import (
    Column,
    Controller,
    ControllerSession,
    Crowd,
    CrowdSession,
    FormatWriter,
    Localizer,
    LocalizerSession,
    Metric,
    Mover,
    Movers,
    NavigatorSession,
    Planner,
    Simulation,
    WritableFormat,
    option,
)
from mrpbench_core.builtin.assigners.identity import Identity
from mrpbench_core.builtin.dispatchers.all_at_once import AllAtOnce
from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.execution.observation import Estimate
from mrpbench_core.model.planning.plan import RobotPath

NOTHING = np.empty(0, np.int64)
STAY = RobotPath(edge=NOTHING, enter=NOTHING, leave=NOTHING)


def replace(name, value):
    """Replace a name in every module of the project, as code in the same process can."""
    for module in [it for key, it in sys.modules.items() if key.startswith("mrpbench")]:
        if name in vars(module):
            setattr(module, name, value)


def of_class(name):
    """An object of the engine in this process."""
    return next(it for it in gc.get_objects() if type(it).__name__ == name)


def without_ways(problem):
    """Every robot is to stay where it begins."""
    object.__setattr__(problem, "goals", tuple(((start,),) for start in problem.start.tolist()))


class Session:
    """Passes everything on to another session."""

    def __init__(self, session, **given):
        self.session = session
        self.__dict__ |= given

    def __getattr__(self, name):
        return getattr(self.session, name)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.session.close()


def made(kind, **methods):
    """A session of a kind with some methods of its own."""
    of_kind = type("Own", (Session, kind), methods)
    of_kind.__abstractmethods__ = frozenset()
    passed = {name: _passed(name) for name in kind.__abstractmethods__ if name not in methods}
    for name, method in passed.items():
        setattr(of_kind, name, method)
    return of_kind


def _passed(name):
    if name in ("state", "movers"):
        return property(lambda own: getattr(own.session, name))
    return lambda own, *given, **named: getattr(own.session, name)(*given, **named)


class Simulating:
    """What simulators do: a state instead of the honest one."""

    def teleports(own, state):
        pose = state.pose.copy()
        if own.periods == 20:
            own.shift = own.goal - pose[:, :2]
        pose[:, :2] += own.shift
        return attrs.evolve(state, pose=pose)

    def too_fast(own, state):
        pose = own.first + 1.4 * (state.pose - own.first)
        return attrs.evolve(state, pose=pose)

    def begins_elsewhere(own, state):
        return attrs.evolve(state, pose=state.pose + [0.9, 0, 0])

    def drifts(own, state):
        return attrs.evolve(state, pose=state.pose + [0.05 * own.periods, 0, 0])

    def turns_at_once(own, state):
        return attrs.evolve(state, pose=state.pose + [0, 0, 2.5 * own.periods])

    def jerks(own, state):
        if own.periods == 20:
            ahead = np.column_stack([np.cos(state.pose[:, 2]), np.sin(state.pose[:, 2]), 0 * state.pose[:, 2]])
            own.shift = 0.045 * ahead
        return attrs.evolve(state, pose=state.pose + own.shift)

    def skips_time(own, state):
        for _ in range(4):
            state = own.session.step(own.inputs)
        return state

    def changes_level(own, state):
        return attrs.evolve(state, level=np.full(len(state.level), own.periods > 5, np.int16))


class Ghosts:
    """The contacts that simulators report that move robots through everything, in the place of an honest simulation."""

    def no_contacts(robots):
        return np.zeros((0, 2), "i4")

    def contacts_with_walls(robots):
        return np.array([(robot, -1) for robot in range(robots)], "i4")


@attrs.frozen(kw_only=True)
class CheatingSimulator(Kinematic):
    """Moves robots as `kinematic`, and says something else."""

    does: str = option("nothing", help="what to do")

    def open(self, world, fleet, placements, seed, period, movers=(), levels=None):
        session = Kinematic.open(self, world, fleet, placements, seed, period, movers, levels)
        does = self.does

        def step(own, inputs):
            own.periods, own.inputs = own.periods + 1, inputs
            if does in vars(Ghosts):
                pose = own.last.pose.copy()
                pose[:, 2] += inputs.twist[:, 1] * period
                pose[:, 0] += inputs.twist[:, 0] * np.cos(pose[:, 2]) * period
                pose[:, 1] += inputs.twist[:, 0] * np.sin(pose[:, 2]) * period
                contacts = vars(Ghosts)[does](len(pose))
                own.last = attrs.evolve(own.last, pose=pose, twist=inputs.twist, contacts=contacts)
            else:
                state = own.session.step(inputs)
                own.last = state if does == "nothing" else vars(Simulating)[does](own, state)
            return own.last

        goal = np.array([of_class("RunContext").goal])[0, :, :2] if does == "teleports" else None
        known = {"first": session.state.pose, "goal": goal, "shift": 0.0, "periods": 0, "last": session.state}
        return made(Simulation, step=step, state=property(lambda own: own.last))(session, **known)


class Navigating:
    """What navigators do to the motion that an honest one wants."""

    def arrived(own, motion):
        return attrs.evolve(motion, reached=own.orders.released, mode=np.full(len(motion.mode), Mode.WAITING, "u1"))

    def arrived_early(own, motion):
        return attrs.evolve(motion, reached=own.orders.released)

    def arrived_and_stands(own, motion):
        return attrs.evolve(Navigating.arrived(own, motion), twist=motion.twist * 0)

    def changes_orders(own, motion):
        object.__setattr__(own.orders, "released", own.orders.released + 99)
        return motion

    def changes_routes(own, motion):
        for route in own.routes:
            object.__setattr__(route, "waypoint", route.waypoint * 0 + route.waypoint[0])
        return attrs.evolve(Navigating.arrived(own, motion), twist=motion.twist * 0)

    def too_fast(own, motion):
        return attrs.evolve(motion, twist=motion.twist * 50)

    def patches_truth(own, motion):
        state = of_class("ExecutionLoop")._state
        state.pose.setflags(write=True)
        state.pose[:, :2] = np.array(of_class("RunContext").goal)[:, :2]
        return Navigating.arrived(own, motion)

    def patches_recorder(own, motion):
        recorder = of_class("RecordingWriter")
        write, goal = type(recorder).write, np.array(of_class("RunContext").goal)[:, :2]

        def at_goals(writer, chunk):
            if "truth" in chunk:
                truth = chunk["truth"].copy()
                truth[-1, :, :2] = goal
                chunk = {**chunk, "truth": truth}
            write(writer, chunk)

        if write.__name__ == "write":
            type(recorder).write = at_goals
        return motion

    def patches_arrivals(own, motion):
        replace("arrival_times", lambda run: np.zeros(len(run.context.fleet)))
        replace("motion_fault", lambda *_: None)
        for module in sys.modules.values():
            if hasattr(module, "Arrivals"):
                module.Arrivals.update = lambda arrivals, now, state, motion: motion
        return attrs.evolve(Navigating.arrived(own, motion), twist=motion.twist * 0)

    def tolerance(own, motion):
        object.__setattr__(of_class("RunContext"), "goal_tolerance", 1e9)
        return Navigating.arrived_and_stands(own, motion)


class Serving:
    """What navigators do where tasks come over time."""

    def claims_tasks(own, motion):
        if not hasattr(own, "board"):
            own.board = of_class("TaskBoard")
        for robot, queue in enumerate(own.board.queues):
            while queue:
                own.board.rest(own.now, robot)
                queue = own.board.queues[robot]
        return motion

    def withholds_tasks(own, motion):
        stream = of_class("PoissonStream")
        if own.now > 2.0:
            stream._next = 1e9
        return motion

    def nearer_tasks(own, motion):
        drawing = of_class("Drawing")
        near = tuple((places[np.arange(2)], count) for places, count in drawing.choices)
        object.__setattr__(drawing, "choices", near)
        return motion


@attrs.frozen(kw_only=True)
class CheatingNavigator(Waypoints):
    """Drives as `waypoints`, and says something else."""

    does: str = option("nothing", help="what to do")

    def start(self, fleet, world, routes, controller, period, seed):
        def step(own, now, observation, orders):
            own.orders, own.now = orders, now
            motion = own.session.step(now, observation, orders)
            return motion if self.does == "nothing" else (vars(Navigating) | vars(Serving))[self.does](own, motion)

        session = Waypoints.start(self, fleet, world, routes, controller, period, seed)
        return made(NavigatorSession, step=step)(session, routes=routes, now=0.0)


@attrs.frozen(kw_only=True)
class CheatingLocalizer(Localizer):
    """Takes the true poses, which it was not granted."""

    does: str = option("nothing", help="what to do")

    def start(self, fleet, world, placements, seed):
        does = self.does

        class Own(LocalizerSession):
            def update(self, now, odometry, scans, truth):
                if does == "covers_ears":
                    return Estimate(pose=placements)
                if does == "patches_truth":
                    object.__setattr__(of_class("ExecutionLoop")._state, "pose", placements)
                return Estimate(pose=odometry.pose if truth is None else truth)

        return Own()


@attrs.frozen(kw_only=True)
class CheatingDispatcher(AllAtOnce):
    """Releases every path at once, and changes what it was given."""

    does: str = option("nothing", help="what to do")

    def start(self, problem, plan):
        if self.does == "goals":
            without_ways(problem)
        if self.does == "plan":
            object.__setattr__(plan, "paths", (STAY,) * len(problem))
        return AllAtOnce.start(self, problem, plan)


@attrs.frozen(kw_only=True)
class CheatingController(Controller):
    """Has the robots put at their goals, or claims commands that no robot can follow."""

    does: str = option("nothing", help="what to do")

    def start(self, robot, world, period):
        if self.does == "limits":
            object.__setattr__(robot, "max_speed", 9.0)
        if self.does == "walls":
            for level in world.levels:
                object.__setattr__(level, "walls", level.walls[:0])

        class Own(ControllerSession):
            def command(self, observation):
                return (9.0, 0.0)

        return Own()


@attrs.frozen(kw_only=True)
class CheatingCrowd(Crowd):
    """Somebody who is where no robot can touch them, or who pushes robots to their goals."""

    does: str = option("nothing", help="what to do")

    def start(self, world, fleet, seed, seen):
        goals = np.array([goal[:2] for goal in of_class("RunContext").goal])
        if self.does == "patches":
            replace("motion_fault", lambda *_: None)
            without_ways(of_class("Problem"))

        class Own(CrowdSession):
            members = (Mover(radius=0.2),)

            @property
            def movers(self):
                return Movers(pose=np.array([[*goals[0], 0.0]]), velocity=np.zeros((1, 2)), level=np.zeros(1, "i2"))

            def step(self, dt, seen):
                return self.movers

        return Own()


@attrs.frozen(kw_only=True)
class CheatingFormat(WritableFormat):
    """Writes nothing, and changes the run of which it is told."""

    def open(self, context, destination):
        destination.with_suffix(".txt").write_text("")
        object.__setattr__(context, "goal_tolerance", 1e9)
        without_ways(context.problem)

        class Own(FormatWriter):
            def write(self, chunk):
                for rows in chunk.values():
                    rows.setflags(write=True)
                    if rows.dtype.kind == "f":
                        rows[:] = rows[0]

            def close(self):
                replace("judge", None)

        return Own()


@attrs.frozen(kw_only=True)
class CheatingMetric(Metric):
    """Measures its own number, and says others."""

    columns = (Column("own", "", "higher", "its own number", aliases=("planning.sum_of_costs",)),)

    def measure(self, run):
        replace("measure", lambda *_: {})
        return {"own": 1.0, "planning.sum_of_costs": 0.0, "execution.success": True, "execution.duration_s": 0.0}


@attrs.frozen(kw_only=True)
class ForgingMetric(CheatingMetric):
    """Answers in the place of the engine with values of other metrics."""

    def measure(self, run):
        from mrpbench_core.engine.processes.channel import Channel

        send = Channel.send
        values = {"planning.sum_of_costs": 0.0, "execution.success": True, "ForgingMetric.own": "1"}
        Channel.send = lambda channel, _: send(channel, {"measured": [values, {"planning": "no"}]})
        return {"own": 1.0}


@attrs.frozen(kw_only=True)
class CheatingAssigner(Identity):
    """Gives robots their goals, after it has moved their starts there."""

    def assign(self, problem):
        Planner.assigns = True
        return Identity.assign(self, problem)
