"""A run as metrics and formats see it."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import attrs
from numpy.typing import NDArray

from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.movers import Mover
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.runs.instance import Instance
from mrpbench_core.model.runs.routing import PlanFilter
from mrpbench_core.model.worlds.world import World

Loaders = Mapping[str, Callable[[], NDArray[Any]]]
"""Loads a whole channel by name; see `mrpbench_core.model.runs.recording`."""


@attrs.frozen(kw_only=True)
class RunContext:
    """The context of a run: everything that is known before execution begins."""

    run_id: str
    world: World
    fleet: Fleet
    scenario: Scenario
    problem: Problem
    result: PlanResult
    """The first plan."""
    routes: Sequence[Route]
    """The routes of the first plan. In a finished run: of the last plan, which begins with everything driven before."""
    goal: tuple[tuple[float, float, float], ...]
    """Final goal x, y (metres), yaw (NaN = any) of each robot: where its path ends."""
    period: float = 0.05
    """control period, simulated seconds."""
    latency: float = 0.0
    """simulated seconds from the request for a new plan until it is executed."""
    assigned: tuple[int, ...] = ()
    """Task of each robot, -1 = none."""
    planner_assigns: bool = False
    """The planner chose the tasks: in the problem every robot has the goals of all of them."""
    movers: tuple[Mover, ...] = ()
    """The members of all crowds, by index."""
    goal_tolerance: float = 0.7
    """metres from its goal within which a robot has arrived."""
    plan_filter: PlanFilter = "none"
    """Between plan and routes."""

    @property
    def instance(self) -> Instance:
        """What the run is about."""
        return Instance(
            world=self.world,
            fleet=self.fleet,
            scenario=self.scenario,
            problem=self.problem,
            assigned=None if self.planner_assigns else self.assigned,
        )

    @property
    def mover_names(self) -> tuple[str, ...]:
        """Names of the movers by index, such as `person_0`."""
        return tuple(f"{mover.kind}_{index}" for index, mover in enumerate(self.movers))

    @property
    def planned(self) -> bool:
        """False for recordings of other fleets, of whose planning nothing is known, not even that it failed."""
        return self.result.status != PlanStatus.UNKNOWN


@attrs.frozen(kw_only=True)
class FinishedRun:
    """A run that ended, with its recording."""

    context: RunContext
    executed: bool
    """False when the run ended after planning (`simulator: none`, or no plan to execute)."""
    channels: Loaders = attrs.field(factory=dict)
    alike: tuple[frozenset[str], ...] = ()
    """Channels that one source gave, so that comparing them would say nothing; only where others recorded the run."""

    first_routes: Sequence[Route] | None = None
    """The routes of the first plan; None = those of the context, because no plan came after it."""
    ended: bool = True
    """False where others recorded the run and the recording does not show how it ended."""

    def channel(self, name: str) -> NDArray[Any]:
        """The whole of a channel."""
        return self.channels[name]()

    @property
    def planned(self) -> bool:
        """See `RunContext.planned`."""
        return self.context.planned

    def first_context(self) -> RunContext:
        """The context as it was before the execution."""
        return self.context if self.first_routes is None else attrs.evolve(self.context, routes=self.first_routes)

    def has(self, name: str) -> bool:
        """Tell whether the recording holds a channel; for `plan`, `path` and `end`, whether these are known."""
        if name == "plan":
            return self.context.result.plan is not None
        if name == "end":
            return self.ended
        return self.planned if name == "path" else name in self.channels
