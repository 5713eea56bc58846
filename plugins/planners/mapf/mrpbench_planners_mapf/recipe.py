"""Planners whose search is in C++. Their options follow from what the module of solvers says about the algorithm."""

import math
from collections.abc import Callable
from types import ModuleType
from typing import Any, ClassVar, TypeVar

import attrs
from mrpbench_native import mapf
from mrpbench_native.options import Option

from mrpbench_core.api.component import between, option
from mrpbench_core.api.described import as_option, described, validator_of
from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.planning.plan import Budget, PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_planners_mapf.native import KnownRoadmap, solve
from mrpbench_planners_mapf.stretching import Stops, stretch

P = TypeVar("P", bound="NativePlanner")
SUPPORTED = frozenset(
    {
        Feature.EDGE_DURATIONS,
        Feature.FOOTPRINTS,
        Feature.PROFILES,
        Feature.HEADINGS,
        Feature.GOAL_SETS,
        Feature.COMMITMENTS,
        Feature.FOLLOWING_FORBIDDEN,
    }
)
WINDOWED = frozenset({Feature.HORIZON, Feature.SHARED_GOALS})


class NativePlanner(Planner):
    """A planner that runs one algorithm in C++; concrete ones are decorated `@native_planner(...)`."""

    algorithm: ClassVar[str]
    solvers: ClassVar[ModuleType]
    """The module with the algorithm."""

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        return self.solve(problem, budget)

    def solve(
        self, problem: Problem, budget: Budget, rank: Int32 | None = None, known: KnownRoadmap | None = None
    ) -> PlanResult:
        """Run the algorithm; see `mrpbench_planners_mapf.native.solve` for `rank` and `known`."""
        return solve(problem, budget, self.algorithm, self._options(budget), self.solvers, rank, known)

    def _options(self, budget: Budget) -> dict[str, Any]:
        """The options of the algorithm: fields of this recipe, and what the budget sets."""
        options: dict[str, Any] = {}
        for row in self.solvers.describe(self.algorithm).options:
            if row.name == "iterations":
                options["iterations"] = budget.iterations
            elif not row.fixed:
                options[row.name] = getattr(self, row.name)
        if "seed" in options and options["seed"] is None:
            options["seed"] = budget.seed
        return options


def _not_below_min(planner: "RobustPlanner", _: "attrs.Attribute[int]", value: int) -> None:
    if value < planner.min_delay:
        raise ValueError(f"'max_delay' must not be less than min_delay = {planner.min_delay}, got {value}")


@attrs.frozen(kw_only=True)
class RobustPlanner(NativePlanner):
    """A planner that keeps robots as far apart in time as they may be late."""

    without_k: ClassVar[tuple[str, ...]] = ()
    """Options that have an effect only if `k` is 0."""

    k: int = option(
        0,
        help="The plan is k-robust (Atzmon et al., JAIR 2020): it has no conflict although each robot is up to `k` "
        "ticks late anywhere. Costs, bounds and proofs that there is no plan are those of such plans",
        validator=between(0, 1 << 20),
    )
    p: float = option(
        0.0,
        help="The plan is p-robust (Atzmon et al., ICAPS 2020): waits are added until robots that follow it without a "
        "dispatcher, and stop at random, have no conflict with at least this probability. Its costs have no bound then",
        validator=attrs.validators.and_(attrs.validators.ge(0), attrs.validators.lt(1)),
    )
    p_delay: float = option(
        0.01,
        help="for `p`: probability that a robot begins to stop in a tick in which it does not stop",
        validator=attrs.validators.and_(attrs.validators.ge(0), attrs.validators.lt(1)),
    )
    min_delay: int = option(1, help="for `p`: shortest stop, in ticks of the roadmap", validator=attrs.validators.ge(1))
    max_delay: int = option(
        1,
        help="for `p`: longest stop, in ticks of the roadmap; lengths are uniform",
        validator=attrs.validators.and_(attrs.validators.ge(1), _not_below_min),
    )

    @property
    def kept_promises(self) -> frozenset[Promise]:
        """Neither costs nor to find a plan with `p`, because waits are added afterwards."""
        return self.promises - ({Promise.OPTIMAL, Promise.BOUNDED, Promise.COMPLETE} if self.p else set())

    @property
    def robustness(self) -> int:
        """The option `k`."""
        return self.k

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        result = super().plan(attrs.evolve(problem, rules=attrs.evolve(problem.rules, k=self.k)), budget)
        if result.plan is None or not self.p:
            return result
        plan, bound = stretch(problem, result.plan, Stops(self.p_delay, self.min_delay, self.max_delay), self.p)
        return attrs.evolve(
            result,
            status=result.status if plan is not None else PlanStatus.GAVE_UP,
            plan=plan,
            lower_bound=math.nan,
            history=(),
            statistics={**result.statistics, "p_robust": bound},
        )

    def idle_options(self) -> dict[str, str]:
        """Return options that `k` and `p` make idle."""
        idle = dict.fromkeys(self.without_k, f"k is {self.k}") if self.k else {}
        return idle if self.p else idle | dict.fromkeys(("p_delay", "min_delay", "max_delay"), "p is 0")


def native_planner(algorithm: str, solvers: ModuleType = mapf) -> Callable[[type[P]], type[P]]:
    """Make a class the recipe of an algorithm: each option that the algorithm offers becomes a field.

    `solvers` is `mrpbench_native.mapf`, or a module that is built against the headers of `mrpbench-native`.

    The fields come before those of the class. `iterations` is not a field, because `Budget.iterations` sets it, and
    `seed` is None by default, which stands for `Budget.seed`.
    """

    def decorate(cls: type[P]) -> type[P]:
        offered = [it for it in solvers.describe(algorithm).options if not it.fixed and it.name != "iterations"]
        cls.algorithm, cls.solvers = algorithm, solvers
        return attrs.frozen(kw_only=True)(described(offered, _declare)(cls))

    return decorate


def _declare(row: Option) -> tuple[Any, Any]:
    if row.name != "seed":
        return as_option(row)
    return int | None, option(
        None,
        help=f"{row.help}; none = drawn from the run's seed and repeat",
        validator=attrs.validators.optional(validator_of(row)),
    )
