"""Least sum of costs by A* over joint states, tick by tick: slow, plain, and independent of the solvers.

A robot is at a vertex, on an edge, or done (at its goal for good). Between two ticks each occupies one element, and at
each tick too; the rules of `mrpbench_core.model.conflicts` are checked for every pair at each of these moments.
"""

import heapq
import itertools
import math
from typing import NamedTuple

import attrs

from mrpbench_core.model.geometry import segment_distance
from mrpbench_core.model.problem import Feature, Problem

AT, FRESH, ON, DONE = range(4)


class State(NamedTuple):
    kind: int
    place: int  # vertex, or edge if ON
    elapsed: int = 0
    total: int = 0


class TooLargeError(Exception):
    """The oracle ran out of its node limit."""


def least_cost(problem: Problem, limit: int = 6_000) -> float:
    """The optimum, inf if the searched states contain no solution at all; raises TooLargeError."""
    return _Search(problem).run(limit)


def least_cost_assigned(problem: Problem, limit: int = 6_000) -> float:
    """The optimum over all assignments of robots to different goals; raises TooLargeError."""
    best = math.inf
    for goals in itertools.product(*(sequence[-1] for sequence in problem.goals)):
        if len(set(goals)) < len(goals):
            continue
        assigned = attrs.evolve(problem, goals=tuple(((goal,),) for goal in goals))
        if sum(shortest(assigned, robot) for robot in range(len(problem))) < best:
            best = min(best, least_cost(assigned, limit))
    return best


def shortest(problem: Problem, robot: int) -> float:
    """Arrival of a robot that is alone."""
    to_go = _Search(problem).to_go[robot][problem.start[robot]]
    return to_go + problem.ready[robot] if to_go else 0


