"""Planner `acme`: each robot takes a shortest path, as in fleets whose robots plan for themselves."""

import heapq
import time
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Budget, Feature, Plan, Planner, PlanResult, PlanStatus, Problem, Promise, RobotPath


@attrs.frozen(kw_only=True)
class Acme(Planner):
    """Plans for each robot as if there were no others, by Dijkstra's algorithm."""

    supports: ClassVar[frozenset[Feature]] = frozenset({Feature.EDGE_DURATIONS, Feature.PROFILES})
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.DETERMINISTIC})

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Return the plan, or that there is none because a robot cannot reach its goal."""
        deadline = time.monotonic() + budget.wall_s
        paths = []
        for robot in range(len(problem)):
            if time.monotonic() > deadline:
                return PlanResult(status=PlanStatus.TIMEOUT)
            path = shortest_path(problem, robot)
            if path is None:
                return PlanResult(status=PlanStatus.UNSOLVABLE)
            paths.append(path)
        return PlanResult(status=PlanStatus.SOLVED, plan=Plan(paths=tuple(paths)))


def shortest_path(problem: Problem, robot: int) -> RobotPath | None:
    """Return a path of the fewest ticks from the start of a robot to its goal, or None."""
    duration = problem.duration(robot).tolist()
    out: dict[int, list[tuple[int, int]]] = {}
    for edge, (tail, head) in enumerate(problem.roadmap.edges.tolist()):
        if duration[edge] >= 0:
            out.setdefault(tail, []).append((edge, head))
    start, goal = int(problem.start[robot]), problem.goals[robot][-1][0]
    queue: list[tuple[int, int, tuple[int, ...]]] = [(0, start, ())]
    visited = set()
    while queue:
        ticks, vertex, edges = heapq.heappop(queue)
        if vertex == goal:
            leave = np.cumsum([duration[edge] for edge in edges], dtype=np.int64)
            return RobotPath(edge=np.array(edges, np.int32), enter=np.append(0, leave)[:-1], leave=leave)
        if vertex not in visited:
            visited.add(vertex)
            for edge, head in out.get(vertex, []):
                heapq.heappush(queue, (ticks + duration[edge], head, (*edges, edge)))
    return None
