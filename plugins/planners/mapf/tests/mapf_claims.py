"""What a planner's answer claims, and whether that is so: the one judge of tests and soaks."""

import math
from collections.abc import Sequence

from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.checking.assignment import check_choice
from mrpbench_core.checking.plan import check_plan, path_fault
from mrpbench_core.model.plan import Budget, Plan, PlanResult, PlanStatus
from mrpbench_core.model.problem import Problem

ENDED_BY_LIMITS = (PlanStatus.TIMEOUT, PlanStatus.OUT_OF_MEMORY)
BUDGET = Budget(wall_s=0.2, memory_bytes=1 << 30)
AMPLE = Budget(wall_s=20, memory_bytes=1 << 30)


def ask(planner: Planner, asked: Problem, optimum: float | None = None, budget: Budget = BUDGET) -> PlanResult:
    """What a planner answers within a budget of ample memory; nothing may be wrong with it."""
    result = planner.plan(asked, budget)
    found = faults(asked, planner, result, optimum)
    assert not found, f"{planner}: {found}"
    assert result.status is not PlanStatus.OUT_OF_MEMORY, planner
    return result


def faults(asked: Problem, planner: Planner, result: PlanResult, optimum: float | None = None) -> list[str]:
    """What is wrong with an answer; `optimum` is the least sum of costs, inf if there is no plan, None if unknown."""
    found = []
    if (result.plan is not None) != (result.status is PlanStatus.SOLVED):
        found.append(f"{result.status} {'with a' if result.plan else 'without'} plan")
    if result.status is PlanStatus.GAVE_UP and Promise.COMPLETE in planner.promises:
        found.append("gave up, although complete")
    if result.plan is not None:
        found += _plan_faults(asked, planner, result, result.plan)
    if optimum is None:
        return found
    if result.status is PlanStatus.UNSOLVABLE and optimum < math.inf:
        found.append(f"unsolvable, optimum {optimum}")
    if result.lower_bound > optimum:
        found.append(f"lower bound {result.lower_bound}, optimum {optimum}")
    if result.plan is not None and Promise.CONFLICT_FREE in planner.promises and result.plan.sum_of_costs < optimum:
        found.append(f"cost {result.plan.sum_of_costs}, optimum {optimum}")
    return found


def _plan_faults(asked: Problem, planner: Planner, result: PlanResult, plan: Plan) -> list[str]:
    """Paths that are none, conflicts, and costs above what was promised."""
    found = []
    if Promise.CONFLICT_FREE in planner.promises:
        report = check_plan(asked, plan)
        found += [f"{report.faults} {report.conflicts}"] * (not report.valid)
    else:
        wrong = [path_fault(asked, robot, path) for robot, path in enumerate(plan.paths)]
        found += [f"robot {robot}: {fault}" for robot, fault in enumerate(wrong) if fault]
    cost, bound = plan.sum_of_costs, result.lower_bound
    found += [f"cost {cost}, lower bound {bound}"] * (cost < bound)
    if Promise.OPTIMAL in planner.promises:
        found += [f"cost {cost}, but optimal, and lower bound {bound}"] * (cost != bound)
    if Promise.BOUNDED in planner.promises:
        w = getattr(planner, "w", math.nan)
        found += [f"cost {cost}, more than {w} times lower bound {bound}"] * (not cost <= w * bound + 1e-9)
    if planner.assigns:
        found += check_choice(asked, plan)
    curve = [point.cost for point in result.history]
    found += [f"the costs {curve} rise"] * (curve != sorted(curve, reverse=True))
    return found


def contradictions(answers: Sequence[tuple[Planner, PlanResult]]) -> list[str]:
    """What cannot be true together of the answers of several planners to one question."""
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
            found.append(f"{planner}: unsolvable, but {best} has a plan")
        if result.lower_bound > least:
            found.append(f"{planner}: lower bound {result.lower_bound}, but {best} has a plan of cost {least}")
    return found


def changes(asked: Problem, planner: Planner, budget: Budget, result: PlanResult) -> list[str]:
    """How another call differs from the first, unless the clock ended one of them or nothing is promised."""
    if Promise.DETERMINISTIC not in planner.promises or _by_limits(result):
        return []
    again = planner.plan(asked, budget)
    if _by_limits(again) or again == result:
        return []
    return [f"another call gives {again} after {result}"]


def _by_limits(result: PlanResult) -> bool:
    return result.clock_bound or result.status in ENDED_BY_LIMITS
