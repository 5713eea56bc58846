"""A planner to copy: cooperative A* (Silver, "Cooperative Pathfinding", AIIDE 2005).

Robots plan one after another, each by A* in space and time around the reservations of the robots before it. The search
is fast, but neither optimal nor complete: a robot that parks early can enclose one that plans later.
"""

import heapq
import math
import time
from collections import deque
from itertools import pairwise
from typing import ClassVar, Literal

import attrs
import numpy as np

from mrpbench_core.api import Budget, Plan, Planner, PlanResult, PlanStatus, Problem, Promise, RobotPath, option

Graph = list[dict[int, int]]
"""For each vertex, its neighbours and the edges that lead to them."""


@attrs.frozen(kw_only=True)
class Example(Planner):
    """Prioritized planning by space-time A*, for edges that take one tick."""

    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.DETERMINISTIC})

    order: Literal["given", "farthest_first"] = option(
        "given", help="order in which robots plan; earlier robots have priority"
    )

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Plan robot by robot; `GAVE_UP` if a robot finds no path around the reservations."""
        deadline = time.monotonic() + budget.wall_s
        forth, back = graphs(problem)
        goals = [sequence[0][0] for sequence in problem.goals]
        starts = problem.start.tolist()
        distances: list[dict[int, int]] = []
        for goal in goals:
            distances.append(distances_from(goal, back))
            if time.monotonic() > deadline:
                return PlanResult(status=PlanStatus.TIMEOUT)
        alone = [table.get(start, math.inf) for table, start in zip(distances, starts, strict=True)]
        if math.inf in alone:
            return PlanResult(
                status=PlanStatus.UNSOLVABLE
            )  # proved: a robot cannot reach its goal even when it is alone
        robots = range(len(problem))
        reserved = Reservations()
        paths: dict[int, RobotPath] = {}
        for robot in sorted(robots, key=lambda robot: -alone[robot]) if self.order == "farthest_first" else robots:
            try:
                route = search(forth, starts[robot], goals[robot], distances[robot], reserved, deadline)
            except TimeoutError:
                return PlanResult(status=PlanStatus.TIMEOUT, lower_bound=sum(alone))
            if route is None:
                return PlanResult(status=PlanStatus.GAVE_UP, lower_bound=sum(alone))
            reserved.add(route)
            edge = np.array([forth[tail].get(head, -1) for tail, head in pairwise(route)], np.int32)
            paths[robot] = RobotPath(edge=edge, enter=np.arange(len(edge)), leave=np.arange(len(edge)) + 1)
        plan = Plan(paths=tuple(paths[robot] for robot in robots))
        return PlanResult(status=PlanStatus.SOLVED, plan=plan, lower_bound=sum(alone))


class Reservations:
    """Places and times of the robots that have planned."""

    def __init__(self) -> None:
        self.places: set[tuple[int, int]] = set()  # (vertex, tick)
        self.moves: set[tuple[int, int, int]] = set()  # (from, to, tick of arrival)
        self.parked: dict[int, int] = {}  # vertex: the tick from which a robot stays there
        self.last_visit: dict[int, int] = {}
        self.end = 0  # the tick from which all of them stay where they are

    def add(self, route: list[int]) -> None:
        """Reserve a route: the vertex at each tick."""
        for tick, vertex in enumerate(route):
            self.places.add((vertex, tick))
            self.last_visit[vertex] = max(tick, self.last_visit.get(vertex, tick))
        self.moves.update((tail, head, tick) for tick, (tail, head) in enumerate(pairwise(route), start=1))
        self.parked[route[-1]] = len(route) - 1
        self.end = max(self.end, len(route) - 1)

    def allow(self, tail: int, head: int, tick: int) -> bool:
        """Tell whether a robot may come from `tail` to `head` at `tick`."""
        return (
            (head, tick) not in self.places
            and (head, tail, tick) not in self.moves
            and tick < self.parked.get(head, math.inf)
        )


def search(
    graph: Graph, start: int, goal: int, distance: dict[int, int], reserved: Reservations, deadline: float
) -> list[int] | None:
    """A* over (vertex, tick): the vertex at each tick until the robot can stay at its goal, or None."""
    if not reserved.allow(start, start, 0):
        return None
    came_from = {(start, 0): start}
    queue = [(distance[start], 0, start)]
    closed = set()
    while queue:
        if time.monotonic() > deadline:
            raise TimeoutError
        _, minus_tick, vertex = heapq.heappop(queue)
        tick = -minus_tick
        state = vertex, min(tick, reserved.end + 1)  # afterwards nothing moves, so the tick does not matter
        if state in closed:
            continue
        closed.add(state)
        if vertex == goal and tick > reserved.last_visit.get(goal, -1):
            return trace(came_from, vertex, tick)
        for head in (vertex, *graph[vertex]):
            if head in distance and reserved.allow(vertex, head, tick + 1):
                came_from.setdefault((head, tick + 1), vertex)
                heapq.heappush(queue, (tick + 1 + distance[head], -tick - 1, head))
    return None


def trace(came_from: dict[tuple[int, int], int], vertex: int, tick: int) -> list[int]:
    """Follow a search back from (vertex, tick) to its start."""
    route = [vertex]
    for later in range(tick, 0, -1):
        route.append(came_from[route[-1], later])
    return route[::-1]


def graphs(problem: Problem) -> tuple[Graph, Graph]:
    """The roadmap's edges that robots may use, forwards and backwards."""
    forth: Graph = [{} for _ in problem.roadmap.position]
    back: Graph = [{} for _ in problem.roadmap.position]
    allowed = problem.duration(0) >= 0 if len(problem) else ()
    for edge in np.flatnonzero(allowed).tolist():
        tail, head = problem.roadmap.edges[edge].tolist()
        forth[tail][head] = back[head][tail] = edge
    return forth, back


def distances_from(vertex: int, graph: Graph) -> dict[int, int]:
    """Steps from `vertex` to every vertex that can be reached."""
    steps = {vertex: 0}
    queue = deque([vertex])
    while queue:
        tail = queue.popleft()
        for head in graph[tail]:
            if head not in steps:
                steps[head] = steps[tail] + 1
                queue.append(head)
    return steps
