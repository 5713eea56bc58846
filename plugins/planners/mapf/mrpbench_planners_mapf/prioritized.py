"""Cooperative planning in priority order by safe interval path planning."""

from typing import ClassVar, Literal, get_args

import attrs
from mrpbench_native import mapf

from mrpbench_core.api.component import option
from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.model.plan import Budget, PlanResult
from mrpbench_core.model.problem import Feature, Problem
from mrpbench_planners_mapf.native import SUPPORTED, solve
from mrpbench_planners_mapf.seeds import seed_option

Order = Literal["index", "longest_first", "shortest_first", "random"]


@attrs.frozen(kw_only=True)
class Prioritized(Planner):
    """One robot after another, each on its earliest path around those before it.

    Fast, but incomplete: when some robot finds no path, the robot goes to the front and all are planned again, up to
    `restarts` times (an order that was tried before is shuffled). From the hundredth restart on some robots also start
    late, by chance: robots that park in one another's way can be planned in no order otherwise. After all restarts the
    planner gives up, and `statistics["failed_robot"]` names the robot. `lower_bound` is what the robots would cost if
    each were alone.
    """

    supports: ClassVar[frozenset[Feature]] = SUPPORTED | {Feature.RESOURCES}
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.DETERMINISTIC})

    order: Order = option(
        "longest_first",
        help="Who plans first: index (the order of the fleet), longest_first or shortest_first (by the distance to "
        "the goal), random.",
        validator=attrs.validators.in_(get_args(Order)),
    )
    restarts: int = option(1000, help="Further orders to try after a failure.", validator=attrs.validators.ge(0))
    seed: int | None = seed_option("Seed of random orders and late starts")

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        return solve(problem, budget, mapf.prioritized, **attrs.asdict(self))
