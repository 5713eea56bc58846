"""Base classes of planners by conflict-based search."""

from typing import ClassVar

from mrpbench_core.api.planner import Promise
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_planners_mapf.recipe import SUPPORTED, RobustPlanner

OPTIMAL = frozenset(Promise) - {Promise.BOUNDED}
BOUNDED = frozenset(Promise) - {Promise.OPTIMAL}


class BoundedCosts:
    """Promises costs of at most `w` times the least, with the option `w` of the algorithm."""

    w: float
    promises: ClassVar[frozenset[Promise]] = BOUNDED

    @property
    def suboptimality(self) -> float:
        """The option `w`."""
        return self.w


class ConflictBased(RobustPlanner):
    """A planner that splits conflicts of two robots, so no resource may hold more than one."""

    supports: ClassVar[frozenset[Feature]] = SUPPORTED | {Feature.RESOURCES}
    without_k: ClassVar[tuple[str, ...]] = ("rectangle",)

    def skip(self, problem: Problem) -> str | None:
        """See `Planner.skip`; also resources that hold several robots."""
        roomy = [resource.name for resource in problem.roadmap.resources if resource.capacity > 1]
        return super().skip(problem) or (f"resource {roomy[0]!r} holds more than one robot" if roomy else None)


class Assigning(ConflictBased):
    """A planner that also assigns goals to robots."""

    @property
    def assigns(self) -> bool:
        """Always: see `Planner.assigns`."""
        return True
