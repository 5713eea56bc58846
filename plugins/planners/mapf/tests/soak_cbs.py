"""Thousands of random small instances: every choice of techniques of `cbs`, and drawn ones of `ecbs` and `eecbs` for
all kinds of bounds, against the joint-space oracle.

`make soak` runs it; `python soak_cbs.py COUNT SEED` prints every instance on which something is wrong, and what became
of all of them.
"""

import math
import sys
from collections import Counter
from collections.abc import Callable

import numpy as np
from mapf_instances import random_graph_problem, random_grid_problem, random_rules
from mapf_oracle import TooLargeError, least_cost
from mrpbench_planners_mapf.bounded import Ecbs, Eecbs
from mrpbench_planners_mapf.cbs import Cbs
from test_cbs import ABLATIONS

from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.plan import Budget, PlanStatus
from mrpbench_core.model.problem import Problem

OPTIMAL = (Cbs(), *ABLATIONS)
BOUNDS = (1.0, 1.01, 1.05, 1.1, 1.2, 1.5, 2.0, 5.0)
SWITCHES = ("prioritize", "bypass", "heuristic", "target", "corridor", "rectangle", "flex")
BUDGET = Budget(wall_s=0.3, memory_bytes=1 << 30)
HOPELESS = Budget(wall_s=0.01, memory_bytes=1 << 30)
"""There is no solution, and that cannot always be proved."""

Random = np.random.Generator
KINDS: dict[str, Callable[[Random], Problem]] = {
    "grid": lambda random: random_grid_problem(random, int(random.integers(2, 5)), size=int(random.integers(3, 5))),
    "grid with rules": lambda random: random_grid_problem(
        random, int(random.integers(2, 4)), size=int(random.integers(3, 5)), **random_rules(random)
    ),
    "unit graph": lambda random: random_graph_problem(
        random, int(random.integers(2, 4)), longest=1, at_goal=str(random.choice(["stay", "disappear"]))
    ),
    "graph": lambda random: random_graph_problem(random, int(random.integers(2, 4)), **random_rules(random)),
    "graph, late start": lambda random: random_graph_problem(
        random, 2, ready=random.integers(0, 5, 2), **random_rules(random)
    ),
}


def bounded(random: Random) -> tuple[Ecbs | Eecbs, ...]:
    """Everything switched on, something, and the plain algorithm, each with a bound of its own."""
    one, two, three = random.choice(BOUNDS, 3).tolist()
    some = {name: bool(random.integers(2)) for name in SWITCHES}
    weights = {"distance_weight": random.choice([1.0, 1.2, 3.0]), "conflict_weight": random.choice([0.0, 2.0, 20.0])}
    return Eecbs(w=one), Eecbs(w=two, **some, **{name: float(value) for name, value in weights.items()}), Ecbs(w=three)


def faults(asked: Problem, optimum: float | None, planner: Cbs | Ecbs | Eecbs) -> tuple[PlanStatus, list[str]]:
    """How `planner` ended, and what is wrong with that."""
    result = planner.plan(asked, HOPELESS if optimum == math.inf else BUDGET)
    w = getattr(planner, "w", 1.0)
    found = []
    if result.status is PlanStatus.SOLVED:
        report = check_plan(asked, result.plan)
        cost = result.plan.sum_of_costs
        found += [f"{report.faults} {report.conflicts}"] * (not report.valid)
        found += [f"cost {cost}, lower bound {result.lower_bound}"] * (cost > w * result.lower_bound)
        found += [f"cost {cost}, optimum {optimum}"] * (optimum is not None and cost < optimum)
    elif optimum is not None:
        found += [f"unsolvable, optimum {optimum}"] * (result.status is PlanStatus.UNSOLVABLE and optimum < math.inf)
    if optimum is not None:
        found += [f"lower bound {result.lower_bound}, optimum {optimum}"] * (result.lower_bound > optimum)
    return result.status, found


def main(count: int, seed: int) -> int:
    """Print what is wrong; the number of faults."""
    wrong, statuses = 0, Counter[tuple[str, str, str]]()
    for number in range(count):
        kind, draw = list(KINDS.items())[number % len(KINDS)]
        random = np.random.default_rng([seed, number])
        asked = draw(random)
        try:
            optimum = least_cost(asked, limit=3000)
        except TooLargeError:
            optimum = None
        for planner in (*OPTIMAL, *bounded(random)):
            status, found = faults(asked, optimum, planner)
            statuses[type(planner).__name__, kind, str(status)] += 1
            wrong += len(found)
            for fault in found:
                print(f"{kind}, seed [{seed}, {number}], {planner}: {fault}", flush=True)
    for (name, kind, status), times in sorted(statuses.items()):
        print(f"{name:6} {kind:20} {status:14} {times:8}")
    print(f"{count} instances, {wrong} faults")
    return wrong


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2])) > 0)
