"""LaCAM*: a plan within milliseconds, and better ones until the budget is spent."""

from typing import ClassVar

import attrs
from mrpbench_native import mapf

from mrpbench_core.api.component import option
from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.model.plan import Budget, PlanResult
from mrpbench_core.model.problem import Problem
from mrpbench_planners_mapf.native import solve
from mrpbench_planners_mapf.objective import Objective, objective_option
from mrpbench_planners_mapf.seeds import seed_option
from mrpbench_planners_mapf.unit_moves import no_unit_moves


@attrs.frozen(kw_only=True)
class Lacam(Planner):
    """Depth first over configurations of all robots (Okumura, AAAI 2023, IJCAI 2023), then improvement.

    For roadmaps on which every move takes one tick. Complete: `unsolvable` means that it has seen every configuration.
    The plan is improved by a second one, made by planning the robots in turn, nearest first (`prioritized`), or where
    there is no room for that, along ways that keep clear of one another (`guides`; Okumura, AAMAS 2024; in a crowd, by
    chance), by going on with the search (`star`) and by planning groups anew (`neighbourhoods`), until nothing can
    become better, `limits.iterations` are done, or the time is over. The result is optimal, and `lower_bound` says so,
    once all better configurations are ruled out, which happens with a handful of robots only.
    """

    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.COMPLETE, Promise.DETERMINISTIC})

    objective: Objective = objective_option()
    swap: bool = option(True, help="Let robots change places in narrow passages (else the first plan may take long).")
    prioritized: bool = option(
        True, help="After the first plan look for one by planning robots in turn, nearest first."
    )
    guides: bool = option(
        True,
        help="If that fails, look for one along ways that keep clear of one another; in a crowd, where there are none, "
        "for further first plans, by chance.",
    )
    star: bool = option(True, help="After the first plan go on searching configurations.")
    neighbourhoods: bool = option(True, help="After the first plan improve it by large neighbourhood search.")
    seed: int | None = seed_option("Seed of all random choices")

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        return solve(problem, budget, mapf.lacam, **attrs.asdict(self), iterations=budget.iterations)

    def skip(self, problem: Problem) -> str | None:
        """See `Planner.skip`; also robots that disappear at their goals."""
        return super().skip(problem) or no_unit_moves(problem)
