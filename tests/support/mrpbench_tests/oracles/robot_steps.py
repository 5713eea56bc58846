"""The steps of one robot from one tick to the next: wait, move, end at its goal; part of `optimum`."""

import math
from collections.abc import Iterator
from typing import NamedTuple

from mrpbench_core.model.planning.problem import Problem

AT, ARRIVED, ON, DONE = range(4)
"""Phases: at a vertex; just arrived at a vertex where the robot may end; on an edge; ended."""


class RobotState(NamedTuple):
    """The state of a robot at a tick."""

    phase: int
    place: int
    """The vertex, or the edge if the phase is `ON`."""
    visited: int = 0
    """Goal sets of its sequence, the last apart, that the robot has visited."""
    elapsed: int = 0
    """Ticks since the robot entered its edge."""
    total: int = 0
    """Ticks that the robot takes for its edge."""


class RobotStep(NamedTuple):
    """A step of a robot from one tick to the next."""

    during: int | None
    """The element that the robot occupies between the ticks: a vertex, V + edge, or None after it has disappeared."""
    place: int | None
    """The element that the robot occupies at the later tick."""
    then: RobotState
    ends: bool = False
    """True if the robot ends at its goal with this step."""


class RobotSteps:
    """The steps of each robot of a problem, without regard to the other robots."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.edges: list[tuple[int, int]] = [(tail, head) for tail, head in problem.roadmap.edges.tolist()]
        self.vertices = len(problem.roadmap.position)
        robots = range(len(problem))
        self.duration = [problem.duration(robot).tolist() for robot in robots]
        self._sequences = [[set(goal_set) for goal_set in sequence] for sequence in problem.goals]
        self._forced: list[dict[int, tuple[int, int]]] = [{} for _ in robots]
        """Committed moves of each robot: from the tick of entering to edge and ticks."""
        self._free_from = [int(ready) for ready in problem.ready]
        """Tick from which each robot may choose its steps."""
        self._moved_until = [0 for _ in robots]
        self._committed_end = [int(vertex) for vertex in problem.start]
        self._read_commitments()
        self.settled = max(self._free_from, default=0) + 1
        """From this tick on, the steps no longer depend on time."""
        self._to_go = [self._distances(robot) for robot in robots]
        self.first = tuple(self._standing(robot, 0, int(problem.start[robot]), 0) for robot in robots)
        """The states of the robots at tick 0."""
        self._known: dict[tuple[int, int, RobotState], list[RobotStep]] = {}

    def steps(self, robot: int, tick: int, state: RobotState) -> list[RobotStep]:
        """The steps that a robot may take from `tick` to the next."""
        key = (robot, min(tick, self.settled), state)
        if key not in self._known:
            self._known[key] = [
                RobotStep(during, self.element(robot, tick + 1, then), then, state.phase != DONE and then.phase == DONE)
                for during, then in self._choices(robot, tick, state)
            ]
        return self._known[key]

    def arrival(self, robot: int, tick: int) -> int:
        """The cost of a robot that ends at `tick`: when its last move ended."""
        return self._moved_until[robot] if tick == self._free_from[robot] else tick

    def earliest_arrival(self, robot: int, tick: int, state: RobotState) -> float:
        """A lower bound on the arrival of a robot that has not ended; exact if it is alone and has one goal set."""
        free = self._free_from[robot]
        if tick < free or (tick == free and state.phase == ARRIVED):
            distance = self._to_go[robot][self._committed_end[robot]]
            return self._moved_until[robot] if distance == 0 else free + distance
        if state.phase == ON:
            return tick + state.total - state.elapsed + self._to_go[robot][self.edges[state.place][1]]
        return tick + self._to_go[robot][state.place]

    def element(self, robot: int, tick: int, state: RobotState) -> int | None:
        """The element that a robot occupies at a tick."""
        if state.phase == ON:
            return self.vertices + state.place
        disappears = self.problem.rules.at_goal == "disappear" and tick > self._free_from[robot]
        return None if state.phase == DONE and disappears else state.place

    def _read_commitments(self) -> None:
        for robot, path in enumerate(self.problem.commitments):
            for edge, enter, leave in zip(path.edge.tolist(), path.enter.tolist(), path.leave.tolist(), strict=True):
                if edge >= 0:
                    self._forced[robot][enter] = edge, leave - enter
                    self._moved_until[robot], self._committed_end[robot] = leave, self.edges[edge][1]
                self._free_from[robot] = max(self._free_from[robot], leave)

    def _distances(self, robot: int) -> list[float]:
        """Ticks from each vertex to the last goal set."""
        sequence = self._sequences[robot]
        distance = [0 if not sequence or vertex in sequence[-1] else math.inf for vertex in range(self.vertices)]
        for _ in range(self.vertices):
            for (tail, head), ticks in zip(self.edges, self.duration[robot], strict=True):
                if ticks >= 0:
                    distance[tail] = min(distance[tail], ticks + distance[head])
        return distance

    def _choices(self, robot: int, tick: int, state: RobotState) -> Iterator[tuple[int | None, RobotState]]:
        """The element that the robot occupies until the next tick, and its state then."""
        place, visited = state.place, state.visited
        if state.phase == ON:
            yield self.vertices + place, self._on_edge(robot, tick, state)
        elif state.phase == DONE:
            yield self.element(robot, tick + 1, state), state
        elif tick < self._free_from[robot]:
            if tick in self._forced[robot]:
                edge, total = self._forced[robot][tick]
                yield self.vertices + edge, self._on_edge(robot, tick, RobotState(ON, edge, visited, 0, total))
            else:
                yield place, self._standing(robot, tick + 1, place, visited)
        else:
            if state.phase == ARRIVED:  # to wait at a goal and to end there later costs more
                done = RobotState(DONE, place)
                yield self.element(robot, tick + 1, done), done
            yield place, RobotState(AT, place, visited)
            for edge, (tail, _) in enumerate(self.edges):
                ticks = self.duration[robot][edge]
                if tail == place and ticks > 0:
                    yield self.vertices + edge, self._on_edge(robot, tick, RobotState(ON, edge, visited, 0, ticks))

    def _on_edge(self, robot: int, tick: int, state: RobotState) -> RobotState:
        """The state at the next tick of a robot that is on an edge."""
        if state.elapsed + 1 < state.total:
            return state._replace(elapsed=state.elapsed + 1)
        return self._standing(robot, tick + 1, self.edges[state.place][1], state.visited)

    def _standing(self, robot: int, tick: int, vertex: int, visited: int) -> RobotState:
        """The state of a robot that arrives at a vertex, or that waits there because of its commitments."""
        sequence = self._sequences[robot]
        while visited < len(sequence) - 1 and vertex in sequence[visited]:
            visited += 1
        at_end = not sequence or (visited == len(sequence) - 1 and vertex in sequence[-1])
        return RobotState(ARRIVED if at_end and tick >= self._free_from[robot] else AT, vertex, visited)
