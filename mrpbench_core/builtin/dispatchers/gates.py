"""Counts, for each move of a plan, the conditions that it still waits for."""

import numpy as np

from mrpbench_core.api.dispatcher import DispatchError
from mrpbench_core.builtin.dispatchers.precedence import Moves, Precedence, moves_of, precedence
from mrpbench_core.builtin.dispatchers.requests import Requests
from mrpbench_core.builtin.dispatchers.rotation import rotations
from mrpbench_core.builtin.dispatchers.uses import orders_of, uses_of
from mrpbench_core.model.arrays import Int, Int32
from mrpbench_core.model.plan import Plan
from mrpbench_core.model.problem import Problem

REACHED, CLEARED = 0, 1
"""Rows of the counts of leading segments i8[2,n], see `mrpbench_core.model.execution.FleetView`."""


class Gates:
    """One gate for each move, which opens when nothing is left that it waits for; the moves of a ring share one.

    A condition on a gate is that a robot has reached, or has cleared, so many segments. Conditions lie sorted by robot
    and number, so that each is touched once: when it comes true. A wait is released with the move after it.
    """

    def __init__(self, problem: Problem, plan: Plan, group_margin: float, ahead: int) -> None:
        moves = moves_of(problem, plan)
        uses = uses_of(problem, moves) if problem.roadmap.resources else []
        order = precedence(problem, moves, orders_of(problem, uses))
        self.requests = Requests(len(problem), moves, uses, ahead)
        self.granted: frozenset[tuple[int, str]] = frozenset()
        self.rings = {ring[0]: ring for ring in rotations(problem, moves, order, group_margin)}
        for ring in self.rings.values():
            if needed := {name for move in ring for name in self.requests.needs.get(move, ())}:
                raise DispatchError(
                    f"robots turn in a ring through {', '.join(sorted(needed))}, which lets in one by one"
                )
        gate = np.arange(len(moves.robot))
        for first, ring in self.rings.items():
            gate[list(ring)] = first
        row, count, waiting = _conditions(problem, moves, order, gate)
        sorting = np.lexsort((count, row))
        row, count, waiting = row[sorting], count[sorting], waiting[sorting]
        limits = np.searchsorted(row, np.arange(2 * len(problem) + 1))
        self.moves = moves
        # Lists from here on: one number at a time is what they are quick at.
        self.gate: list[int] = gate.tolist()
        self.missing: list[int] = np.bincount(waiting, minlength=len(gate)).tolist()
        self.count: list[int] = count.tolist()
        self.waiting: list[int] = waiting.tolist()
        self.next, self.end = limits[:-1].tolist(), limits[1:].tolist()
        self.segment: list[int] = moves.segment.tolist()
        self.robot: list[int] = moves.robot.tolist()
        self.first, self.last = moves.first[:-1].tolist(), moves.first[1:].tolist()
        self.limit = _limit(problem, moves).tolist()
        self.cut = self.limit != self.last
        self.lengths = [len(path) for path in plan.paths]
        self.frontier = list(self.first)
        """The first move of each robot that is not released."""
        self.released: Int32 = np.zeros(len(problem), np.int32)
        """i4[n]: number of leading path segments released."""
        for robot in range(len(problem)):
            self._advance(robot)

    def look(self, counts: Int, robots: Int) -> None:
        """Open what the `counts` i8[2,n] of these `robots` open."""
        opened = []
        for robot in robots.tolist():
            for kind in (REACHED, CLEARED):
                row, value = kind * len(self.frontier) + robot, int(counts[kind, robot])
                at = self.next[row]
                while at < self.end[row] and self.count[at] <= value:
                    gate = self.waiting[at]
                    self.missing[gate] -= 1
                    if not self.missing[gate]:
                        opened.append(gate)
                    at += 1
                self.next[row] = at
        for gate in opened:
            for move in self.rings.get(gate, (gate,)):
                self._advance(self.robot[move])

    def _advance(self, robot: int) -> None:
        move = self.frontier[robot]
        while move < self.limit[robot] and not self.missing[self.gate[move]] and self._may_use(robot, move):
            move += 1
        self.frontier[robot] = move
        if move == self.last[robot]:
            self.released[robot] = self.lengths[robot]
        elif move > self.first[robot]:
            self.released[robot] = self.segment[move - 1] + 1

    def ask(self, counts: Int, granted: tuple[tuple[int, str], ...]) -> bool:
        """Release what was `granted`, and ask for what is needed next, given the `counts` i8[2,n].

        Tells whether anybody needs anything, now or later.
        """
        if not self.requests:
            return False
        self.granted = frozenset(granted)
        for robot in range(len(self.frontier)):
            self._advance(robot)
        free = [robot for robot, move in enumerate(self.frontier) if self._only_asks(robot, move)]
        self.requests.update(counts[REACHED], counts[CLEARED], self.frontier, free)
        return True

    def _only_asks(self, robot: int, move: int) -> bool:
        """Tell whether a robot's next move waits for nothing but resources."""
        return move < self.limit[robot] and not self.missing[self.gate[move]]

    def _may_use(self, robot: int, move: int) -> bool:
        return all((robot, name) in self.granted for name in self.requests.needs.get(move, ()))

    def commit(self, committed: Int32) -> None:
        """Count each robot's `committed` i4[n] leading segments as released, whatever they need.

        Raises:
            DispatchError: a move among them still waits for another robot.
        """
        for robot, until in enumerate(committed.tolist()):
            for move in range(self.frontier[robot], self.last[robot]):
                if self.segment[move] >= until:
                    break
                if self.missing[self.gate[move]]:
                    raise DispatchError(
                        f"robot {robot} is already on its way to vertex {self.moves.head[move]}, "
                        f"where the new plan lets robot {self._blocker(self.gate[move])} pass first"
                    )
                self.frontier[robot] = move + 1
            self._advance(robot)

    def _blocker(self, gate: int) -> int:
        rows = range(len(self.next))
        waits = (row for row in rows if gate in self.waiting[self.next[row] : self.end[row]])
        return next(waits) % len(self.frontier)

    def exhausted(self, reached: Int) -> str | None:
        """Why a new plan is wanted: the robots have `reached` i8[n] all that the horizon allows, which is not all."""
        if self.cut and (reached >= self.released).all():
            return "the robots have come to the plan's horizon"
        return None


