"""Priority-based search: who plans before whom is decided conflict by conflict."""

from typing import ClassVar

import attrs
from mrpbench_native import mapf

from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.model.plan import Budget, PlanResult
from mrpbench_core.model.problem import Feature, Problem
from mrpbench_planners_mapf.native import SUPPORTED, solve


@attrs.frozen(kw_only=True)
class Pbs(Planner):
    """Depth first over partial orders of robots, each of which plans around those before it (Ma et al., AAAI 2019).

    Often near the optimum and far faster; incomplete, since some problems have no solution by any priorities: then it
    gives up. `lower_bound` is what the robots would cost if each were alone.
    """

    supports: ClassVar[frozenset[Feature]] = SUPPORTED | {Feature.RESOURCES}
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.DETERMINISTIC})

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        return solve(problem, budget, mapf.pbs)
