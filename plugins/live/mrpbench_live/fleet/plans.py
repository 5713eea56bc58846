"""Paths of the outside party as plans, and how far along a plan robots may go."""

import numpy as np

from mrpbench_core.api import Float, Int, Int32, Paths, Plan, Problem
from mrpbench_live.fleet.paths import FleetPaths


def continued(problem: Problem, paths: FleetPaths) -> Plan:
    """Return a plan in which each robot makes its released moves, and then the others of its path at once.

    Args:
        problem: with the released segments as commitments.
        paths: that the outside party wants.
    """
    before = Paths.of(problem.commitments) if problem.commitments else _empty(len(problem))
    edges = [paths.after(robot, released) for robot, released in enumerate(paths.released.tolist())]
    ends = np.where(before.size > 0, np.append(before.leave, 0)[before.first[1:] - 1], problem.begins)
    size = np.array([len(own) for own in edges], np.int64)
    waits = (size > 0) & (before.size == 0) & (problem.ready > ends)
    begin = np.where(waits, problem.ready, ends)
    edge = np.array([it for own in edges for it in own], np.int64)
    robot = np.repeat(np.arange(len(problem)), size)
    spent = problem.roadmap.duration[problem.profile[robot], edge].astype(np.int64)
    total = np.concatenate([[0], np.cumsum(spent)])
    first = np.concatenate([[0], np.cumsum(size)])
    enter = begin[robot] + total[:-1] - total[first[robot]]
    moves = Paths(first=first, edge=edge.astype(np.int32), enter=enter, leave=enter + spent)
    still = Paths(
        first=np.concatenate([[0], np.cumsum(waits)]),
        edge=np.full(int(waits.sum()), -1, np.int32),
        enter=ends[waits],
        leave=problem.ready[waits],
    )
    return Plan(paths=before.then(still, moves))


def _empty(robots: int) -> Paths:
    nothing = np.zeros(0, np.int64)
    return Paths(first=np.zeros(robots + 1, np.int64), edge=np.zeros(0, np.int32), enter=nothing, leave=nothing)


class PlannedMoves:
    """Converts between the segments of a plan and the moves of paths, which are counted since the beginning.

    Args:
        problem: of the plan.
        plan: the current one.
        base: i8[n] moves of each path that the plan leaves out.
    """

    def __init__(self, problem: Problem, plan: Plan, base: Int) -> None:
        paths = Paths.of(plan.paths)
        is_move = paths.edge >= 0
        self.base = base
        self._first = paths.first
        self._before: Int = np.concatenate([[0], np.cumsum(is_move)])
        """i8[m+1] moves before each segment, of all robots together."""
        self._row: Int = np.flatnonzero(is_move)
        """i8[k] segment of each move."""
        tail, head = problem.roadmap.position[problem.roadmap.edges[paths.edge[is_move]].reshape(-1, 2)].transpose(
            1, 0, 2
        )
        self._metres: Float = np.concatenate([[0.0], np.cumsum(np.hypot(*(head - tail).T))])
        self._begin = self._before[self._first[:-1]]
        self.count: Int = self._before[self._first[1:]] - self._begin
        """i8[n] moves of the plan."""

    def moves_before(self, segments: Int | Int32) -> Int:
        """Return how many moves i8[n] there are among the leading `segments` i[n] of each path of the plan."""
        found: Int = self._before[self._first[:-1] + segments] - self._begin
        return found

    def made(self, reached: Int32) -> Int:
        """Return the moves i8[n] that robots have completed, of those since the beginning."""
        return self.base + self.moves_before(reached)

    def release(self, made: Int, allowed: Int, ahead: Float, released: Int) -> tuple[Int, Int]:
        """Return what may be released: leading segments i8[n] of the plan, and moves i8[n] since the beginning.

        Args:
            made: i8[n] moves that robots have completed.
            allowed: i8[n] moves that they may make.
            ahead: f8[n] metres ahead of a robot within which moves are released; the next one always is.
            released: i8[n] segments that are released already.
        """
        here = self._begin + made - self.base
        reach = np.searchsorted(self._metres, self._metres[here] + ahead, side="left")
        until = np.minimum(np.maximum(reach, here + 1), self._begin + np.minimum(allowed - self.base, self.count))
        moves = np.maximum(until - self._begin, self.moves_before(released))
        whole, size = moves >= self.count, np.diff(self._first)
        last = self._row[np.clip(self._begin + moves - 1, 0, max(0, len(self._row) - 1))] if len(self._row) else size
        segments = np.where(whole, size, np.where(moves > 0, last + 1 - self._first[:-1], 0))
        found: Int = np.maximum(segments, released)
        return found, self.base + moves
