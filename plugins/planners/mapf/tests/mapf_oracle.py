"""Least sum of costs by A* over joint states, tick by tick: slow, plain, and independent of the solvers.

A robot is at a vertex, on an edge, or done (at its goal for good). Between two ticks each occupies one element, and at
each tick too; the rules of `mrpbench_core.model.conflicts` are checked for every pair at each of these moments. Once no
robot is held back any more, what can follow depends on the joint state alone, so that all of them can be seen, and an
instance without solution has none for sure. With the state goes for how many of these moments each robot will still use
each resource.
"""

import heapq
import itertools
import math
from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple

from mrpbench_core.model.geometry import segment_distance
from mrpbench_core.model.problem import Feature, Problem

AT, FRESH, ON, DONE = range(4)


class State(NamedTuple):
    kind: int
    place: int  # vertex, or edge if ON
    elapsed: int = 0
    total: int = 0


class Step(NamedTuple):
    """What one robot does from one tick to the next."""

    during: int | None
    """The element that it occupies meanwhile: a vertex, or an edge after all vertices; None is nowhere."""
    place: int | None
    """The element that it occupies at the next tick."""
    then: State
    arrives: bool = False


def least_cost(problem: Problem, limit: int = 6_000) -> float | None:
    """The optimum, inf if there is no solution, None if it is not known after `limit` states."""
    return _Search(problem, sum).run(limit)


def least_makespan(problem: Problem, limit: int = 6_000) -> float | None:
    """The least last arrival; the rest as `least_cost`."""
    return _Search(problem, max).run(limit)


def least_cost_assigned(problem: Problem, limit: int = 6_000) -> float | None:
    """The optimum over all assignments of robots to different goals; the rest as `least_cost`."""
    return _Search(problem, sum, different=True).run(limit)


def shortest(problem: Problem, robot: int) -> float:
    """Arrival of a robot that is alone."""
    search = _Search(problem, sum)
    return search._rest(robot, 0, search.first[robot])


