"""The routes of all plans of an execution, from the channels `route_...` of its recording."""

from collections.abc import Iterator, Sequence
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import Plan, RobotPath
from mrpbench_core.model.runs.run import Loaders, RunContext

COLUMNS = "waypoint", "level", "speed", "edge", "leave"
"""Of a waypoint; see `mrpbench_core.model.runs.recording`."""


class RouteHistory:
    """The routes and plans of an execution, each from its beginning, though recordings hold only what was new in each.

    Args:
        context: as it was before the execution.
        channels: those of its recording. Older recordings hold whole routes, and the oldest no plans.
    """

    def __init__(self, context: RunContext, channels: Loaders) -> None:
        self._context = context
        names = [name for name in COLUMNS if f"route_{name}" in channels]
        self._first = [_columns(context, robot) for robot in range(len(context.routes))]
        rows = channels["route_time"]() if "route_time" in channels and self._first else np.zeros(0)
        self._has_plans = self._context.result.plan is not None and (not len(rows) or "edge" in names)
        """False where only the routes of plans after the first are known."""
        self._plans = self._bounds = np.zeros(0, np.int64)
        if not len(rows):
            return
        revision, robot = channels["route_revision"](), channels["route_robot"]()
        segment = channels["route_segment"]() if "route_segment" in channels else np.zeros(len(rows), np.int64)
        order = np.lexsort((segment, robot, revision))
        self._time: Float = rows[order]
        self._columns: dict[str, NDArray[Any]] = {name: channels[f"route_{name}"]()[order] for name in names}
        revision, robot = revision[order], robot[order]
        begins = np.append(True, (np.diff(revision) != 0) | (np.diff(robot) != 0))
        self._begin: Int = np.flatnonzero(begins)
        """Row of each piece: what is new in one plan for one robot. Pieces are sorted by plan and robot."""
        self._end: Int = np.append(self._begin[1:], len(order))
        self._robot: Int = robot[self._begin].astype(np.int64)
        self._at: Int = segment[order][self._begin].astype(np.int64)
        """Index of the first waypoint of each piece in the whole route."""
        self._plans = np.flatnonzero(np.append(True, np.diff(revision[self._begin]) != 0))
        """First piece of each plan."""
        self._bounds = np.append(self._plans, len(self._begin))

    @property
    def complete(self) -> bool:
        """True if every plan has a route for every robot."""
        return bool((np.diff(self._bounds) == len(self._first)).all()) and all(
            len(routes["edge"]) for routes in self._first
        )

    def count(self) -> int:
        """Number of waypoints of all plans together, each from its beginning."""
        total = sum(len(routes["edge"]) for routes in self._first)
        pieces = 0 if not len(self._plans) else int((self._at + self._end - self._begin).sum())
        return total + pieces

    def latest(self) -> tuple[tuple[Route, ...], Plan | None]:
        """The routes of the last plan: what was driven, and what was left to drive; and the plan if it is known."""
        last = self._last()
        return tuple(map(_route, last)), self._plan(last)

    def plans(self) -> Iterator[tuple[float, Sequence[Route], Plan | None]]:
        """Yield the second from which on a plan is executed, its routes, and itself if it is known."""
        yield 0.0, self._context.routes, self._context.result.plan
        whole = list(self._first)
        for first, end in zip(self._plans.tolist(), self._bounds[1:].tolist(), strict=True):
            for piece in range(first, end):
                robot = int(self._robot[piece])
                whole[robot] = self._joined(whole[robot], np.array([piece]))
            yield float(self._time[self._begin[first]]), tuple(map(_route, whole)), self._plan(whole)

    def _plan(self, whole: list[dict[str, NDArray[Any]]]) -> Plan | None:
        return Plan(paths=tuple(map(_path, whole))) if self._has_plans else None

    def _last(self) -> list[dict[str, NDArray[Any]]]:
        """The columns of each robot's last route."""
        if not len(self._plans):
            return self._first
        by_robot = np.argsort(self._robot, kind="stable")
        bounds = np.searchsorted(self._robot[by_robot], np.arange(len(self._first) + 1))
        return [
            self._joined(routes, by_robot[slice(*bounds[robot : robot + 2])])
            for robot, routes in enumerate(self._first)
        ]

    def _joined(self, whole: dict[str, NDArray[Any]], pieces: Int) -> dict[str, NDArray[Any]]:
        """Continue a whole route with later pieces; each counts up to the first waypoint of any piece after it."""
        if not len(pieces):
            return whole
        begin, at = self._begin[pieces], self._at[pieces]
        size = self._end[pieces] - begin
        until = np.minimum.accumulate(np.append(at, at[-1] + size[-1])[::-1])[::-1]
        taken = np.clip(until[1:] - at, 0, size)
        rows = np.repeat(begin - np.cumsum(taken) + taken, taken) + np.arange(taken.sum())
        return {name: np.concatenate([whole[name][: until[0]], values[rows]]) for name, values in self._columns.items()}


def _columns(context: RunContext, robot: int) -> dict[str, NDArray[Any]]:
    """The columns of a robot's first route."""
    route, plan = context.routes[robot], context.result.plan
    waits = len(route.waypoint) - 1
    still = np.zeros(waits, np.int64)
    path = RobotPath(edge=still.astype(np.int32) - 1, enter=still, leave=still) if plan is None else plan.paths[robot]
    return {
        "waypoint": route.waypoint,
        "level": route.level,
        "speed": np.append(np.inf, route.speed),
        "edge": np.append(np.int32(-1), path.edge),
        "leave": np.concatenate([path.enter[:1] if len(path) else np.zeros(1, np.int64), path.leave]),
    }


def _route(columns: dict[str, NDArray[Any]]) -> Route:
    return Route(waypoint=columns["waypoint"], level=columns["level"], speed=columns["speed"][1:])


def _path(columns: dict[str, NDArray[Any]]) -> RobotPath:
    leave = columns["leave"]
    return RobotPath(edge=columns["edge"][1:], enter=leave[:-1], leave=leave[1:])


def with_latest_routes(context: RunContext, channels: Loaders) -> RunContext:
    """Return the context of a finished run, from that of its beginning."""
    return attrs.evolve(context, routes=RouteHistory(context, channels).latest()[0])
