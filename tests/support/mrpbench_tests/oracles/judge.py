"""Judges what a planner answers: what the engine says about it, and what only an optimum or another answer shows."""

import math
from collections.abc import Sequence

from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.model.planning.plan import Budget, PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.referee.plans import Promises, judge_plan
from mrpbench_core.testing.faults import require
from mrpbench_tests.oracles.optimum import least_sum_of_costs

ENDED_BY_LIMITS = (PlanStatus.TIMEOUT, PlanStatus.OUT_OF_MEMORY)
BUDGET = Budget(wall_s=0.2, memory_bytes=1 << 30)
"""For many drawn problems, of which some have no plan and no proof of that."""
AMPLE = Budget(wall_s=20, memory_bytes=1 << 30)
"""For problems that the planner is known to solve."""


def ask(planner: Planner, problem: Problem, optimum: float | None = None, budget: Budget = BUDGET) -> PlanResult:
    """The planner's answer, without faults.

    Raises:
        Fault: the planner skips the problem, its answer has a fault (see `answer_faults`), or it ran out of memory.
    """
    reason = planner.skip(problem)
    require(reason is None, f"{planner} is asked a problem that it skips, because it {reason}")
    result = planner.plan(problem, budget)
    found = answer_faults(problem, planner, result, optimum)
    require(not found, f"{planner}: {'; '.join(found)}")
    require(result.status is not PlanStatus.OUT_OF_MEMORY, f"{planner} ran out of memory")
    return result


def compare_with_optimum(planner: Planner, problem: Problem, most_states: int = 2000) -> PlanStatus | None:
    """Return the status of the planner, with the optimum by brute force; None if the planner skips the problem.

    Raises:
        Fault: see `ask`.
    """
    if planner.skip(problem) is not None:
        return None
    return ask(planner, problem, least_sum_of_costs(problem, most_states, assign=planner.assigns)).status


def answer_faults(problem: Problem, planner: Planner, result: PlanResult, optimum: float | None = None) -> list[str]:
    """Return the faults of a result, one sentence each.

    Args:
        problem: what the planner was asked.
        planner: promises what the answer must hold.
        result: the answer.
        optimum: the least sum of costs, inf if there is no plan, None if it is not known.
    """
    _, broken = judge_plan(Promises.of(planner), problem, result)
    found = [] if broken is None else [broken]
    if result.status is PlanStatus.GAVE_UP and Promise.COMPLETE in planner.promises:
        found.append("gave up, but promises to be complete")
    if result.plan is not None and Promise.BOUNDED in planner.promises and math.isnan(result.lower_bound):
        found.append("promises to be bounded, but proves no lower bound")
    costs = [point.cost for point in result.history]
    if costs != sorted(costs, reverse=True):
        found.append(f"the costs of its history rise: {costs}")
    return found if optimum is None else [*found, *_optimum_faults(planner, result, optimum)]


def _optimum_faults(planner: Planner, result: PlanResult, optimum: float) -> list[str]:
    """Return the contradictions of the result to the optimum."""
    found = []
    if result.status is PlanStatus.UNSOLVABLE and optimum < math.inf:
        found.append(f"says unsolvable, the optimum is {optimum:g}")
    if result.lower_bound > optimum:
        found.append(f"proves the lower bound {result.lower_bound:g}, the optimum is {optimum:g}")
    if result.plan is None or Promise.CONFLICT_FREE not in planner.promises:
        return found
    cost = result.plan.sum_of_costs
    if cost < optimum or (cost > optimum and Promise.OPTIMAL in planner.promises):
        found.append(f"costs {cost}, the optimum is {optimum:g}")
    return found


def contradictions(answers: Sequence[tuple[Planner, PlanResult]]) -> list[str]:
    """Return the contradictions between the results of several planners for one problem, one sentence each."""
    costs = {
        planner: result.plan.sum_of_costs
        for planner, result in answers
        if result.plan is not None and Promise.CONFLICT_FREE in planner.promises
    }
    if not costs:
        return []
    least, best = min((cost, repr(planner)) for planner, cost in costs.items())
    found = []
    for planner, result in answers:
        if result.status is PlanStatus.UNSOLVABLE:
            found.append(f"{planner} says unsolvable, but {best} has a plan")
        if result.lower_bound > least:
            bound = result.lower_bound
            found.append(f"{planner} proves the lower bound {bound:g}, but {best} has a plan of cost {least}")
    return found


def changes(problem: Problem, planner: Planner, budget: Budget, result: PlanResult) -> list[str]:
    """Return the differences between two calls, unless a limit ended one or the planner promises nothing."""
    if Promise.DETERMINISTIC not in planner.promises or _ended_by_limits(result):
        return []
    again = planner.plan(problem, budget)
    if _ended_by_limits(again) or again == result:
        return []
    return [f"answers {again} after {result}"]


def _ended_by_limits(result: PlanResult) -> bool:
    return result.clock_bound or result.status in ENDED_BY_LIMITS
