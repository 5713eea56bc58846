"""Priority inheritance with backtracking: a plan for thousands of robots in little time, or none."""

from typing import ClassVar

import attrs
from mrpbench_native import mapf

from mrpbench_core.api.component import option
from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.model.plan import Budget, PlanResult
from mrpbench_core.model.problem import Problem
from mrpbench_planners_mapf.native import solve
from mrpbench_planners_mapf.seeds import seed_option
from mrpbench_planners_mapf.unit_moves import no_unit_moves


@attrs.frozen(kw_only=True)
class Pibt(Planner):
    """Tick by tick every robot goes where those of higher priority leave room (Okumura et al., AIJ 2022).

    For roadmaps on which every move takes one tick. Incomplete: robots may go round in circles, so it gives up after
    `steps` ticks. With `swap`, two robots that meet in a narrow passage change places where that is possible (Okumura,
    IJCAI 2023).
    """

    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.DETERMINISTIC})

    swap: bool = option(True, help="Let robots change places in narrow passages.")
    steps: int = option(
        0,
        help="Ticks after which to give up; 0: twice as many as the roadmap has vertices, and a thousand.",
        validator=attrs.validators.ge(0),
    )
    seed: int | None = seed_option("Seed of the choice between equally good vertices")

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        return solve(problem, budget, mapf.pibt, **attrs.asdict(self))

    def skip(self, problem: Problem) -> str | None:
        """See `Planner.skip`; also robots that disappear at their goals."""
        return super().skip(problem) or no_unit_moves(problem)
