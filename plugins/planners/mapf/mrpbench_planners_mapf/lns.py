"""Large neighbourhood search: groups of robots are planned anew, for fewer conflicts and then for less cost."""

from typing import ClassVar, Literal, get_args

import attrs
from mrpbench_native import mapf

from mrpbench_core.api.component import option
from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.model.plan import Budget, PlanResult
from mrpbench_core.model.problem import Feature, Problem
from mrpbench_planners_mapf.native import SUPPORTED, solve
from mrpbench_planners_mapf.objective import Objective, objective_option
from mrpbench_planners_mapf.seeds import seed_option

Initial = Literal["repair", "lacam", "either"]


@attrs.frozen(kw_only=True)
class Lns(Planner):
    """First a plan by repairing one with conflicts (Li et al., AAAI 2022), then better ones (Li et al., IJCAI 2021).

    Improves until all robots arrive as early as if alone, `limits.iterations` groups were planned anew, or the
    time is over. Incomplete where the first plan comes from repairing alone.
    """

    supports: ClassVar[frozenset[Feature]] = SUPPORTED
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.DETERMINISTIC})

    objective: Objective = objective_option()
    initial: Initial = option(
        "either",
        help="Where the first plan comes from: repair, lacam (where every move takes one tick; elsewhere repair), or "
        "either: lacam, then repair for a while, and the cheaper of the two.",
        validator=attrs.validators.in_(get_args(Initial)),
    )
    neighbourhood: int | None = option(
        None,
        help="Robots that are planned anew at a time; without it 8 while repairing, then 1 to 32, as brings most.",
        validator=attrs.validators.optional(attrs.validators.ge(1)),
    )
    seed: int | None = seed_option("Seed of all random choices")

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        return solve(problem, budget, mapf.lns, **attrs.asdict(self), iterations=budget.iterations)
