"""Bounded-suboptimal conflict-based search that also assigns: at most `w` times the least over all assignments."""

from typing import Any, ClassVar

import attrs
from mrpbench_native import mapf

from mrpbench_core.api.planner import Promise
from mrpbench_core.model.plan import Budget, PlanResult
from mrpbench_core.model.problem import Problem
from mrpbench_planners_mapf.bounded import PROMISES, bound_option
from mrpbench_planners_mapf.native import solve
from mrpbench_planners_mapf.techniques import AssigningTechniques

FOCAL: dict[str, Any] = {
    "selection": "focal",
    "heuristic": False,  # raises lower bounds, which a focal list hardly ever waits for
    "flex": False,
    "incumbent_after": None,  # it keeps to one assignment
    "distance_weight": 1.2,
    "conflict_weight": 20.0,
}


@attrs.frozen(kw_only=True)
class EcbsTa(AssigningTechniques):
    """ECBS-TA (Hönig et al., AAMAS 2018): as `cbs_ta`, but a sum of costs of at most `w` times `lower_bound`.

    Focal lists in the trees and in the search for one robot, as `ecbs`; another assignment is tried when all that is
    known of the others has more conflicts or may cost too much.
    """

    promises: ClassVar[frozenset[Promise]] = PROMISES

    w: float = bound_option()

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        return _solve(self, problem, budget, "ranked")


@attrs.frozen(kw_only=True)
class ItaEcbs(AssigningTechniques):
    """ITA-ECBS (Tang, Koenig and Li, SoCS 2024): as `ita_cbs`, but a sum of costs of at most `w` times `lower_bound`.

    Every node has the assignment that is cheapest by the lower bounds of its robots' costs.
    """

    promises: ClassVar[frozenset[Promise]] = PROMISES

    w: float = bound_option()

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        return _solve(self, problem, budget, "by_node")


def _solve(planner: EcbsTa | ItaEcbs, problem: Problem, budget: Budget, goal_choice: str) -> PlanResult:
    return solve(problem, budget, mapf.bounded_cbs, goal_choice=goal_choice, **FOCAL, **attrs.asdict(planner))
