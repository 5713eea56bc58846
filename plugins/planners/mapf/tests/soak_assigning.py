"""Thousands of random small instances: planners that assign against all assignments in the joint-space oracle.

`make soak` runs it; `python soak_assigning.py COUNT SEED` prints every instance on which something is wrong, and what
became of all of them. Where the oracle takes too long, the planners are still compared with one another.
"""

import math
import sys
from collections import Counter

import numpy as np
from mapf_instances import with_candidates
from mapf_oracle import TooLargeError, least_cost_assigned
from mrpbench_planners_mapf.cbs_ta import CbsTa, ItaCbs
from mrpbench_planners_mapf.ecbs_ta import EcbsTa, ItaEcbs
from soak_cbs import BUDGET, HOPELESS, KINDS

from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.plan import PlanResult, PlanStatus
from mrpbench_core.model.problem import Problem

NAMES = ("prioritize", "bypass", "target", "corridor", "rectangle")
BOUNDS = (1.0, 1.05, 1.2, 1.5)


def drawn_planners(random: np.random.Generator) -> list[Planner]:
    """All four as they come, and all four with techniques left out at random."""
    some = {name: bool(random.random() < 0.5) for name in NAMES}
    w = float(random.choice(BOUNDS))
    return [
        CbsTa(),
        ItaCbs(),
        EcbsTa(w=w),
        ItaEcbs(w=w),
        CbsTa(heuristic=bool(random.random() < 0.5), **some),
        ItaCbs(**some),
        EcbsTa(w=w, **some),
        ItaEcbs(w=w, **some),
    ]


def faults(asked: Problem, optimum: float | None, planner: Planner, result: PlanResult) -> list[str]:
    """What is wrong with a result."""
    if result.status is not PlanStatus.SOLVED:
        if optimum is None:
            return []
        found = [f"unsolvable, optimum {optimum}"] * (result.status is PlanStatus.UNSOLVABLE and optimum < math.inf)
        return found + [f"lower bound {result.lower_bound}, optimum {optimum}"] * (result.lower_bound > optimum)
    report = check_plan(asked, result.plan)
    cost, bound = result.plan.sum_of_costs, result.lower_bound
    paths = zip(result.plan.paths, asked.start.tolist(), strict=True)
    ends = {int(path.vertices(asked.roadmap, start)[-1]) for path, start in paths}
    w = 1.0 if Promise.OPTIMAL in planner.promises else planner.w
    found = [f"{report.faults} {report.conflicts}"] * (not report.valid)
    found += ["two robots at one goal"] * (len(ends) < len(asked))
    found += [f"cost {cost}, lower bound {bound}"] * (cost > w * bound + 1e-9)
    return found + [f"cost {cost}, lower bound {bound}, optimum {optimum}"] * (
        optimum is not None and not bound <= optimum <= cost
    )


def main(count: int, seed: int) -> int:
    """Print what is wrong; the number of faults."""
    wrong, statuses = 0, Counter[tuple[str, str]]()
    for number in range(count):
        kind, draw = list(KINDS.items())[number % len(KINDS)]
        random = np.random.default_rng([seed, number])
        asked = with_candidates(random, draw(random))
        try:
            optimum = least_cost_assigned(asked, limit=2000)
        except TooLargeError:
            optimum = None
        for planner in drawn_planners(random):
            result = planner.plan(asked, HOPELESS if optimum == math.inf else BUDGET)
            if optimum is None and result.status is PlanStatus.SOLVED and Promise.OPTIMAL in planner.promises:
                optimum = result.plan.sum_of_costs
            statuses[kind, str(result.status)] += 1
            for fault in faults(asked, optimum, planner, result):
                wrong += 1
                print(f"{kind}, seed [{seed}, {number}], {planner}: {fault}", flush=True)
    for (kind, status), times in sorted(statuses.items()):
        print(f"{kind:20} {status:14} {times:8}")
    print(f"{count} instances, {wrong} faults")
    return wrong


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2])) > 0)
