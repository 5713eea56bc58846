"""Conflict-based search: optimal plans."""

from typing import ClassVar

import attrs
from mrpbench_native import mapf

from mrpbench_core.api.component import option
from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.model.plan import Budget, PlanResult
from mrpbench_core.model.problem import Feature, Problem
from mrpbench_planners_mapf.native import SUPPORTED, solve


@attrs.frozen(kw_only=True)
class Cbs(Planner):
    """Conflict-based search (Sharon et al., AIJ 2015): the least sum of costs.

    Optimal among plans in which every edge is crossed in exactly its duration, so robots wait at vertices only. On
    timeout `lower_bound` is what was proved until then. An instance without a solution that is not seen at once (say, a
    swap in a dead end) runs until the budget is spent. The options switch single techniques off, for ablations.
    """

    supports: ClassVar[frozenset[Feature]] = SUPPORTED
    promises: ClassVar[frozenset[Promise]] = frozenset(
        {Promise.CONFLICT_FREE, Promise.OPTIMAL, Promise.COMPLETE, Promise.DETERMINISTIC}
    )

    prioritize: bool = option(
        True, help="Resolve conflicts first that raise the cost either way (Boyarski et al., IJCAI 2015)."
    )
    bypass: bool = option(
        True, help="Take over paths as cheap with fewer conflicts instead of branching (Boyarski et al., ICAPS 2015)."
    )
    heuristic: bool = option(
        True, help="Order nodes by what pairs of robots must still cost (WDG; Li, Felner et al., IJCAI 2019)."
    )
    target: bool = option(
        True, help="Resolve conflicts with robots at their goals by when these arrive (Li et al., AIJ 2021)."
    )
    corridor: bool = option(
        True, help="Let one of two robots that meet in a corridor come later by its length (Li et al., AIJ 2021)."
    )
    rectangle: bool = option(
        True,
        help="Let one of two robots that cross the same region leave it later; needs unit durations and no "
        "footprints (generalised rectangles; Li et al., AIJ 2021).",
    )

    assign: bool = option(
        False, help="Also decide which robot does which task: the least sum of costs over all assignments."
    )

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        techniques = {name: value for name, value in attrs.asdict(self).items() if name != "assign"}
        return solve(
            problem,
            budget,
            lambda instance, wall_s, memory_bytes: mapf.cbs(
                instance, **techniques, wall_s=wall_s, memory_bytes=memory_bytes
            ),
        )
