"""Which vertices robots take when they come to rest, and what they leave to others."""

import math
from collections import defaultdict
from functools import cache, cached_property

import numpy as np

from mrpbench_core.model.common.arrays import Bool
from mrpbench_core.model.planning.conflicts import TOLERANCE
from mrpbench_core.model.planning.problem import Problem

Square = tuple[int, int, int]
"""Level, column and row."""


class Neighbourhoods:
    """The vertices that are so near to one another that the largest robots of a problem exclude one another there."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.radius: list[float] = problem.radius.tolist()
        """metres, of each robot."""
        self.of = cache(self._of)
        """Vertices near a vertex, itself included, and their distances from it."""

    @cached_property
    def _squares(self) -> tuple[list[Square], dict[Square, list[tuple[int, float, float]]]]:
        """The square around each vertex, as large as the largest robots, and the vertices with x and y in each."""
        roadmap, side = self.problem.roadmap, max(2 * max(self.radius, default=0.0), TOLERANCE)
        column, row = (roadmap.position // side).astype(np.int64).T.tolist()
        squares = [*zip(roadmap.level.tolist(), column, row, strict=True)]
        inside = defaultdict(list)
        for vertex, (square, (x, y)) in enumerate(zip(squares, roadmap.position.tolist(), strict=True)):
            inside[square].append((vertex, x, y))
        return squares, inside

    def _of(self, vertex: int) -> tuple[tuple[int, float], ...]:
        squares, inside = self._squares
        (level, column, row), (x, y) = squares[vertex], self.problem.roadmap.position[vertex].tolist()
        return tuple(
            (there, math.hypot(u - x, v - y))
            for side in (column - 1, column, column + 1)
            for up in (row - 1, row, row + 1)
            for there, u, v in inside.get((level, side, up), ())
        )


class RestingPlaces:
    """The vertices at which robots come to rest, and what they leave to others."""

    def __init__(self, near: Neighbourhoods) -> None:
        self._near = near
        self._radii, self._size = np.unique(near.problem.radius, return_inverse=True)
        self._applied = np.zeros(len(self._radii), np.int64)
        self._free = np.ones((len(self._radii), len(near.problem.roadmap.position)), bool)
        """For robots of each radius, the vertices that the first `_applied` robots leave to them."""
        self.vertex: dict[int, int] = {}
        """Of each robot, in the order in which they took them."""
        self._at: dict[int, list[int]] = {}
        """The robots at each vertex."""

    def add(self, robot: int, vertex: int) -> None:
        """Let a robot rest at a vertex."""
        self.vertex[robot] = vertex
        self._at.setdefault(vertex, []).append(robot)

    def count(self, vertex: int) -> int:
        """How many robots rest at a vertex."""
        return len(self._at.get(vertex, ()))

    def leaves(self, robot: int, vertex: int) -> bool:
        """Tell whether the other robots leave room for a robot at a vertex."""
        at, radius = self._at, self._near.radius
        for there, gap in self._near.of(vertex):
            for other in at.get(there, ()):
                if other != robot and (there == vertex or gap < radius[other] + (radius[robot] - TOLERANCE)):
                    return False
        return True

    def free(self, robot: int) -> Bool:
        """The vertices bool[V] at which there is room for one more robot."""
        size = int(self._size[robot])
        free, others = self._free[size], [*self.vertex.items()]
        for other, vertex in others[self._applied[size] :]:
            reach = self._near.radius[other] + (self._radii[size] - TOLERANCE)
            free[[there for there, gap in self._near.of(vertex) if there == vertex or gap < reach]] = False
        self._applied[size] = len(others)
        left: Bool = free.copy()
        return left
