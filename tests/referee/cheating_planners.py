"""Planners that cheat: each plans honestly, and then changes what it is judged by. Local plugins of `test_cheats`."""
# ruff: noqa: N805 - the functions of `Planning` are called by name, and are no methods

import sys
import threading
import time

import attrs
import numpy as np
from mrpbench_planners_mapf.prioritized import Prioritized

from mrpbench_core.api import option
from mrpbench_core.model.planning.plan import Paths, Plan, PlanResult, PlanStatus, RobotPath

NOTHING = np.empty(0, np.int64)
STAY = RobotPath(edge=NOTHING, enter=NOTHING, leave=NOTHING)


def replace(name, value):
    """Replace a name in every module of the project, as code in the same process can."""
    for module in [it for key, it in sys.modules.items() if key.startswith("mrpbench")]:
        if name in vars(module):
            setattr(module, name, value)


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
        paths.append(RobotPath(edge=path.edge[moves], enter=leave - length, leave=leave))
    return attrs.evolve(result, plan=Plan(paths=tuple(paths)))


class Planning:
    """What planners do, by name: they are given the problem and an honest answer."""

    def arrival_property(problem, result):
        RobotPath.arrival = property(lambda path: len(path.edge) // 2)
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
        replace("judge_plan", lambda promises, problem, result, **_: (result, None))
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

        Promises.of = classmethod(lambda cls, planner: cls(made=frozenset(), factor=9e9, assigns=True))
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
        paths = [RobotPath(edge=[robot], enter=[0], leave=[1]) for robot in range(len(problem))]
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
        from mrpbench_core.engine.drive.drive import Claims

        replace("_drive", lambda inputs, instance, claims: None)
        Claims.message = lambda claims: {**attrs.asdict(claims), "recorded": False, "failure": None}
        return standing(problem, result)

    def claims(problem, result):
        from mrpbench_core.engine.drive.drive import Claims

        Claims.message = lambda claims: {
            "failure": None,
            "recorded": True,
            "unexported": {},
            "unarrived": {},
            "timing": {"planning_s": -5.0},
            "metrics": {"planning.sum_of_costs": 0},
        }
        return result

    def claims_without_form(problem, result):
        from mrpbench_core.engine.drive.drive import Claims

        Claims.message = lambda claims: {"failure": 7, "timing": [1]}
        return result

    def said_infeasible(problem, result):
        from mrpbench_core.engine.drive.drive import Claims

        failure = {"status": "scenario_infeasible", "stage": "scenario", "message": "no robot can arrive"}
        Claims.message = lambda claims: {"failure": failure, "recorded": False, "timing": {}}
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
                RobotPath.arrival = property(lambda path: 0)

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
        paths.append(RobotPath(edge=edge, enter=enter, leave=leave))
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
