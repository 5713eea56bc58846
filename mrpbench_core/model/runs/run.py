"""A run as metrics and exporters see it."""

from collections.abc import Callable, Mapping
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.movers import Mover
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import Path, Plan, PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.scenario import Scenario
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
    routes: tuple[Route, ...]
    """The routes of the first plan. In a finished run: of the last plan, which begins with everything driven before."""
    goal: tuple[tuple[float, float, float], ...]
    """Final goal x, y (metres), yaw (NaN = any) of each robot: where its path ends."""
    period: float = 0.05
    """control period, simulated seconds."""
    assigned: tuple[int, ...] = ()
    """Task of each robot, -1 = none."""
    movers: tuple[Mover, ...] = ()
    """The members of all crowds, by index."""

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


def latest_routes(routes: tuple[Route, ...], channels: Loaders) -> tuple[Route, ...]:
    """The routes of the last plan of an execution that began with `routes`, from its recording's channels `route_...`.

    Every plan's routes begin with what was released of the plan before, index by index: `reached` and `cleared` refer
    to the last routes as well as to those of their time.
    """
    return all_routes(routes, channels, newest=1)[-1][1]


def all_routes(
    routes: tuple[Route, ...], channels: Loaders, newest: int | None = None
) -> list[tuple[float, tuple[Route, ...]]]:
    """The routes of every plan, or of the `newest`, with the simulated second since which they hold."""
    found = [(0.0, routes)]
    if rows := _rows(channels, len(routes)):
        time, waypoint, level, speed = (channels[f"route_{name}"]() for name in ("time", "waypoint", "level", "speed"))
        for own in rows if newest is None else rows[-newest:]:
            plan = tuple(Route(waypoint=waypoint[r], level=level[r], speed=speed[r][1:]) for r in own)
            found.append((float(time[own[0][0]]), plan))
    return found


def all_plans(context: RunContext, channels: Loaders) -> list[Plan | None]:
    """The plans whose routes are `all_routes`; None for a plan that the recording does not hold.

    Args:
        context: as it was before the execution.
        channels: those of its recording; older ones hold new plans as routes alone.
    """
    found = [context.result.plan]
    if rows := _rows(channels, len(context.routes)):
        if "route_edge" not in channels:
            return found + [None] * len(rows)
        edge, leave = channels["route_edge"](), channels["route_leave"]()
        paths = ([Path(edge=edge[r][1:], enter=leave[r][:-1], leave=leave[r][1:]) for r in own] for own in rows)
        found += [Plan(paths=tuple(plan)) for plan in paths]
    return found


def _rows(channels: Loaders, robots: int) -> list[list[Int]]:
    """The rows of the channels `route_...` of each robot, by plan after the first."""
    if "route_time" not in channels or not robots:
        return []
    revision, robot = channels["route_revision"](), channels["route_robot"]()
    return [
        [np.flatnonzero((revision == number) & (robot == one)) for one in range(robots)]
        for number in np.unique(revision)
    ]


def with_latest_routes(context: RunContext, channels: Loaders) -> RunContext:
    """The context of a finished run, from that of its beginning."""
    return attrs.evolve(context, routes=latest_routes(context.routes, channels))
