"""Executes plans of every planner with every dispatcher under many draws of all delays: all robots arrive, none meet.

`make soak` runs it. `python soak_executions.py EXECUTIONS SEED [FIRST]` takes one situation after another: a kind of
problem, a planner and a kind of delay. Each installed dispatcher releases the plan in many executions, in some
situations after new plans on the way. Executions in which a robot does not arrive, or in which robots break a rule of
`mrpbench_core.model.planning.conflicts` although the dispatcher keeps them apart, are printed; all are counted. The
exit code is 1 if there are faults.
"""

import copy
import itertools
import sys
from collections import Counter
from importlib.metadata import entry_points

import attrs
import numpy as np
from mrpbench_tests.execution.batch_executor import BatchExecutor
from mrpbench_tests.execution.meetings import meetings
from mrpbench_tests.instances.kinds import KINDS
from mrpbench_tests.instances.random_plans import random_plan, random_plan_with_resources, wander
from mrpbench_tests.instances.random_problems import random_grid_problem

from mrpbench_core.api import DispatchError
from mrpbench_core.api.planner import Promise
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.config.delays import Delays
from mrpbench_core.engine.execution.commitments import commitments
from mrpbench_core.engine.execution.delays import DrawnDelays
from mrpbench_core.engine.execution.worst_case import Adversary
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.model.execution.orders import BatchOrders
from mrpbench_core.model.planning.plan import Budget, Plan
from mrpbench_core.model.planning.problem import Feature, features_of
from mrpbench_core.testing.execution.resource_manager import ResourceManager

BUDGET = Budget(wall_s=0.5, memory_bytes=1 << 30, iterations=20)
LIMIT = 1200.0
"""Simulated seconds: plans take less than 100, and each robot is late for less than a fifth of the time."""
STOPS = {"p_delay": 0.04, "max_delay": 4}
DELAYS = {
    "none": Delays(),
    "bernoulli": Delays(**STOPS),
    "poisson": Delays(event_model="poisson", **STOPS),
    "gaussian": Delays(duration_model="gaussian", **STOPS),
    "long stops": Delays(p_delay=0.01, min_delay=10, max_delay=20),
    "speed": Delays(speed=0.5),
    "worst case": Delays(worst_case=15),
    "all": Delays(speed=0.3, worst_case=10, tick=0.5, **STOPS),
}
PROBLEMS = {**KINDS, "crowd": lambda random: random_grid_problem(random, int(random.integers(6, 11)), size=6)}
CHANCE = {"chance": random_plan, "chance, resources": random_plan_with_resources}
"""Problems with plans that no planner has made."""
BY_THE_CLOCK = {"all_at_once", "timed"}
"""Dispatchers that let late robots meet."""
DRAWS = {"at once": 1000, "copied": 12, "slow": 1}
"""Executions of one plan: where all go on at once, where each has a session of its own, and where one is enough."""


def components(kind):
    """The classes of a kind that are installed and need nobody outside, by name."""
    loaded = {entry.name: entry.load() for entry in entry_points(group=f"mrpbench.{kind}")}
    return {name: cls for name, cls in loaded.items() if not cls.live}


def planners():
    """Every planner that promises plans without conflicts, also with plans for late robots, by name."""
    found = {}
    for name, planner in components("planners").items():
        fields = {field.name: field for field in attrs.fields(planner)}
        needed = [field for field in fields.values() if field.default is attrs.NOTHING]
        if needed or Promise.CONFLICT_FREE not in planner.promises:
            continue
        found[name] = planner()
        if "k" in fields:
            found[f"{name} k"] = planner(k=2)
        if "p" in fields:
            found[f"{name} p"] = planner(p=0.8, p_delay=0.02, max_delay=2)
    return found


def dispatchers(given, random):
    """Every dispatcher of those `given`, with drawn options, and some of them with speed profiles too."""
    for name, dispatcher in given.items():
        names = {field.name for field in attrs.fields(dispatcher)}
        options = {"lookahead": int(random.choice([1, 3]))} if "lookahead" in names and random.random() < 0.7 else {}
        if "max_deterministic_time" in names:
            options |= {"max_deterministic_time": 0.02, "period": 5.0}
        elif "lateness" in names and random.random() < 0.3:  # changes the order as often as possible
            options |= {"gain": 0.001, "lateness": 0.0, "period": 0.0}
        elif "group_limit" in names and random.random() < 0.5:  # also where that does not pay
            options |= {"gain": -np.inf}
        yield name, dispatcher(**options)
        if "speed_profiles" in names and "max_deterministic_time" not in names and random.random() < 0.3:
            yield f"{name}, speed profiles", dispatcher(**options, speed_profiles=True)


