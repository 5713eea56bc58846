"""Steps of a rollout on a roadmap on which turns and moves take time, and on which robots have footprints.

The policy decides which robot passes a cell after which; this order is kept, and everything happens as early as it
allows, as in "Multi-Agent Path Finding with Kinematic Constraints" (Hönig et al., ICAPS 2016), without its bounds on
speeds. A robot turns on the spot before it moves, and begins to move to a cell when the robot before it has reached the
next one.
"""

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from mrpbench_core.api import Int, Paths, Problem, RobotPath
from mrpbench_policies.board import Board

Segment = tuple[int, int, int]
"""Edge (-1 = wait), and the ticks in which it begins and ends."""


def timed_paths(board: Board, problem: Problem, trace: Int, stops: Iterable[tuple[int, int, int]]) -> Paths:
    """Return the paths of robots that were at places i8[T+1,n], one step after another, never in rings.

    Args:
        board: of the roadmap of the problem.
        problem: has the starts, and the durations of edges.
        trace: the places.
        stops: step, robot, and the vertex at its place at which it has to be then.
    """
    drives = [_Drive(board, problem, robot) for robot in range(len(problem))]
    left: dict[int, int] = {}  # the tick in which the last robot has left a place for the next one
    wanted: dict[int, list[tuple[int, int]]] = {}
    for step, robot, vertex in stops:
        wanted.setdefault(step, []).append((robot, vertex))
    for step in range(len(trace)):
        for robot in _in_order(trace[step - 1].tolist(), trace[step].tolist()) if step else ():
            place, to = int(trace[step - 1, robot]), int(trace[step, robot])
            left[place] = drives[robot].move(to, left.get(to, 0))
        for robot, vertex in wanted.get(step, ()):
            drives[robot].turn(vertex)
    return Paths.of([drive.path() for drive in drives])


def _in_order(before: Sequence[int], after: Sequence[int]) -> Iterator[int]:
    """Yield the robots that move, each after the one that leaves the cell that it enters."""
    occupant = {place: robot for robot, place in enumerate(before)}
    movers = [robot for robot, place in enumerate(before) if after[robot] != place]
    waiting = set(movers)
    for first in movers:
        queue, robot = [], first
        while robot in waiting:
            waiting.discard(robot)
            queue.append(robot)
            robot = occupant.get(after[robot], -1)
        yield from reversed(queue)


class _Drive:
    """What one robot does, as early as it can."""

    def __init__(self, board: Board, problem: Problem, robot: int) -> None:
        self._board, self._duration = board, problem.duration(robot)
        self._vertex = int(problem.start[robot])
        self._tick = 0
        self._segments: list[Segment] = []

    def move(self, to: int, earliest: int) -> int:
        """Go to a neighbouring place, not before a tick; return when the robot is there."""
        board = self._board
        action = int(np.flatnonzero(board.maps.offset == to - int(board.place[self._vertex]))[0])
        edge = int(board.leads[board.place[self._vertex], action])
        tail, head = board.edges[edge].tolist()
        self.turn(tail)
        if earliest > self._tick:
            self._segments.append((-1, self._tick, earliest))
            self._tick = earliest
        self._take(edge, head)
        return self._tick

    def turn(self, vertex: int) -> None:
        """Turn on the spot, or come to rest."""
        if vertex != self._vertex:
            self._take(self._board.turns[self._vertex, vertex], vertex)

    def _take(self, edge: int, head: int) -> None:
        leave = self._tick + int(self._duration[edge])
        self._segments.append((edge, self._tick, leave))
        self._tick, self._vertex = leave, head

    def path(self) -> RobotPath:
        """Return all segments."""
        edge, enter, leave = np.array(self._segments, np.int64).reshape(-1, 3).T
        return RobotPath(edge=edge.astype(np.int32), enter=enter, leave=leave)
