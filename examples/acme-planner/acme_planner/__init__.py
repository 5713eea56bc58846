"""Planner `acme`: robots plan one after another, and one that finds no path plans first in the next attempt."""

import heapq
import time
from collections.abc import Iterable
from itertools import pairwise
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Budget, Plan, Planner, PlanResult, PlanStatus, Problem, Promise, RobotPath, option

Occupied = set[tuple[int, ...]]
"""(vertex, tick) of robots that are there, and (tail, head, tick) of robots that arrive then."""


@attrs.frozen(kw_only=True)
class Acme(Planner):
    """Prioritized planning with new priorities after failures (Andreychuk and Yakovlev 2018); edges take one tick."""

    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.DETERMINISTIC})

    attempts: int = option(50, help="orders of the robots that are tried")

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Return the plan of the first order in which all robots find a path."""
        deadline = time.monotonic() + budget.wall_s
        out, into = neighbours(problem)
        goals = [sequence[-1][0] for sequence in problem.goals]
        to_goal = [steps(goal, into) for goal in goals]
        order = list(range(len(problem)))
        for _ in range(self.attempts):
            found: dict[int, list[int]] = {}
            occupied: Occupied = set()
            horizon = 0
            for robot in order:
                path = search(out, problem.start[robot].item(), goals[robot], to_goal[robot], occupied, horizon)
                if time.monotonic() > deadline:
                    return PlanResult(status=PlanStatus.TIMEOUT)
                if path is None:
                    order = [robot, *(other for other in order if other != robot)]
                    break
                found[robot] = path
                horizon = max(horizon, len(path))
                occupied = everything(found.values(), horizon + len(out))
            else:
                plan = Plan(paths=tuple(edges(found[robot], out) for robot in range(len(problem))))
                return PlanResult(status=PlanStatus.SOLVED, plan=plan)
        return PlanResult(status=PlanStatus.GAVE_UP)


def neighbours(problem: Problem) -> tuple[list[dict[int, int]], list[dict[int, int]]]:
    """Return for each vertex the edges that leave it and that enter it, by the vertex at their other end."""
    out: list[dict[int, int]] = [{} for _ in problem.roadmap.position]
    into: list[dict[int, int]] = [{} for _ in problem.roadmap.position]
    for edge in np.flatnonzero(problem.duration(0) >= 0).tolist():
        tail, head = problem.roadmap.edges[edge].tolist()
        out[tail][head] = into[head][tail] = edge
    return out, into


def steps(goal: int, into: list[dict[int, int]]) -> dict[int, int]:
    """Return the number of steps from each vertex to the goal."""
    distance, front = {goal: 0}, [goal]
    for vertex in front:
        for tail in into[vertex]:
            if tail not in distance:
                distance[tail] = distance[vertex] + 1
                front.append(tail)
    return distance


def search(
    out: list[dict[int, int]], start: int, goal: int, to_goal: dict[int, int], occupied: Occupied, horizon: int
) -> list[int] | None:
    """Return the vertex at each tick by A* in space and time, or None."""
    if start not in to_goal:
        return None
    came: dict[tuple[int, int], int | None] = {(start, 0): None}
    queue = [(to_goal[start], 0, start)]
    while queue:
        _, minus, vertex = heapq.heappop(queue)
        tick = -minus
        if vertex == goal and all((goal, later) not in occupied for later in range(tick, horizon + 1)):
            path: list[int] = []
            here: int | None = vertex
            while here is not None:
                path.append(here)
                here, tick = came[here, tick], tick - 1
            return path[::-1]
        if tick > horizon + len(out):
            continue
        for head in (vertex, *out[vertex]):
            free = (head, tick + 1) not in occupied and (head, vertex, tick + 1) not in occupied
            if free and head in to_goal and (head, tick + 1) not in came:
                came[head, tick + 1] = vertex
                heapq.heappush(queue, (tick + 1 + to_goal[head], -tick - 1, head))
    return None


def everything(paths: Iterable[list[int]], end: int) -> Occupied:
    """Return what paths occupy until a tick; robots stay where their paths end."""
    occupied: Occupied = set()
    for path in paths:
        whole = path + path[-1:] * (end + 1 - len(path))
        occupied.update((vertex, tick) for tick, vertex in enumerate(whole))
        occupied.update((tail, head, tick) for tick, (tail, head) in enumerate(pairwise(path), start=1))
    return occupied


def edges(path: list[int], out: list[dict[int, int]]) -> RobotPath:
    """Return a path as edges, -1 for a wait."""
    edge = [out[tail].get(head, -1) for tail, head in pairwise(path)]
    ticks = np.arange(len(edge) + 1)
    return RobotPath(edge=np.array(edge, np.int32), enter=ticks[:-1], leave=ticks[1:])