class Copies:
    """Releases a plan in several executions, each by a session of its own."""

    def __init__(self, sessions, executor, revision, random):
        self.sessions, self.executor, self.revision = sessions, executor, revision
        resources = bool(executor.problem.roadmap.resources)
        self.managers = [ResourceManager(executor.problem, random) if resources else None for _ in sessions]
        self.orders = [None] * len(sessions)

    def update(self, now):
        drained = self.executor.drained
        for execution, (session, manager) in enumerate(zip(self.sessions, self.managers, strict=True)):
            if drained[execution] and self.orders[execution] is not None:
                continue
            granted = () if manager is None else manager.granted()
            orders = session.update(now, self.executor.view(execution, self.revision, granted))
            if manager is not None:
                manager.take(orders.requests)
            self.orders[execution] = orders
        rows, group = [], 0
        for execution, orders in enumerate(self.orders):
            for members in orders.in_step:
                rows += [(group, execution, robot, segment) for robot, segment in members]
                group += 1
        limits = [
            orders.speed if len(orders.speed) else np.full(len(orders.released), np.inf) for orders in self.orders
        ]
        released = np.stack([orders.released for orders in self.orders]).astype(np.int64)
        return released, np.array(rows, np.int64).reshape(-1, 4), np.stack(limits)


class AtOnce:
    """Releases a plan in several executions by one session."""

    def __init__(self, session, executor):
        self.session, self.executor = session, executor

    def update(self, now):
        executor = self.executor
        orders = self.session.update(now, np.stack([executor.reached, executor.cleared]))
        assert isinstance(orders, BatchOrders)
        return orders.released, orders.in_step, np.full(orders.released.shape, np.inf)


def proceed(releasing, executor, delays, adversaries, until):
    """Go on until all robots of all executions have arrived, or until a step."""
    while executor.now < until and not executor.drained.all():
        released, in_step, limit = releasing.update(executor.now * executor.period)
        executor.step(released, in_step, limit, delays, adversaries)


def replanned(problem, plan, planner, released, executor, random):
    """A problem and a plan that begin with what is released, or None."""
    now = int(np.ceil(executor.now * executor.period / problem.roadmap.tick))
    ready = now + random.integers(0, 5, len(problem))
    reached = executor.reached[0].astype(np.int32)
    prefixes = commitments(problem, plan, released.astype(np.int32), reached, ready, now + int(random.integers(0, 10)))
    goals = problem.goals
    if random.random() < 0.5:
        goals = tuple(goals[robot] for robot in random.permutation(len(goals)))
    changed = attrs.evolve(problem, commitments=prefixes, goals=goals)
    changed = attrs.evolve(changed, features=features_of(changed) | problem.features & {Feature.FOOTPRINTS})
    if not check_plan(attrs.evolve(changed, goals=((),) * len(problem)), Plan(paths=prefixes)).valid:
        return None
    if planner is None:
        return changed, wander(changed, random, list(prefixes), ticks=5)
    found = planner.plan(changed, BUDGET).plan if planner.skip(changed) is None else None
    return None if found is None else (changed, found)


