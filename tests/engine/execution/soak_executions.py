"""Executes plans of every planner with every dispatcher under every model of delays: all robots arrive, and none meet.

`make soak` runs it. `python soak_executions.py EXECUTIONS SEED [FIRST]` prints every execution in which a robot does
not arrive, or in which robots meet although the dispatcher keeps them apart, and counts all of them. The planners and
dispatchers are those that are installed. The exit code is 1 if there are faults.
"""

import itertools
import sys
from collections import Counter
from importlib.metadata import entry_points

import attrs
import numpy as np

from mrpbench_core.api import DispatchError
from mrpbench_core.api.planner import Promise
from mrpbench_core.config.delays import Delays
from mrpbench_core.engine.execution.delays import DelayStream
from mrpbench_core.engine.execution.recorder import Recorder
from mrpbench_core.engine.execution.routes import Router
from mrpbench_core.engine.execution.schedule import Schedule
from mrpbench_core.engine.execution.schedule_loop import ScheduleLoop
from mrpbench_core.engine.execution.worst_case import Adversary
from mrpbench_core.model.planning.plan import Budget
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.testing.fixtures.finished_run import context as finished
from mrpbench_core.testing.instances.kinds import KINDS

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
BY_THE_CLOCK = {"all_at_once", "timed"}
"""Dispatchers that let late robots meet."""


def components(kind):
    """The classes of a kind that are installed, by name."""
    return {entry.name: entry.load() for entry in entry_points(group=f"mrpbench.{kind}")}


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


def arrives(problem, plan, dispatcher, delays, seed, period):
    """Whether all robots arrive, and whether some meet."""
    robots, chunks = len(problem), []
    router = Router(problem, np.full(robots, np.nan), np.full(len(problem.roadmap.edges), np.inf))
    base = finished()
    start = np.column_stack([problem.roadmap.position[problem.start], np.zeros(robots)])
    context = attrs.evolve(
        base,
        problem=problem,
        scenario=attrs.evolve(base.scenario, start=start, start_level=problem.roadmap.level[problem.start]),
        result=attrs.evolve(base.result, plan=plan),
        routes=router(plan),
        period=period,
    )
    adversary = Adversary(problem, plan, delays.worst_case * delays.tick) if delays.worst_case else None
    stream = DelayStream(delays, robots, seed, 0, adversary)
    arrived, _ = ScheduleLoop(Schedule(context, dispatcher), stream, Recorder(0.01, period, chunks.append)).run(LIMIT)
    return arrived, any(len(chunk.get("contact", ())) for chunk in chunks)


def run(executions, seed, first=0):
    """Print the faults of so many executions from a situation on, and how all ended; return the number of faults."""
    named, given = planners(), components("dispatchers")
    table = [*itertools.product(DELAYS, named, KINDS)]
    np.random.default_rng(0).shuffle(table)
    ended, faults, number = Counter(), 0, 0
    for situation in itertools.count(first):
        if number >= executions:
            break
        delay, planner, kind = table[situation % len(table)]
        random = np.random.default_rng([seed, situation])
        problem, period = KINDS[kind](random), float(random.choice([0.25, 0.5, 1.0]))
        plan = named[planner].plan(problem, BUDGET).plan if named[planner].skip(problem) is None else None
        if plan is None:
            ended["no plan"] += 1
            continue
        for name, dispatcher in given.items():
            where = f"{kind}, {planner}, {name}, delays {delay}, seed [{seed}, {situation}]"
            try:
                arrived, met = arrives(problem, plan, dispatcher(), DELAYS[delay], situation, period)
            except DispatchError as refusal:
                ended[f"{name} refuses: {' '.join(str(refusal).split()[-4:])}"] += 1
                continue
            apart = Feature.FOOTPRINTS in problem.features and problem.rules.at_goal == "stay"
            if not arrived or (met and apart and name not in BY_THE_CLOCK):
                faults += 1
                print(f"{where}: {'robots meet' if arrived else 'robots do not arrive'}", flush=True)
            ended[f"{name}: drained"] += 1
            number += 1
            if number % 1000 == 0:
                print(f"# {number} executions, {faults} faults", flush=True)
    for what, count in sorted(ended.items()):
        print(f"{what:70} {count:10}")
    print(f"{number} executions of seed {seed} before situation {situation}: {faults} faults", flush=True)
    return faults


if __name__ == "__main__":
    sys.exit(run(*map(int, sys.argv[1:])) > 0)
