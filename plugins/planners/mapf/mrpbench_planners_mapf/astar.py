"""Decentralised A*: each robot plans alone, as in the baseline of MRP-Bench."""

from typing import ClassVar, Literal, get_args

import attrs
from mrpbench_native import mapf

from mrpbench_core.api.component import option
from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.model.plan import Budget, PlanResult
from mrpbench_core.model.problem import Feature, Problem
from mrpbench_planners_mapf.native import SUPPORTED, solve

Heuristic = Literal["exact", "zero", "manhattan", "octile", "euclidean"]


@attrs.frozen(kw_only=True)
class Astar(Planner):
    """Shortest path of every robot as if it were alone: the paths may conflict, which the benchmark counts.

    `lower_bound` is the sum of costs of these paths: no conflict-free plan is cheaper.
    """

    supports: ClassVar[frozenset[Feature]] = SUPPORTED | {Feature.RESOURCES}
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.DETERMINISTIC})

    heuristic: Heuristic = option(
        "exact",
        help="Estimate of the ticks to go: exact (true distances), zero, or a distance in metres times the least "
        "ticks per metre of any edge: manhattan, octile, euclidean. All find shortest paths, with different effort.",
        validator=attrs.validators.in_(get_args(Heuristic)),
    )

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`; unsolvable if some robot cannot reach its goal."""
        return solve(problem, budget, mapf.astar, **attrs.asdict(self))