def execute(problem, plan, planner, dispatcher, delays, situation, period, replans, random):
    """Execute a plan many times; return the kind of session, the number of new plans, the executor and the faults."""
    session = dispatcher.start(problem, plan)
    executor, changes = BatchExecutor(problem, plan, period, random), 0
    if delays.worst_case:
        adversary = Adversary(problem, plan, delays.worst_case * delays.tick)
    drawn = DrawnDelays(delays, len(problem), Seeds(situation, 0), [0])
    for step in sorted(random.integers(1, 30, replans).tolist()):
        releasing = Copies([session], executor, changes, random)
        proceed(releasing, executor, drawn, [adversary] if delays.worst_case else [], step)
        if executor.drained.all() or releasing.orders[0] is None:
            continue
        released = releasing.orders[0].released
        if (found := replanned(executor.problem, executor.plan, planner, released, executor, random)) is None:
            continue
        try:
            session.adopt(*found)
        except DispatchError:
            continue
        executor.adopt(*found)
        changes += 1
    one = executor.drained.all() or not (delays.p_delay or delays.speed)  # any other draw is the same
    slow = one or any(field.name == "max_deterministic_time" for field in attrs.fields(type(dispatcher)))
    at_once = None if slow else session.batch(DRAWS["at once"])
    kind = "at once" if at_once is not None else "copied" if not slow and session.copied() is not None else "slow"
    executor.times(DRAWS[kind])
    if at_once is not None:
        releasing = AtOnce(at_once, executor)
    else:
        sessions = [session, *(session.copied() for _ in range(DRAWS[kind] - 1))]
        releasing = Copies(sessions, executor, changes, random)
    drawn = DrawnDelays(delays, len(problem), Seeds(situation, 1), range(DRAWS[kind]))
    adversaries = [copy.deepcopy(adversary) for _ in range(DRAWS[kind])] if delays.worst_case else []
    proceed(releasing, executor, drawn, adversaries, int(LIMIT / period))
    faults = dict(meetings(executor))
    for execution, manager in enumerate(getattr(releasing, "managers", ())):
        if manager is not None and manager.fault is not None:
            faults.setdefault(execution, manager.fault)
    return kind, changes, executor, faults


def situations(named, seed, first):
    """Kind of delay and of problem, planner, problem, plan and random numbers, one situation after another."""
    table = [*itertools.product(DELAYS, [*itertools.product(named, PROBLEMS), *(("chance", it) for it in CHANCE)])]
    table += [(delay, ("chance", it)) for delay in DELAYS for it in CHANCE] * (len(table) // 160)
    np.random.default_rng(0).shuffle(table)
    for situation in itertools.count(first):
        delay, (planner, kind) = table[situation % len(table)]
        random = np.random.default_rng([seed, situation])
        if planner == "chance":
            problem, plan = CHANCE[kind](random)
        else:
            problem = PROBLEMS[kind](random)
            plan = named[planner].plan(problem, BUDGET).plan if named[planner].skip(problem) is None else None
        yield situation, delay, planner, kind, problem, plan, random


def run(executions, seed, first=0):
    """Print the faults of so many executions from a situation on, and how all ended; return the number of faults."""
    named, given = planners(), components("dispatchers")
    ended, faults, number = Counter(), 0, 0
    for situation, delay, planner, kind, problem, plan, random in situations(named, seed, first):
        if number >= executions:
            break
        if plan is None:
            ended["no plan"] += 1
            continue
        ended["plans"] += 1
        period = problem.roadmap.tick * float(random.choice([0.25, 0.5, 1.0]))
        replans = int(random.integers(1, 4)) if problem.rules.at_goal == "stay" and random.random() < 0.5 else 0
        for name, dispatcher in dispatchers(given, np.random.default_rng([seed, situation, 1])):
            where = f"{kind}, {planner}, {name}, delays {delay}, seed [{seed}, {situation}]"
            own = np.random.default_rng([seed, situation, 2])
            by_the_clock = name in BY_THE_CLOCK
            settings = DELAYS[delay], situation, period, 0 if by_the_clock else replans
            try:
                how, changes, executor, met = execute(problem, plan, named.get(planner), dispatcher, *settings, own)
            except DispatchError as refusal:
                ended[f"{name} refuses: {' '.join(str(refusal).split()[-4:])}"] += 1
                continue
            drained = executor.drained
            wrong = {} if by_the_clock else met
            wrong |= dict.fromkeys(np.flatnonzero(~drained).tolist(), "robots do not arrive")
            if wrong:
                faults += len(wrong)
                execution, what = min(wrong.items())
                print(f"{where}: {what} (execution {execution}, {len(wrong)} of {len(drained)})", flush=True)
            after = f", after {changes} new plans" if changes else ""
            ended[f"{name}, {how}{after}"] += len(drained)
            number, before = number + len(drained), number
            if number // 10_000 > before // 10_000:
                print(f"# {number} executions, {faults} faults, before situation {situation}", flush=True)
    for what, count in sorted(ended.items()):
        print(f"{what:70} {count:10}")
    print(f"{number} executions of seed {seed} before situation {situation}: {faults} faults", flush=True)
    return faults


if __name__ == "__main__":
    sys.exit(run(*map(int, sys.argv[1:])) > 0)
