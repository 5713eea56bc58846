"""The least sum of costs by brute force: a search over the joint states of all robots, one tick at a time.

Plain on purpose, for a handful of robots on a dozen vertices: it shares no code with planners or validators, only the
rules that `mrpbench_core.model.conflicts` states.
"""

import heapq
from collections.abc import Iterator
from itertools import count
from typing import NamedTuple

import numpy as np

from mrpbench_core.model.geometry import segment_distance
from mrpbench_core.model.problem import Feature, Problem

UNKNOWN = frozenset({Feature.HORIZON, Feature.RESOURCES, Feature.HEADINGS})
"""Features this search does not know."""
MOST_STATES = 400_000


class Robot(NamedTuple):
    """Where one robot is at a tick."""

    vertex: int
    """where it stands, or where it goes to"""
    edge: int = -1
    """the edge it is on, -1 = it stands"""
    left: int = 0
    """ticks until it stands"""
    visited: int = 0
    """goals of its sequence it has visited"""
    stopped: bool = False
    """it stays for good, and costs nothing from then on"""


class During(NamedTuple):
    """What one robot does from a tick to the next."""

    tail: int
    head: int
    left: int
    """ticks on its edge, counted from the earlier tick"""
    enters: bool
    present: bool
    after: Robot
    cost: int


def least_sum_of_costs(problem: Problem) -> int | None:
    """The optimum over plans that cross each edge in exactly its duration, in ticks; None if there is no plan.

    Raises:
        ValueError: the problem has a feature this search does not know, or too many states.
    """
    if unknown := problem.features & UNKNOWN:
        raise ValueError(f"cannot search problems with {', '.join(sorted(unknown))}")
    return _Search(problem).least()


