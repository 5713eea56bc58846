"""Thousands of random small instances: every choice of techniques of `cbs` against the joint-space oracle.

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
from mrpbench_planners_mapf.cbs import Cbs
from test_cbs import ABLATIONS

from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.plan import Budget, PlanStatus
from mrpbench_core.model.problem import Problem

PLANNERS = (Cbs(), *ABLATIONS)
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


def faults(asked: Problem, optimum: float | None, planner: Cbs) -> tuple[PlanStatus, list[str]]:
    """How `planner` ended, and what is wrong with that."""
    result = planner.plan(asked, HOPELESS if optimum == math.inf else BUDGET)
    found = []
    if result.status is PlanStatus.SOLVED:
        report = check_plan(asked, result.plan)
        cost = result.plan.sum_of_costs
        found += [f"{report.faults} {report.conflicts}"] * (not report.valid)
        found += [f"cost {cost}, lower bound {result.lower_bound}"] * (result.lower_bound != cost)
        found += [f"cost {cost}, optimum {optimum}"] * (optimum not in (None, cost))
    elif optimum is not None:
        found += [f"unsolvable, optimum {optimum}"] * (result.status is PlanStatus.UNSOLVABLE and optimum < math.inf)
        found += [f"lower bound {result.lower_bound}, optimum {optimum}"] * (result.lower_bound > optimum)
    return result.status, found


def main(count: int, seed: int) -> int:
    """Print what is wrong; the number of faults."""
    wrong, statuses = 0, Counter[tuple[str, str]]()
    for number in range(count):
        kind, draw = list(KINDS.items())[number % len(KINDS)]
        asked = draw(np.random.default_rng([seed, number]))
        try:
            optimum = least_cost(asked, limit=3000)
        except TooLargeError:
            optimum = None
        for planner in PLANNERS:
            status, found = faults(asked, optimum, planner)
            statuses[kind, str(status)] += 1
            wrong += len(found)
            for fault in found:
                print(f"{kind}, seed [{seed}, {number}], {planner}: {fault}", flush=True)
    for (kind, status), times in sorted(statuses.items()):
        print(f"{kind:20} {status:14} {times:8}")
    print(f"{count} instances, {wrong} faults")
    return wrong


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2])) > 0)
