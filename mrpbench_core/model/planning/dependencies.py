"""The dependencies between the moves of a plan, to find out which one keeps a robot waiting.

They are the type-2 edges of an action dependency graph: Hönig et al., "Persistent and Robust Execution of MAPF
Schedules in Warehouses", RA-L 2019.
"""

from typing import NamedTuple

import numpy as np

from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.planning.occupations import occupations_of, resource_edges
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.type2_edges import Moves, Type2Edges, moves_of, type2_edges


class Dependency(NamedTuple):
    """A robot's move must not begin before `robot` has reached, or has cleared, `segments` leading segments."""

    robot: int
    segments: int
    reached: bool
    """True: reached. False: cleared."""


class Dependencies:
    """The dependencies of every move of a plan, the first in the plan first."""

    def __init__(self, problem: Problem, plan: Plan) -> None:
        self.moves = moves = moves_of(problem, plan)
        occupations = occupations_of(problem, moves) if problem.roadmap.resources else []
        edges = type2_edges(problem, moves, resource_edges(problem, occupations))
        order = np.lexsort((moves.enter[edges.before], edges.after))
        self._before, self._completed = edges.before[order], edges.completed[order]
        self._first = np.searchsorted(edges.after[order], np.arange(len(moves.robot) + 1))
        self._rotation_of = {move: rotation for rotation in _rotations(moves, edges) for move in rotation}

    def next_move(self, robot: int, released: int) -> int | None:
        """Return the first move of a robot that is not among its `released` leading segments; None if there is none."""
        first, end = self.moves.first[robot], self.moves.first[robot + 1]
        move = int(first + np.searchsorted(self.moves.segment[first:end], released))
        return move if move < end else None

    def rotates(self, move: int) -> bool:
        """Tell whether a move is part of a rotation, whose moves begin together."""
        return move in self._rotation_of

    def of(self, move: int) -> list[Dependency]:
        """Return the dependencies of a move; those of all moves of its rotation if it is part of one."""
        group = self._rotation_of.get(move, (move,))
        dependencies = [dependency for member in group for dependency in self._direct(member, group)]
        others = [member for member in group if member != move]
        return dependencies + [
            Dependency(int(self.moves.robot[other]), int(self.moves.segment[other]), reached=True) for other in others
        ]

    def _direct(self, move: int, group: tuple[int, ...]) -> list[Dependency]:
        rows = slice(self._first[move], self._first[move + 1])
        return [
            Dependency(int(self.moves.robot[before]), int(self.moves.segment[before]) + 1, reached=completed)
            for before, completed in zip(self._before[rows].tolist(), self._completed[rows].tolist(), strict=True)
            if before not in group
        ]


def _rotations(moves: Moves, edges: Type2Edges) -> list[tuple[int, ...]]:
    """Cycles of moves in which each robot moves to the vertex that the next one leaves at the same time."""
    follows = ~edges.completed & (moves.enter[edges.before] >= moves.enter[edges.after])
    follows &= moves.tail[edges.before] == moves.head[edges.after]
    leader = dict(zip(edges.after[follows].tolist(), edges.before[follows].tolist(), strict=True))
    rotations, visited = [], set[int]()
    for start in leader:
        trail: dict[int, int] = {}
        move = start
        while move in leader and move not in visited:
            visited.add(move)
            trail[move] = len(trail)
            move = leader[move]
        if move in trail:
            rotations.append(tuple(trail)[trail[move] :])
    return rotations


def first_samples(counts: Int, robot: int, count: int) -> int:
    """Return the first sample at which `counts` i4[T,n] of a robot is at least `count`; T if there is none."""
    return int(np.searchsorted(counts[:, robot], count))