class _Search:
    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.edges: list[tuple[int, int]] = [(tail, head) for tail, head in problem.roadmap.edges.tolist()]
        self.out: list[list[int]] = [[] for _ in problem.roadmap.position]
        for edge, (tail, _) in enumerate(self.edges):
            self.out[tail].append(edge)
        self.duration = [problem.duration(robot).tolist() for robot in range(len(problem))]
        self.forced = [self._forced(robot) for robot in range(len(problem))]
        # Beyond this tick nothing depends on time any more.
        self.settled = max([0, *problem.ready.tolist(), *(tick + 1 for forced in self.forced for tick in forced)])
        self.distances: dict[tuple[int, int, int, int], float] = {}
        self.to_go = [self._to_go(robot) for robot in range(len(problem))]

    def least(self) -> int | None:
        starts = self.problem.start.tolist()
        robots = tuple(Robot(vertex, visited=self._visited(i, vertex, 0)) for i, vertex in enumerate(starts))
        standing = [
            During(vertex, vertex, 0, False, True, robot, 0) for vertex, robot in zip(starts, robots, strict=True)
        ]
        if any(self._meet(i, j, one, other) for j, other in enumerate(standing) for i, one in enumerate(standing[:j])):
            return None
        order = count()
        queue = [(self._estimate(robots), next(order), 0, 0, robots)]
        closed = set()
        while queue:
            _, _, cost, tick, robots = heapq.heappop(queue)
            if all(robot.stopped for robot in robots):
                return cost
            state = min(tick, self.settled), robots
            if state in closed:
                continue
            closed.add(state)
            if len(closed) > MOST_STATES:
                raise ValueError("the problem is too large for brute force")
            for joint in self._joint(tick, robots, ()):
                after = tuple(during.after for during in joint)
                paid = cost + sum(during.cost for during in joint)
                estimate = self._estimate(after)
                if estimate < np.inf:
                    heapq.heappush(queue, (paid + estimate, next(order), paid, tick + 1, after))
        return None

    def _joint(self, tick: int, robots: tuple[Robot, ...], chosen: tuple[During, ...]) -> Iterator[tuple[During, ...]]:
        index = len(chosen)
        if index == len(robots):
            yield chosen
            return
        for during in self._choices(index, robots[index], tick):
            if not any(self._meet(earlier, index, one, during) for earlier, one in enumerate(chosen)):
                yield from self._joint(tick, robots, (*chosen, during))

    def _choices(self, index: int, robot: Robot, tick: int) -> Iterator[During]:
        at = robot.vertex
        if robot.stopped:
            stays = self.problem.rules.at_goal == "stay"
            yield During(at, at, 0, False, stays, robot, 0)
        elif robot.left > 0:
            yield self._on_edge(index, robot, robot.edge, robot.left, False)
        elif tick in self.forced[index]:
            edge, ticks = self.forced[index][tick]
            yield self._on_edge(index, robot, edge, ticks, True) if edge >= 0 else self._wait(robot)
        else:
            yield self._wait(robot)
            if tick >= self.problem.ready[index]:
                for edge in self.out[at]:
                    if self.duration[index][edge] > 0:
                        yield self._on_edge(index, robot, edge, self.duration[index][edge], True)
        if self._may_stop(index, robot, tick):
            stopped = robot._replace(stopped=True)
            yield from self._choices(index, stopped, tick)

    def _wait(self, robot: Robot) -> During:
        return During(robot.vertex, robot.vertex, 0, False, True, robot, 1)

    def _on_edge(self, index: int, robot: Robot, edge: int, left: int, enters: bool) -> During:
        tail, head = self.edges[edge]
        if left > 1:
            after = Robot(head, edge, left - 1, robot.visited)
        else:
            after = Robot(head, visited=self._visited(index, head, robot.visited))
        return During(tail, head, left, enters, True, after, 1)

    def _may_stop(self, index: int, robot: Robot, tick: int) -> bool:
        sequence = self.problem.goals[index]
        there = robot.visited == len(sequence) and (not sequence or robot.vertex in sequence[-1])
        free = all(edge < 0 for begin, (edge, _) in self.forced[index].items() if begin >= tick)
        return there and free and robot.left == 0 and not robot.stopped

    def _visited(self, index: int, vertex: int, visited: int) -> int:
        sequence = self.problem.goals[index]
        while visited < len(sequence) and vertex in sequence[visited]:
            visited += 1
        return visited

    def _meet(self, i: int, j: int, one: During, other: During) -> bool:
        """Tell whether two robots conflict between two ticks, or at the later one."""
        if not (one.present and other.present):
            return False
        moves, other_moves = one.tail != one.head, other.tail != other.head
        if one.after.left == 0 == other.after.left and one.head == other.head:
            return True
        if moves and other_moves:
            if (one.tail, one.head) == (other.head, other.tail):
                return True
            if (one.tail, one.head) == (other.tail, other.head) and self._overtakes(one, other):
                return True
            if self.problem.rules.following == "forbidden" and (one.head == other.tail or other.head == one.tail):
                return True
        if not moves and not other_moves and one.head == other.head:
            return True
        if Feature.FOOTPRINTS not in self.problem.features:
            return False
        reach = float(self.problem.radius[i] + self.problem.radius[j])
        return self._distance(one.tail, one.head, other.tail, other.head) < reach - 1e-9

    def _overtakes(self, one: During, other: During) -> bool:
        if self.problem.rules.following == "forbidden" or (one.enters and other.enters):
            return True
        if one.enters:
            return one.left <= other.left
        return other.enters and other.left <= one.left

    def _distance(self, a: int, b: int, c: int, d: int) -> float:
        key = a, b, c, d
        if key not in self.distances:
            roadmap = self.problem.roadmap
            shared = {roadmap.level[a], roadmap.level[b]} & {roadmap.level[c], roadmap.level[d]}
            points = (roadmap.position[vertex] for vertex in key)
            self.distances[key] = float(segment_distance(*points)) if shared else np.inf
        return self.distances[key]

    def _forced(self, index: int) -> dict[int, tuple[int, int]]:
        """What a robot has committed itself to begin at a tick: edge and ticks, (-1, 1) for each tick of a wait."""
        forced = {}
        if self.problem.commitments:
            path = self.problem.commitments[index]
            for edge, enter, leave in zip(path.edge.tolist(), path.enter.tolist(), path.leave.tolist(), strict=True):
                if edge >= 0:
                    forced[enter] = edge, leave - enter
                else:
                    forced |= dict.fromkeys(range(enter, leave), (-1, 1))
        return forced

    def _to_go(self, index: int) -> list[float]:
        """A lower bound on a robot's cost from each vertex: ticks to its last goal set as if it were alone."""
        sequence = self.problem.goals[index]
        if not sequence:
            return [0.0] * len(self.out)
        ticks = [0.0 if vertex in sequence[-1] else np.inf for vertex in range(len(self.out))]
        for _ in self.out:
            for edge, (tail, head) in enumerate(self.edges):
                if self.duration[index][edge] > 0:
                    ticks[tail] = min(ticks[tail], self.duration[index][edge] + ticks[head])
        return ticks

    def _estimate(self, robots: tuple[Robot, ...]) -> float:
        return sum(
            0.0 if robot.stopped else ticks[robot.vertex] + robot.left
            for robot, ticks in zip(robots, self.to_go, strict=True)
        )