class _Search:
    def __init__(self, problem: Problem, total: Callable[[Iterable[float]], float], different: bool = False) -> None:
        """`total` of the arrivals is minimised; `different` goals, also if robots disappear there."""
        self.problem = problem
        self.total = total
        self.different = different
        self.edges = [(int(a), int(b)) for a, b in problem.roadmap.edges]
        self.vertices = len(problem.roadmap.position)
        self.robots = range(len(problem))
        self.duration = [problem.duration(robot).tolist() for robot in self.robots]
        self.goals = [set(sequence[-1]) for sequence in problem.goals]
        self.to_go = [self._distances(robot) for robot in self.robots]
        self.steps: dict[tuple[int, int, State], list[Step]] = {}
        self.clashes: dict[tuple[int, int], dict[tuple, bool]] = {
            pair: {} for pair in itertools.combinations(self.robots, 2)
        }
        self.resources = [
            (
                {*resource.vertices, *(self.vertices + edge for edge in resource.edges)},
                resource.capacity,
                2 * resource.setup_ticks + 1,
            )
            for resource in problem.roadmap.resources
        ]
        self.overtakable = any(ticks > 1 for duration in self.duration for ticks in duration)
        self._read_commitments()
        self.settled = max(self.free_at, default=0) + 1
        self.first = tuple(self._standing(robot, 0, int(problem.start[robot])) for robot in self.robots)

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

    def run(self, limit: int) -> float | None:
        places = [state.place for state in self.first]
        uses = self._uses([(0,) * len(self.resources)] * len(places), places)
        if self._clash(places) or self._crowded(uses):
            return math.inf
        counter = itertools.count()
        queue = [(self._bound(0, 0, self.first), next(counter), 0, 0, self.first, uses)]
        seen = set()
        while queue:
            _, _, tick, cost, state, uses = heapq.heappop(queue)
            if all(it.kind == DONE for it in state):
                return cost
            if (min(tick, self.settled), state, uses) in seen:
                continue
            seen.add((min(tick, self.settled), state, uses))
            if len(seen) > limit:
                return None
            for after, paid, kept in self._successors(tick, state, uses):
                arrived = self.total([cost, *paid])
                estimate = self._bound(tick + 1, arrived, after)
                if estimate < math.inf:
                    heapq.heappush(queue, (estimate, next(counter), tick + 1, arrived, after, kept))
        return math.inf

    def _bound(self, tick, cost, state):
        return self.total([cost, *(self._rest(robot, tick, it) for robot, it in enumerate(state) if it.kind != DONE)])

    def _rest(self, robot, tick, it):
        """Least arrival of a robot that is not done."""
        if tick < self.free_at[robot] or (tick == self.free_at[robot] and it.kind == FRESH):
            here = self.to_go[robot][self.end[robot]]
            return self.since[robot] if here == 0 else self.free_at[robot] + here
        if it.kind == ON:
            return tick + it.total - it.elapsed + self.to_go[robot][self.edges[it.place][1]]
        return tick + self.to_go[robot][it.place]

    def _successors(self, tick, state, uses):
        """Joint states at the next tick, and what is paid by whom for being done."""
        for joint in self._joint((), [self._steps(robot, tick, it) for robot, it in enumerate(state)]):
            after = tuple(step.then for step in joint)
            if self.different and self._share_a_goal(after):
                continue
            if self.overtakable and self._overtaking(state, joint):
                continue
            between = self._uses(uses, [step.during for step in joint])
            kept = self._uses(between, [step.place for step in joint])
            if self._crowded(between) or self._crowded(kept):
                continue
            arriving = [robot for robot, step in enumerate(joint) if step.arrives]
            yield after, [self.since[robot] if tick == self.free_at[robot] else tick for robot in arriving], kept

    def _uses(self, before, elements):
        """For how many moments, this one included, each robot still uses each resource (rule 6)."""
        return tuple(
            tuple(
                lasting if element in places else max(0, left - 1)
                for (places, _, lasting), left in zip(self.resources, row, strict=True)
            )
            for row, element in zip(before, elements, strict=True)
        )

    def _crowded(self, uses):
        return any(
            sum(row[number] > 0 for row in uses) > capacity for number, (_, capacity, _) in enumerate(self.resources)
        )

    def _share_a_goal(self, state):
        done = [it.place for it in state if it.kind == DONE]
        return len(set(done)) < len(done)

    def _joint(self, chosen, options) -> Iterator[tuple[Step, ...]]:
        """All ways to add a step of each other robot to the steps of the first ones, without conflict."""
        robot = len(chosen)
        if robot == len(options):
            yield chosen
            return
        for step in options[robot]:
            for other, before in enumerate(chosen):
                if self._clashing(other, robot, before, step):
                    break
            else:
                yield from self._joint((*chosen, step), options)

    def _clashing(self, one, other, first, second):
        known = self.clashes[one, other]
        key = (first.during, first.place, second.during, second.place)
        if key not in known:
            during = self._exclusive(first.during, second.during, one, other)
            known[key] = during or self._exclusive(first.place, second.place, one, other)
        return known[key]

    def _steps(self, robot, tick, it):
        """What a robot may do until the next tick; from some tick on, always the same."""
        key = (robot, min(tick, self.settled), it)
        if key not in self.steps:
            self.steps[key] = [
                Step(during, self._element(robot, tick + 1, then), then, it.kind != DONE and then.kind == DONE)
                for during, then in self._choices(robot, tick, it)
            ]
        return self.steps[key]

    def _choices(self, robot, tick, it):
        """The same as pairs: the element that it occupies until then, and its state then."""
        if it.kind == ON:
            yield self.vertices + it.place, self._move(robot, tick, it)
        elif it.kind == DONE:
            yield self._element(robot, tick + 1, it), it
        elif tick < self.free_at[robot]:
            if tick in self.forced[robot]:
                edge, total = self.forced[robot][tick]
                yield self.vertices + edge, self._move(robot, tick, State(ON, edge, 0, total))
            else:
                yield it.place, self._standing(robot, tick + 1, it.place)
        else:
            if it.kind == FRESH:
                done = State(DONE, it.place)
                yield self._element(robot, tick + 1, done), done
            yield it.place, State(AT, it.place)
            for edge, (tail, _) in enumerate(self.edges):
                ticks = self.duration[robot][edge]
                if tail == it.place and ticks > 0:
                    yield self.vertices + edge, self._move(robot, tick, State(ON, edge, 0, ticks))

    def _move(self, robot, tick, it):
        if it.elapsed + 1 < it.total:
            return State(ON, it.place, it.elapsed + 1, it.total)
        return self._standing(robot, tick + 1, self.edges[it.place][1])

    def _standing(self, robot, tick, vertex):
        """A robot that comes to a vertex, or is held there no longer: it may be done if this is a goal of it."""
        return State(FRESH if tick >= self.free_at[robot] and vertex in self.goals[robot] else AT, vertex)

    def _element(self, robot, tick, it):
        if it.kind == ON:
            return self.vertices + it.place
        gone = it.kind == DONE and self.problem.rules.at_goal == "disappear" and tick > self.free_at[robot]
        return None if gone else it.place

    def _clash(self, elements):
        pairs = itertools.combinations(enumerate(elements), 2)
        return any(self._exclusive(x, y, r, s) for (r, x), (s, y) in pairs)

    def _exclusive(self, x, y, one, other):
        """Whether two robots must not be on these elements at a time; None is nowhere."""
        if x is None or y is None:
            return False
        return self._rules(x, y) or self._near(x, y, float(self.problem.radius[one] + self.problem.radius[other]))

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

    def _overtaking(self, state, joint):
        """Does a robot leave a lane before one that entered it earlier?"""
        moving = [
            (self.edges[element - self.vertices], before.elapsed if before.kind == ON else 0, then.kind != ON)
            for before, (element, _, then, _) in zip(state, joint, strict=True)
            if element is not None and element >= self.vertices
        ]
        return any(
            lane == other and elapsed < longer and leaves and not leaves_too
            for (lane, elapsed, leaves), (other, longer, leaves_too) in itertools.permutations(moving, 2)
        )
