"""Plugins that cheat: each does its work honestly and then changes what it is judged by. Local plugins of `test_cheats`."""

import gc
import sys
import threading
import time

import attrs
import numpy as np

from mrpbench_core.api import (
    Column,
    Controller,
    ControllerSession,
    Crowd,
    CrowdSession,
    Dispatcher,
    FormatWriter,
    Localizer,
    LocalizerSession,
    Metric,
    Mover,
    Movers,
    Navigator,
    NavigatorSession,
    Simulation,
    Simulator,
    WritableFormat,
    option,
)
from mrpbench_core.builtin.assigners.identity import Identity
from mrpbench_core.builtin.dispatchers.all_at_once import AllAtOnce
from mrpbench_core.builtin.navigators.waypoints import Waypoints
from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.execution.observation import Estimate
from mrpbench_core.model.planning.plan import Path, Paths, Plan, PlanResult, PlanStatus
from mrpbench_planners_mapf.prioritized import Prioritized

NOTHING = np.empty(0, np.int64)
STAY = Path(edge=NOTHING, enter=NOTHING, leave=NOTHING)


def replace(name, value):
    """Replace a name in every module of the project, as code in the same process can."""
    for module in [it for key, it in sys.modules.items() if key.startswith("mrpbench")]:
        if name in vars(module):
            setattr(module, name, value)


def of_class(name):
    """An object of the engine in this process."""
    return next(it for it in gc.get_objects() if type(it).__name__ == name)


def standing(problem, result):
    """No robot moves."""
    return attrs.evolve(result, plan=Plan(paths=(STAY,) * len(problem)))


