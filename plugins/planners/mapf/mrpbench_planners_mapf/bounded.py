"""Bounded-suboptimal conflict-based search: plans that cost at most `w` times the least."""

from typing import ClassVar

import attrs
from mrpbench_native import mapf

from mrpbench_core.api.component import option
from mrpbench_core.api.planner import Promise
from mrpbench_core.model.plan import Budget, PlanResult
from mrpbench_core.model.problem import Problem
from mrpbench_planners_mapf.native import solve
from mrpbench_planners_mapf.techniques import ConflictBased, Techniques, heuristic_option

PROMISES = frozenset({Promise.CONFLICT_FREE, Promise.BOUNDED, Promise.COMPLETE, Promise.DETERMINISTIC})


def bound_option() -> float:
    """The option that sets the bound."""
    w: float = option(
        1.2,
        help="The plan costs at most this many times the lower bound; at least 1.",
        validator=attrs.validators.and_(attrs.validators.ge(1.0), attrs.validators.le(1e9)),
    )
    return w


@attrs.frozen(kw_only=True)
class Ecbs(ConflictBased):
    """ECBS (Barer et al., SoCS 2014): a plan whose sum of costs is at most `w` times `lower_bound`.

    Both levels search in a focal list: for one robot the path with the fewest conflicts with the others among those
    that cost at most `w` times its least, in the constraint tree the node with the fewest conflicts among those that
    cost at most `w` times the lower bound.
    """

    promises: ClassVar[frozenset[Promise]] = PROMISES

    w: float = bound_option()

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        return solve(
            problem,
            budget,
            mapf.bounded_cbs,
            selection="focal",
            w=self.w,
            prioritize=False,
            bypass=False,
            heuristic=False,
            target=False,
            corridor=False,
            rectangle=False,
            flex=False,
            incumbent_after=None,
            distance_weight=1.0,
            conflict_weight=0.0,
        )


@attrs.frozen(kw_only=True)
class Eecbs(Techniques):
    """EECBS (Li, Ruml and Koenig, AAAI 2021): as `ecbs`, but the constraint tree is searched by explicit estimation.

    What a solution below a node will cost is estimated from the errors of the steps before; of the nodes that promise a
    solution within the bound the one with the fewest conflicts is next, unless the lower bound has to be raised. The
    options switch single techniques on or off, for ablations.
    """

    promises: ClassVar[frozenset[Promise]] = PROMISES

    w: float = bound_option()
    heuristic: bool = heuristic_option()
    flex: bool = option(
        False, help="Let a robot's path use what the others leave of the common bound (Chan et al., AAAI 2022)."
    )
    incumbent_after: int | None = option(
        100_000,
        help="After so many low-level expansions look for a plan within the bound by large neighbourhood search as "
        "well; null = the plan always comes from the constraint tree, as in the original.",
        validator=attrs.validators.optional(attrs.validators.ge(0)),
    )
    distance_weight: float = option(
        1.2,
        help="The search for one robot orders by elapsed time + this many times the distance to go + "
        "`conflict_weight` ticks per conflict (Veerapaneni, Kusnur and Likhachev, AAAI 2023).",
        validator=attrs.validators.and_(attrs.validators.ge(1.0), attrs.validators.le(1e3)),
    )
    conflict_weight: float = option(
        20.0,
        help="See `distance_weight`; 0 = conflicts count more than anything else, as in the original.",
        validator=attrs.validators.and_(attrs.validators.ge(0.0), attrs.validators.le(1e6)),
    )

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        return solve(problem, budget, mapf.bounded_cbs, selection="explicit_estimation", **attrs.asdict(self))
