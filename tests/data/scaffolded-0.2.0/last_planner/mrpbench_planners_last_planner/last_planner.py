"""LastPlanner: one robot drives at a time, around the robots that stand still."""

import time
from collections import deque
from typing import ClassVar

import attrs
import numpy as np
from mrpbench_core.api import Planner, Promise, option
from mrpbench_core.model.planning.plan import Budget, Path, Plan, PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Feature, Problem


@attrs.frozen(kw_only=True)
class LastPlanner(Planner):
    """Plans for one robot at a time; gives up when no remaining robot has a free path."""

    supports: ClassVar[frozenset[Feature]] = frozenset({Feature.EDGE_DURATIONS, Feature.PROFILES})
    promises: ClassVar[frozenset[Promise]] = frozenset({Promise.CONFLICT_FREE, Promise.DETERMINISTIC})

    reverse: bool = option(False, help="try the last robot first")

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Repeatedly choose the first robot that has a free path to its goal."""
        deadline = time.monotonic() + budget.wall_s
        at = problem.start.tolist()
        goals = [sequence[-1][0] for sequence in problem.goals]
        left = sorted(range(len(problem)), reverse=self.reverse)
        paths = {robot: timed([], []) for robot in left}
        now = 0
        while left:
            if time.monotonic() > deadline:
                return PlanResult(status=PlanStatus.TIMEOUT)
            for robot in left:
                standing = {vertex for other, vertex in enumerate(at) if other != robot}
                edges = free_path(problem, robot, at[robot], goals[robot], standing)
                if edges is not None:
                    break
            else:
                return PlanResult(status=PlanStatus.GAVE_UP)
            ticks = problem.duration(robot)[edges].tolist()
            if edges:
                ends = [now + sum(ticks[: index + 1]) for index in range(len(ticks))]
                paths[robot] = timed([-1, *edges], [now, *ends])
                now = ends[-1]
            at[robot] = goals[robot]
            left.remove(robot)
        return PlanResult(status=PlanStatus.SOLVED, plan=Plan(paths=tuple(paths[robot] for robot in range(len(at)))))


def timed(edges: list[int], leave: list[int]) -> Path:
    """Return the path along edges (-1 = wait) that begins at tick 0 and leaves each edge at the given tick."""
    return Path(edge=np.array(edges, "i4"), enter=np.array([0, *leave][:-1], "i8"), leave=np.array(leave, "i8"))


def free_path(problem: Problem, robot: int, start: int, goal: int, blocked: set[int]) -> list[int] | None:
    """Return the edges of a path with the fewest steps around `blocked` vertices, or None."""
    duration = problem.duration(robot).tolist()
    out: dict[int, list[tuple[int, int]]] = {}
    for edge, (tail, head) in enumerate(problem.roadmap.edges.tolist()):
        if duration[edge] >= 0 and head not in blocked:
            out.setdefault(tail, []).append((head, edge))
    ways: dict[int, list[int]] = {start: []}
    queue = deque([start])
    while queue and goal not in ways:
        vertex = queue.popleft()
        for head, edge in out.get(vertex, []):
            if head not in ways:
                ways[head] = [*ways[vertex], edge]
                queue.append(head)
    return ways.get(goal)
