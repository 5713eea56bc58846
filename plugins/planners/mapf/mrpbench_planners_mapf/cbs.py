"""Conflict-based search: optimal plans."""

from typing import ClassVar

import attrs
from mrpbench_native import mapf

from mrpbench_core.api.component import option
from mrpbench_core.api.planner import Promise
from mrpbench_core.model.plan import Budget, PlanResult
from mrpbench_core.model.problem import Problem
from mrpbench_planners_mapf.native import solve
from mrpbench_planners_mapf.techniques import Techniques, heuristic_option


@attrs.frozen(kw_only=True)
class Cbs(Techniques):
    """Conflict-based search (Sharon et al., AIJ 2015): the least sum of costs.

    Optimal among plans in which every edge is crossed in exactly its duration, so robots wait at vertices only. On
    timeout `lower_bound` is what was proved until then. An instance without a solution that is not seen at once (say, a
    swap in a dead end) runs until the budget is spent. The options switch single techniques off, for ablations.
    """

    promises: ClassVar[frozenset[Promise]] = frozenset(
        {Promise.CONFLICT_FREE, Promise.OPTIMAL, Promise.COMPLETE, Promise.DETERMINISTIC}
    )

    heuristic: bool = heuristic_option()
    assign: bool = option(
        False,
        help="Also decide which robot does which task: the least sum of costs over all assignments. What keeps two "
        "robots from one task is that they stay there; where they disappear, take ita_cbs or cbs_ta.",
    )

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        techniques = {name: value for name, value in attrs.asdict(self).items() if name != "assign"}
        return solve(problem, budget, mapf.cbs, **techniques)

    def skip(self, problem: Problem) -> str | None:
        """See `Planner.skip`; also, with `assign`, robots that disappear at their goals."""
        if self.assign and problem.rules.at_goal == "disappear":
            return "cannot `assign` where robots disappear at their goals; ita_cbs and cbs_ta can"
        return super().skip(problem)