class _Search:
    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.edges = [(int(a), int(b)) for a, b in problem.roadmap.edges]
        self.vertices = len(problem.roadmap.position)
        self.robots = range(len(problem))
        self.duration = [problem.duration(robot).tolist() for robot in self.robots]
        self.goals = [set(sequence[-1]) for sequence in problem.goals]
        self.to_go = [self._distances(robot) for robot in self.robots]
        self.known: dict[tuple[int, int, float], bool] = {}
        self._read_commitments()

    def _read_commitments(self) -> None:
        self.forced: list[dict[int, tuple[int, int]]] = [{} for _ in self.robots]
        self.free_at = [int(ready) for ready in self.problem.ready]
        self.since = [0 for _ in self.robots]
        self.end = [int(vertex) for vertex in self.problem.start]
        for robot, path in enumerate(self.problem.commitments):
            for edge, enter, leave in zip(path.edge.tolist(), path.enter.tolist(), path.leave.tolist(), strict=True):
                if edge >= 0:
                    self.forced[robot][enter] = (edge, leave - enter)
                    self.since[robot], self.end[robot] = leave, self.edges[edge][1]
                    self.free_at[robot] = leave
                self.free_at[robot] = max(self.free_at[robot], leave)

    def _distances(self, robot: int) -> list[float]:
        distance = [0 if vertex in self.goals[robot] else math.inf for vertex in range(self.vertices)]
        for _ in range(self.vertices):
            for (tail, head), ticks in zip(self.edges, self.duration[robot], strict=True):
                if ticks >= 0:
                    distance[tail] = min(distance[tail], ticks + distance[head])
        return distance

    def run(self, limit: int) -> float:
        first = tuple(State(FRESH if self.free_at[r] == 0 else AT, int(self.problem.start[r])) for r in self.robots)
        if self._clash([state.place for state in first]):
            return math.inf
        counter = itertools.count()
        queue = [(self._bound(0, 0, first), next(counter), 0, 0, first)]
        seen = set()
        while queue:
            bound, _, tick, cost, state = heapq.heappop(queue)
            if bound == math.inf:
                break
            if all(it.kind == DONE for it in state):
                return cost
            if (tick, state) in seen:
                continue
            seen.add((tick, state))
            if len(seen) > limit:
                raise TooLargeError
            for after, paid in self._successors(tick, state):
                estimate = self._bound(tick + 1, cost + paid, after)
                heapq.heappush(queue, (estimate, next(counter), tick + 1, cost + paid, after))
        return math.inf

    def _bound(self, tick, cost, state):
        return cost + sum(self._rest(robot, tick, it) for robot, it in enumerate(state) if it.kind != DONE)

    def _rest(self, robot, tick, it):
        """Least arrival of a robot that is not done."""
        if tick < self.free_at[robot] or (tick == self.free_at[robot] and it.kind == FRESH):
            here = self.to_go[robot][self.end[robot]]
            return self.since[robot] if here == 0 else self.free_at[robot] + here
        if it.kind == ON:
            return tick + it.total - it.elapsed + self.to_go[robot][self.edges[it.place][1]]
        return tick + self.to_go[robot][it.place]

    def _successors(self, tick, state):
        for choice in itertools.product(*(list(self._choices(robot, tick, state[robot])) for robot in self.robots)):
            during = [element for element, _, _ in choice]
            after = tuple(then for _, then, _ in choice)
            if self._clash(during) or self._clash([self._element(r, tick + 1, after[r]) for r in self.robots]):
                continue
            if not self._overtaking(state, choice):
                yield after, sum(paid for _, _, paid in choice)

    def _choices(self, robot, tick, it):
        """What a robot may do until the next tick: (element occupied meanwhile, state then, cost paid)."""
        if it.kind == ON:
            yield self.vertices + it.place, self._move(robot, tick, it), 0
        elif it.kind == DONE:
            yield self._element(robot, tick + 1, it), it, 0
        elif tick < self.free_at[robot]:
            if tick in self.forced[robot]:
                edge, total = self.forced[robot][tick]
                yield self.vertices + edge, self._move(robot, tick, State(ON, edge, 0, total)), 0
            else:
                yield it.place, State(FRESH if tick + 1 == self.free_at[robot] else AT, it.place), 0
        else:
            if it.kind == FRESH and it.place in self.goals[robot]:
                done = State(DONE, it.place)
                paid = self.since[robot] if tick == self.free_at[robot] else tick
                yield self._element(robot, tick + 1, done), done, paid
            yield it.place, State(AT, it.place), 0
            for edge, (tail, _) in enumerate(self.edges):
                ticks = self.duration[robot][edge]
                if tail == it.place and ticks > 0:
                    yield self.vertices + edge, self._move(robot, tick, State(ON, edge, 0, ticks)), 0

    def _move(self, robot, tick, it):
        if it.elapsed + 1 < it.total:
            return State(ON, it.place, it.elapsed + 1, it.total)
        fresh = tick + 1 >= self.free_at[robot]
        return State(FRESH if fresh else AT, self.edges[it.place][1])

    def _element(self, robot, tick, it):
        if it.kind == ON:
            return self.vertices + it.place
        gone = it.kind == DONE and self.problem.rules.at_goal == "disappear" and tick > self.free_at[robot]
        return None if gone else it.place

    def _clash(self, elements):
        pairs = itertools.combinations([(r, x) for r, x in enumerate(elements) if x is not None], 2)
        return any(self._exclusive(x, y, r, s) for (r, x), (s, y) in pairs)

    def _exclusive(self, x, y, one, other):
        reach = float(self.problem.radius[one] + self.problem.radius[other])
        key = (x, y, reach)
        if key not in self.known:
            self.known[key] = self._rules(x, y) or self._near(x, y, reach)
        return self.known[key]

    def _rules(self, x, y):
        if x < self.vertices or y < self.vertices:
            return x == y
        (a, b), (c, d) = self.edges[x - self.vertices], self.edges[y - self.vertices]
        if (a, b) == (d, c):
            return True
        return self.problem.rules.following == "forbidden" and (b == c or a == d or (a, b) == (c, d))

    def _near(self, x, y, reach):
        if Feature.FOOTPRINTS not in self.problem.features:
            return False
        ends = [(z, z) if z < self.vertices else self.edges[z - self.vertices] for z in (x, y)]
        (a, b), (c, d) = (self.problem.roadmap.position[list(pair)] for pair in ends)
        return float(segment_distance(a, b, c, d)) < reach - 1e-9

    def _overtaking(self, state, choice):
        """Does a robot leave a lane before one that entered it earlier?"""
        moving = [
            (self.edges[element - self.vertices], before.elapsed if before.kind == ON else 0, then.kind != ON)
            for before, (element, then, _) in zip(state, choice, strict=True)
            if element is not None and element >= self.vertices
        ]
        return any(
            lane == other and elapsed < longer and leaves and not leaves_too
            for (lane, elapsed, leaves), (other, longer, leaves_too) in itertools.permutations(moving, 2)
        )
