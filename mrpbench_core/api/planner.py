"""Contract of the kind *planner*."""

from abc import ABC, abstractmethod
from enum import StrEnum
from typing import ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.planning.plan import Budget, PlanResult
from mrpbench_core.model.planning.problem import Feature, Problem


class Promise(StrEnum):
    """A property of every plan of a planner; the engine checks each property that can be checked."""

    CONFLICT_FREE = "conflict_free"
    OPTIMAL = "optimal"
    """Least sum of costs."""
    BOUNDED = "bounded"
    """The sum of costs is at most `Planner.suboptimality` times `PlanResult.lower_bound`."""
    ROBUST = "robust"
    """There is no conflict although each robot is up to `Planner.robustness` ticks late. The other promises are about
    such plans."""
    COMPLETE = "complete"
    """Finds a plan, given enough time, if one exists."""
    DETERMINISTIC = "deterministic"
    """The same problem, options and `Budget.seed` give the same plan, unless the clock ended the search
    (`PlanResult.clock_bound`)."""


class PlannerSession(ABC):
    """Plans for one execution, call after call: it may keep what later calls can use."""

    @abstractmethod
    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Return a plan as `Planner.plan`. Of calls in one execution the roadmap and the robots are the same."""


class Planner(Component):
    """Turns a problem into one timed path per robot."""

    group: ClassVar[str] = "mrpbench.planners"
    supports: ClassVar[frozenset[Feature]] = frozenset()
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE})
    reads_remaining: ClassVar[bool] = False
    """True if the planner uses `Problem.remaining`, which is otherwise not given."""
    chooses_goals: ClassVar[bool] = False
    """True if the planner decides during an execution where robots go. The problems that it gets have no goals then."""
    needs_homes: ClassVar[bool] = False
    """True if robots without one of the tasks that come over time must go home (`replanning.parking: home`)."""

    @abstractmethod
    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Return a plan, or the reason why there is none, within `budget`. Do not change `problem`."""

    def start(self) -> PlannerSession:
        """Begin an execution. By default every call of the session is a call of `plan`, and nothing is kept."""
        return _OneShot(self)

    @property
    def kept_promises(self) -> frozenset[Promise]:
        """The promises with the options of this planner, by default all of `promises`."""
        return self.promises

    @property
    def suboptimality(self) -> float:
        """The factor w of the promise `BOUNDED`; a planner that promises it overrides this."""
        return 1.0

    @property
    def robustness(self) -> int:
        """The ticks k of the promise `ROBUST`; a planner that promises it overrides this."""
        return 0

    @property
    def assigns(self) -> bool:
        """True if the planner also assigns tasks to robots.

        By default it does if it supports goal sets and its option `assign` is on; a planner that always assigns
        overrides this. It replaces the assigner: the goal set of every robot contains the goals of all tasks.
        """
        return getattr(self, "assign", False) is True and Feature.GOAL_SETS in self.supports

    def skip(self, problem: Problem) -> str | None:
        """Return why this planner cannot be given `problem`, or None. By default: the features it does not support."""
        lacking = sorted(problem.features - self.supports)
        return f"does not support {', '.join(lacking)}" if lacking else None

    def skip_tasks(self, problem: Problem, places: Int | None) -> str | None:  # noqa: ARG002
        """Return why this planner cannot be used with tasks that come over time, or None, as by default.

        Args:
            problem: robots stand at their starts.
            places: vertices i8[k] at which errands may be; None: not known.
        """
        return None


class _OneShot(PlannerSession):
    """Calls a planner afresh each time."""

    def __init__(self, planner: Planner) -> None:
        self._planner = planner

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        return self._planner.plan(problem, budget)
