"""Planners whose search is in C++. Their options follow from what `mrpbench_native` says about the algorithm."""

from collections.abc import Callable
from typing import Any, ClassVar, Literal, TypeVar

import attrs
from mrpbench_native import describe, mapf

from mrpbench_core.api.component import option
from mrpbench_core.api.planner import Planner
from mrpbench_core.model.planning.plan import Budget, PlanResult
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_planners_mapf.native import solve

P = TypeVar("P", bound="NativePlanner")
SUPPORTED = frozenset(
    {
        Feature.EDGE_DURATIONS,
        Feature.FOOTPRINTS,
        Feature.PROFILES,
        Feature.GOAL_SETS,
        Feature.COMMITMENTS,
        Feature.FOLLOWING_FORBIDDEN,
    }
)
_TYPES: dict[str, type[Any]] = {"bool": bool, "int": int, "float": float}


class NativePlanner(Planner):
    """A planner that runs one algorithm of `mrpbench_native`; concrete ones are decorated `@native_planner(...)`."""

    algorithm: ClassVar[str]

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """See `Planner.plan`."""
        return solve(problem, budget, self.algorithm, self._options(budget))

    def _options(self, budget: Budget) -> dict[str, Any]:
        """The options of the algorithm: fields of this recipe, and what the budget sets."""
        options: dict[str, Any] = {}
        for described in describe(self.algorithm).options:
            if described.name == "iterations":
                options["iterations"] = budget.iterations
            elif not described.fixed:
                options[described.name] = getattr(self, described.name)
        if "seed" in options and options["seed"] is None:
            options["seed"] = budget.seed
        return options


def native_planner(algorithm: str) -> Callable[[type[P]], type[P]]:
    """Make a class the recipe of an algorithm: each option that the algorithm offers becomes a field.

    The fields come before those of the class. `iterations` is no field, because `Budget.iterations` sets it, and
    `seed` is None by default, which stands for `Budget.seed`.
    """

    def decorate(cls: type[P]) -> type[P]:
        offered = [it for it in describe(algorithm).options if not it.fixed and it.name != "iterations"]
        for described in offered:
            setattr(cls, described.name, _field(described))
        cls.__annotations__ = {it.name: _annotation(it) for it in offered} | cls.__annotations__
        cls.algorithm = algorithm
        return attrs.frozen(kw_only=True)(cls)

    return decorate


def _annotation(described: mapf.Option) -> Any:
    kind: Any = Literal[tuple(described.choices)] if described.choices else _TYPES[described.type]
    return kind | None if described.optional or described.name == "seed" else kind


def _field(described: mapf.Option) -> Any:
    drawn = described.name == "seed"
    paper = f" ({described.paper})" if described.paper else ""
    more = "; none = drawn from the run's seed and repeat" if drawn else ""
    return option(
        None if drawn else described.default,
        help=f"{described.help}{more}{paper}.",
        validator=_validator(described, optional=described.optional or drawn),
    )


def _validator(described: mapf.Option, *, optional: bool) -> Any:
    if described.choices:
        return attrs.validators.in_(tuple(described.choices))
    kind = _TYPES[described.type]
    bounds: list[Any] = []
    if described.least is not None:
        bounds.append(attrs.validators.ge(kind(described.least)))
    if described.most is not None:
        bounds.append(attrs.validators.le(kind(described.most)))
    if not bounds:
        return None
    within = attrs.validators.and_(*bounds) if len(bounds) > 1 else bounds[0]
    return attrs.validators.optional(within) if optional else within
