"""Conflict-based search that also assigns: optimal over all assignments."""

from typing import ClassVar

import attrs
from mrpbench_native import mapf

from mrpbench_core.api.planner import Promise
from mrpbench_core.model.plan import Budget, PlanResult
from mrpbench_core.model.problem import Problem
from mrpbench_planners_mapf.native import solve
from mrpbench_planners_mapf.techniques import AssigningTechniques, heuristic_option

OPTIMAL = frozenset({Promise.CONFLICT_FREE, Promise.OPTIMAL, Promise.COMPLETE, Promise.DETERMINISTIC})


@attrs.frozen(kw_only=True)
class CbsTa(AssigningTechniques):
    """CBS-TA (Hönig et al., AAMAS 2018): the least sum of costs over all assignments of robots to different goals.

    A constraint tree for each assignment, the cheapest assignment first, the next one only when nothing cheaper is
    left. `statistics["assignments"]` counts them. Where very many assignments cost the same, `ita_cbs` is far faster.
    """

    promises: ClassVar[frozenset[Promise]] = OPTIMAL

    heuristic: bool = heuristic_option()

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        return solve(problem, budget, mapf.cbs, goal_choice="ranked", **attrs.asdict(self))


@attrs.frozen(kw_only=True)
class ItaCbs(AssigningTechniques):
    """ITA-CBS (Tang, Ren, Li and Sycara, MRS 2023): the same as `cbs_ta` from a single constraint tree.

    Every node has the cheapest assignment under its own constraints, repaired from that of its parent by the dynamic
    Hungarian algorithm. Costs are planned only for goals to which robots are sent; until then lower bounds stand for
    them. `statistics["assignments"]` counts the repairs, and one.
    """

    promises: ClassVar[frozenset[Promise]] = OPTIMAL

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        return solve(problem, budget, mapf.cbs, goal_choice="by_node", heuristic=False, **attrs.asdict(self))