def sooner(result, factor=2):
    """The same moves in less time."""
    paths = [attrs.evolve(it, enter=it.enter // factor, leave=it.leave // factor) for it in result.plan.paths]
    return attrs.evolve(result, plan=Plan(paths=tuple(paths)))


def all_at_once(result):
    """Each path without its waits."""
    paths = []
    for path in result.plan.paths:
        moves = path.edge >= 0
        length = (path.leave - path.enter)[moves]
        leave = np.cumsum(length)
        paths.append(Path(edge=path.edge[moves], enter=leave - length, leave=leave))
    return attrs.evolve(result, plan=Plan(paths=tuple(paths)))


class Planning:
    """What planners do, by name: they are given the problem and an honest answer."""

    def arrival_property(problem, result):
        Path.arrival = property(lambda path: len(path.edge) // 2)
        return result

    def plan_costs(problem, result):
        Plan.sum_of_costs = property(lambda plan: 1)
        Plan.makespan = property(lambda plan: 1)
        return result

    def paths_of(problem, result):
        Paths.of = classmethod(lambda cls, paths: Paths(first=[0] * (len(problem) + 1), edge=[], enter=[], leave=[]))
        return result

    def check_plan(problem, result):
        import mrpbench_core.checking.plan as checking

        replace("check_plan", lambda *_, **__: checking.PlanReport())
        return standing(problem, result)

    def path_faults(problem, result):
        replace("path_faults", lambda *_: {})
        return sooner(result)

    def find_conflicts(problem, result):
        replace("find_conflicts", lambda *_, **__: [])
        return all_at_once(result)

    def judge_plan(problem, result):
        replace("judge_plan", lambda promises, problem, result: (result, None))
        return standing(problem, result)

    def result_fault(problem, result):
        replace("result_fault", lambda result: None)
        return attrs.evolve(result, plan=Plan(paths=(STAY,)))

    def judge(problem, result):
        from mrpbench_core.referee.verdict import Verdict

        replace("judge", lambda *_, **__: Verdict(metrics={"planning.sum_of_costs": 0.0, "planning.solved": True}))
        return standing(problem, result)

    def record_of(problem, result):
        from mrpbench_core.engine.record import RunRecord

        record = {"planning.sum_of_costs": 0.0, "planning.solved": True}
        replace("record_of", lambda asked, *_, **__: RunRecord(run_id=asked.run_id, metrics=record))
        return standing(problem, result)

    def plan_summary(problem, result):
        replace("plan_summary", lambda *_, **__: {"cost": 0, "problem": "0", "setting": "0"})
        return result

    def measure(problem, result):
        replace("measure", lambda *_, **__: ({"planning.sum_of_costs": 0.0}, {}))
        return result

    def fingerprint(problem, result):
        replace("fingerprint", lambda value: "0" * 32)
        return result

    def asked(problem, result):
        from mrpbench_core.referee.asked import Asked

        Asked.executes = Asked.tasks = property(lambda asked: False)
        return standing(problem, result)

    def promises(problem, result):
        from mrpbench_core.referee.plans import Promises

        Promises.of = classmethod(lambda cls, planner: cls(kept=frozenset(), factor=9e9, assigns=True))
        return all_at_once(result)

    def kept_promises(problem, result):
        Cheat.kept_promises = property(lambda planner: frozenset())
        return all_at_once(result)

    def assigns(problem, result):
        Cheat.assigns = True
        return standing(problem, result)

    def goals(problem, result):
        object.__setattr__(problem, "goals", tuple(((start,),) for start in problem.start.tolist()))
        return standing(problem, result)

    def start(problem, result):
        ends = [path.end(problem.roadmap, start) for path, start in zip(result.plan.paths, problem.start, strict=True)]
        object.__setattr__(problem, "start", np.array(ends, np.int32))
        return standing(problem, result)

    def start_in_place(problem, result):
        problem.start.setflags(write=True)
        problem.start[:] = [goals[-1][0] for goals in problem.goals]
        return standing(problem, result)

    def rules(problem, result):
        object.__setattr__(problem, "rules", None)
        object.__setattr__(problem, "radius", problem.radius * 0)
        return all_at_once(result)

    def durations(problem, result):
        object.__setattr__(problem.roadmap, "duration", problem.roadmap.duration * 0 + 1)
        return sooner(result)

    def edges(problem, result):
        goals = [goals[-1][0] for goals in problem.goals]
        jumps = np.array([*zip(problem.start.tolist(), goals, strict=True)], np.int32)
        object.__setattr__(problem.roadmap, "edges", jumps)
        paths = [Path(edge=[robot], enter=[0], leave=[1]) for robot in range(len(problem))]
        return attrs.evolve(result, plan=Plan(paths=tuple(paths)))

    def tick(problem, result):
        object.__setattr__(problem.roadmap, "tick", 1e-9)
        return result

    def features(problem, result):
        object.__setattr__(problem, "features", frozenset())
        object.__setattr__(problem, "horizon", 1)
        return standing(problem, result)

    def other_goals(problem, result):
        return Prioritized().plan(attrs.evolve(problem, goals=problem.goals[1:] + problem.goals[:1]), BUDGET[0])

    def bound_too_high(problem, result):
        return attrs.evolve(later(result), lower_bound=float(later(result).plan.sum_of_costs))

    def bound_above_cost(problem, result):
        return attrs.evolve(result, lower_bound=1e9)

    def bound_that_lies(problem, result):
        class Lies(float):
            __lt__ = __gt__ = __le__ = __ge__ = lambda *_: False

        return attrs.evolve(later(result), lower_bound=Lies(1e9))

    def no_conflicts_said(problem, result):
        return attrs.evolve(all_at_once(result), statistics={"conflicts": 0.0})

    def timeout_said(problem, result):
        return attrs.evolve(standing(problem, result), status=PlanStatus.TIMEOUT)

    def equal_status(problem, result):
        PlanStatus.__eq__ = lambda *_: True
        return PlanResult(status=PlanStatus.GAVE_UP)

    def plan_class(problem, result):
        class Cheap(Plan):
            sum_of_costs = 0

        return attrs.evolve(result, plan=Cheap(paths=all_at_once(result).plan.paths))

    def clock(problem, result):
        time.perf_counter = time.monotonic = time.process_time = lambda: 0.0
        replace("perf_counter", lambda: 0.0)
        return result

    def slow_clock(problem, result):
        now = time.perf_counter()
        time.sleep(1.0)
        replace("perf_counter", lambda: now)
        return result

    def negative_clock(problem, result):
        replace("perf_counter", lambda: -1e9)
        return result

    def numpy(problem, result):
        np.array_equal = lambda *_, **__: True
        np.flatnonzero = lambda *_: NOTHING
        return standing(problem, result)

    def recorded_plan(problem, result):
        from mrpbench_core.store.recording import RecordedRun

        good, honest = RecordedRun.of.__func__, result
        cheap = all_at_once(honest)
        RecordedRun.of = classmethod(lambda cls, context: good(cls, attrs.evolve(context, result=cheap)))
        return result

    def other_instance(problem, result):
        """The recording holds an instance in which every robot is where it should be."""
        from mrpbench_core.store import recording

        done, good = standing(problem, result), recording.RecordingWriter.__init__
        Planning.start(problem, result)

        def init(writer, file, context, instance=None):
            good(writer, file, attrs.evolve(context, problem=problem, result=done))

        recording.RecordingWriter.__init__ = init
        return done

    def no_recording(problem, result):
        from mrpbench_core.engine.drive import Claims

        replace("_drive", lambda inputs, instance, claims: None)
        Claims.message = lambda claims: {**attrs.asdict(claims), "recorded": False, "ending": None}
        return standing(problem, result)

    def claims(problem, result):
        from mrpbench_core.engine.drive import Claims

        Claims.message = lambda claims: {
            "ending": None,
            "recorded": True,
            "unexported": {},
            "unarrived": {},
            "timing": {"planning_s": -5.0},
            "metrics": {"planning.sum_of_costs": 0},
        }
        return result

    def claims_without_form(problem, result):
        from mrpbench_core.engine.drive import Claims

        Claims.message = lambda claims: {"ending": 7, "timing": [1]}
        return result

    def said_infeasible(problem, result):
        from mrpbench_core.engine.drive import Claims

        ending = {"status": "scenario_infeasible", "stage": "scenario", "message": "no robot can arrive"}
        Claims.message = lambda claims: {"ending": ending, "recorded": False, "timing": {}}
        return result

    def own_record(problem, result):
        from mrpbench_core.engine.processes.channel import Channel

        send = Channel.send
        metrics = {"planning.sum_of_costs": 0.0, "planning.solved": True}
        record = {"run_id": "0", "status": "succeeded", "error": None, "metrics": metrics}
        Channel.send = lambda channel, message: send(channel, {"record": record} if "claims" in message else message)
        return standing(problem, result)

    def own_status(problem, result):
        from mrpbench_core.engine.processes.channel import Channel

        send = Channel.send
        status = {"status": "skipped", "message": "too hard"}
        Channel.send = lambda channel, message: send(channel, status if "claims" in message else message)
        return result

    def thread(problem, result):
        def change():
            while True:
                object.__setattr__(problem, "goals", tuple(((start,),) for start in problem.start.tolist()))
                Path.arrival = property(lambda path: 0)

        threading.Thread(target=change, daemon=True).start()
        time.sleep(0.01)
        return standing(problem, result)

    def encode(problem, result):
        import mrpbench_core.store.recording as recording

        good = recording.encode
        recording.encode = lambda value, keep: {**good(value, keep), "goal_tolerance": 1e9, "latency": 0.0}
        return result

    def instance_folder(problem, result):
        from mrpbench_core.store.instances import InstanceFolder

        InstanceFolder.read = InstanceFolder.write = InstanceFolder._content = lambda *_: b""
        return standing(problem, result)

    def unicode(problem, result):
        return attrs.evolve(result, statistics={"expansions\n\x1b[31m": 1.0})


BUDGET = []


def later(result):
    """Each robot waits before it drives."""
    paths = []
    for path in result.plan.paths:
        wait = ([0], [9]) if len(path) else ([], [])
        edge = np.append(np.full(len(wait[0]), -1), path.edge)
        enter, leave = np.append(wait[0], path.enter + 9), np.append(wait[1], path.leave + 9)
        paths.append(Path(edge=edge, enter=enter, leave=leave))
    return attrs.evolve(result, plan=Plan(paths=tuple(paths)))


@attrs.frozen(kw_only=True)
class Cheat(Prioritized):
    """Plans as `prioritized`, and then does something else."""

    does: str = option("nothing", help="what to do")

    def plan(self, problem, budget):
        BUDGET[:] = [budget]
        result = Prioritized.plan(self, problem, budget)
        return result if self.does == "nothing" else vars(Planning)[self.does](problem, result)


@attrs.frozen(kw_only=True)
class Careless(Prioritized):
    """Plans as if each robot were alone, and promises nothing."""

    promises = frozenset()

    def plan(self, problem, budget):
        return all_at_once(Prioritized.plan(self, problem, budget))


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


@attrs.frozen(kw_only=True)
class CheatingNavigator(Waypoints):
    """Drives as `waypoints`, and says something else."""

    does: str = option("nothing", help="what to do")

    def start(self, fleet, world, routes, controller, period, seed):
        def step(own, now, observation, orders):
            own.orders = orders
            motion = own.session.step(now, observation, orders)
            return motion if self.does == "nothing" else vars(Navigating)[self.does](own, motion)

        session = Waypoints.start(self, fleet, world, routes, controller, period, seed)
        return made(NavigatorSession, step=step)(session, routes=routes)


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
            Planning.goals(problem, PlanResult(status=PlanStatus.SOLVED, plan=plan))
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
            Planning.start(of_class("Problem"), of_class("PlanResult"))

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
        Planning.start(context.problem, context.result)

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
        Cheat.assigns = True
        return Identity.assign(self, problem)