def _conditions(problem: Problem, moves: Moves, order: Precedence, gate: Int) -> tuple[Int, Int, Int]:
    """Row, count and waiting gate i8[k] of every condition; the rows are those of REACHED, then those of CLEARED."""
    robots = len(problem)
    apart = gate[order.before] != gate[order.after]
    before, after = order.before[apart], order.after[apart]
    row = np.where(order.completed[apart], REACHED, CLEARED) * robots + moves.robot[before]
    # The robots of a ring must all have come to where it starts, and one in a lift to where it gets out.
    in_ring = np.isin(gate, gate[gate != np.arange(len(gate))])
    level = problem.roadmap.level
    after_ride = np.append(False, level[moves.tail[:-1]] != level[moves.head[:-1]])[: len(gate)]
    follows = np.flatnonzero((in_ring | after_ride) & (np.arange(len(gate)) > moves.first[moves.robot]))
    return (
        np.concatenate([row, REACHED * robots + moves.robot[follows]]),
        np.concatenate([moves.segment[before] + 1, moves.segment[follows - 1] + 1]),
        np.concatenate([gate[after], gate[follows]]),
    )


def _limit(problem: Problem, moves: Moves) -> Int:
    """The first move i8[n] of each robot that ends after the horizon, or the end of its moves."""
    if problem.horizon is None:
        return moves.first[1:]
    within = np.concatenate([[0], np.cumsum(moves.leave <= problem.horizon)])
    limit: Int = moves.first[:-1] + within[moves.first[1:]] - within[moves.first[:-1]]
    return limit
