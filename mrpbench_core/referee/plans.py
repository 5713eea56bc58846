"""Judges a plan by what its planner promises."""

import math
from collections.abc import Mapping
from typing import Any, Self

import attrs

from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.checking.assignment import check_choice
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.checking.plan_result import result_fault
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem


@attrs.frozen(kw_only=True)
class Promises:
    """The promises of a planner as it is configured, noted before it is called."""

    made: frozenset[Promise]
    factor: float
    """The sum of costs is at most this times the lower bound, where a bound is promised."""
    assigns: bool
    k: int = 0
    """ticks that each robot may be late without a conflict."""

    @classmethod
    def of(cls, planner: Planner) -> Self:
        """The promises of a planner.

        Raises:
            InputError: it promises something without saying how much.
        """
        kept_promises = frozenset(planner.kept_promises)
        for promise, name in ((Promise.BOUNDED, "suboptimality"), (Promise.ROBUST, "robustness")):
            if promise in kept_promises and getattr(type(planner), name) is getattr(Planner, name):
                raise InputError(
                    f"planner: {type(planner).__name__} promises `{promise}`, so it must override `{name}`"
                )
        return cls(
            made=kept_promises,
            factor=float(planner.suboptimality) if Promise.BOUNDED in kept_promises else 1.0,
            assigns=bool(planner.assigns),
            k=int(planner.robustness) if Promise.ROBUST in kept_promises else 0,
        )

    @classmethod
    def none(cls) -> Self:
        """No promises, as of plans of which nothing else is known."""
        return cls(made=frozenset(), factor=1.0, assigns=False)

    def asked(self, problem: Problem) -> Problem:
        """The problem with the rules that the plan keeps."""
        rules = attrs.evolve(problem.rules, k=self.k)
        return problem if rules == problem.rules else attrs.evolve(problem, rules=rules)

    def message(self) -> dict[str, Any]:
        """The promises as plain data."""
        return {**attrs.asdict(self), "made": sorted(self.made)}

    @classmethod
    def of_message(cls, message: Mapping[str, Any]) -> Self:
        """The promises that another process sent."""
        return cls(**{**message, "made": frozenset(map(Promise, message["made"]))})


def judge_plan(
    promises: Promises, problem: Problem, result: PlanResult, counts: bool = True
) -> tuple[PlanResult, str | None]:
    """Say which promise a plan breaks, or None; with `counts`, count its conflicts in any case.

    Every planner must return valid paths, and one that assigns must give each robot a task of its own. Freedom from
    conflicts, bounds and optimality are required of planners that promise them.
    """
    if fault := result_fault(result):
        return PlanResult(status=PlanStatus.GAVE_UP), fault
    if result.plan is None:
        return result, None if result.status != PlanStatus.SOLVED else "has the status solved but returns no plan"
    searches = counts or Promise.CONFLICT_FREE in promises.made
    report = check_plan(promises.asked(problem), result.plan, None if searches else 0)
    if report.faults:
        return result, report.faults[0]
    if promises.assigns and (shared := check_choice(problem, result.plan)):
        return result, shared[0]
    if result.status == PlanStatus.TIMEOUT:  # but not without a plan: a success that depends on the clock
        result = attrs.evolve(result, status=PlanStatus.SOLVED, clock_bound=True)
    if searches:
        result = attrs.evolve(result, statistics={**result.statistics, "conflicts": float(len(report.conflicts))})
    if report.conflicts and Promise.CONFLICT_FREE in promises.made:
        return result, str(report.conflicts[0])
    if result.plan is not None and not math.isnan(result.lower_bound):
        held, factor = {Promise.BOUNDED, Promise.OPTIMAL} & promises.made, promises.factor
        cost = result.plan.sum_of_costs
        if held and not result.clock_bound and cost > factor * result.lower_bound + 1e-6:
            return result, f"cost {cost} exceeds {factor:g} times its lower bound {result.lower_bound:g}"
        if cost < result.lower_bound - 1e-6:
            return result, f"cost {cost} is below its lower bound {result.lower_bound:g}"
    return result, None
