"""A run as metrics and exporters see it."""

from collections.abc import Callable, Mapping
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.worlds.world import World


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
    routes: tuple[Route, ...]
    """The routes of the first plan. In a finished run: of the last plan, which begins with everything driven before."""
    goal: tuple[tuple[float, float, float], ...]
    """Final goal x, y (metres), yaw (NaN = any) of each robot: where its path ends."""
    period: float = 0.05
    """control period, simulated seconds."""
    assigned: tuple[int, ...] = ()
    """Task of each robot, -1 = none."""

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
    channels: Mapping[str, Callable[[], NDArray[Any]]] = attrs.field(factory=dict)
    """Loads a whole channel by name; see `mrpbench_core.model.runs.recording`."""
    alike: tuple[frozenset[str], ...] = ()
    """Channels that one source gave, so that comparing them would say nothing; only where others recorded the run."""

    ended: bool = True
    """False where others recorded the run and the recording does not show how it ended."""

    def channel(self, name: str) -> NDArray[Any]:
        """The whole of a channel."""
        return self.channels[name]()

    @property
    def planned(self) -> bool:
        """See `RunContext.planned`."""
        return self.context.planned

    def has(self, name: str) -> bool:
        """Tell whether the recording holds a channel; for `plan`, `path` and `end`, whether these are known."""
        if name == "plan":
            return self.context.result.plan is not None
        if name == "end":
            return self.ended
        return self.planned if name == "path" else name in self.channels


def latest_routes(routes: tuple[Route, ...], channels: Mapping[str, Callable[[], NDArray[Any]]]) -> tuple[Route, ...]:
    """The routes of the last plan of an execution that began with `routes`, from its recording's channels `route_...`.

    Every plan's routes begin with what was released of the plan before, index by index: `reached` and `cleared` refer
    to the last routes as well as to those of their time.
    """
    return all_routes(routes, channels, newest=1)[-1][1]


def all_routes(
    routes: tuple[Route, ...], channels: Mapping[str, Callable[[], NDArray[Any]]], newest: int | None = None
) -> list[tuple[float, tuple[Route, ...]]]:
    """The routes of every plan, or of the `newest`, with the simulated second since which they hold."""
    found = [(0.0, routes)]
    if "route_time" in channels and len(revision := channels["route_revision"]()):
        time, robot, waypoint, level, speed = (
            channels[f"route_{name}"]() for name in ("time", "robot", "waypoint", "level", "speed")
        )
        numbers = np.unique(revision)
        for number in numbers if newest is None else numbers[-newest:]:
            own = [np.flatnonzero((revision == number) & (robot == one)) for one in range(len(routes))]
            plan = tuple(Route(waypoint=waypoint[rows], level=level[rows], speed=speed[rows][1:]) for rows in own)
            found.append((float(time[revision == number][0]), plan))
    return found


def with_latest_routes(context: RunContext, channels: Mapping[str, Callable[[], NDArray[Any]]]) -> RunContext:
    """The context of a finished run, from that of its beginning."""
    return attrs.evolve(context, routes=latest_routes(context.routes, channels))
