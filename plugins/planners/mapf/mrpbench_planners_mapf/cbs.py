"""Conflict-based search: optimal plans."""

from typing import ClassVar

from mrpbench_core.api.component import option
from mrpbench_core.api.planner import Promise
from mrpbench_core.model.planning.problem import Problem
from mrpbench_planners_mapf.conflict_based import OPTIMAL, ConflictBased
from mrpbench_planners_mapf.recipe import native_planner


@native_planner("cbs")
class Cbs(ConflictBased):
    """Conflict-based search (Sharon et al., AIJ 2015): the least sum of costs.

    Optimal among plans in which every edge is crossed in exactly its duration, so robots wait at vertices only. After
    a timeout `lower_bound` is what was proved until then. An instance whose lack of a solution is not found out at
    once (for example, a swap in a dead end) runs until the budget is spent. The options switch single techniques off,
    for ablations.
    """

    promises: ClassVar[frozenset[Promise]] = OPTIMAL

    assign: bool = option(
        False,
        help="Also decides which robot does which task: the least sum of costs over all assignments. Robots take "
        "different tasks because they stay at their goals; where they disappear, use ita_cbs or cbs_ta.",
    )

    def skip(self, problem: Problem) -> str | None:
        """See `Planner.skip`; also, with `assign`, robots that disappear at their goals."""
        if self.assign and problem.rules.at_goal == "disappear":
            return "cannot `assign` where robots disappear at their goals; ita_cbs and cbs_ta can"
        return super().skip(problem)
