"""What the outside party wants of each robot: a path, and how far along it the robot may go.

Paths are counted in moves since the beginning of the run, so that no count changes with a new plan.
"""

import attrs
import numpy as np

from mrpbench_core.api import Bool, Float, Int, Int16, Roadmap


class FleetPaths:
    """The paths of all robots, and how far they have come.

    Args:
        roadmap: of the run.
        start: vertices i8[n].
    """

    def __init__(self, roadmap: Roadmap, start: Int) -> None:
        count = len(start)
        self._tail, self._head = roadmap.edges.reshape(-1, 2).T.tolist()
        self._edges: list[list[int]] = [[] for _ in range(count)]
        self._first: list[int] = [0] * count
        """The move that the first of `_edges` is; earlier ones were driven and forgotten."""
        self._ends: list[int] = start.tolist()
        self.length: Int = np.zeros(count, np.int64)
        """i8[n] moves of each path."""
        self.allowed: Int = np.zeros(count, np.int64)
        """i8[n] moves that a robot may make."""
        self.speed: Float = np.full(count, np.inf)
        """f8[n] m/s allowed."""
        self.passed: Int = np.zeros(count, np.int64)
        """i8[n] moves that it has completed."""
        self.released: Int = np.zeros(count, np.int64)
        """i8[n] moves that it may complete by now, and that cannot be taken back."""
        self.planned: Int = np.zeros(count, np.int64)
        """i8[n] moves of each path that the current plan has, too."""
        self.changed: set[int] = set()
        """Robots whose path is not that of the current plan."""

    def __len__(self) -> int:
        return len(self._edges)

    def end(self, robot: int) -> int:
        """Return the vertex at which a path ends."""
        return self._ends[robot]

    def append(self, robot: int, edges: tuple[int, ...]) -> int:
        """Continue a path by some edges; return the moves of all of it."""
        if edges:
            self._edges[robot].extend(edges)
            self._ends[robot] = self._head[edges[-1]]
            self.length[robot] += len(edges)
            self.changed.add(robot)
        return int(self.length[robot])

    def shorten(self, robot: int, moves: int) -> int:
        """Leave a path only so many moves, or those that are released if these are more; return how many are left."""
        left = max(moves, int(self.released[robot]))
        if left < self.length[robot]:
            first = self._edges[robot][left - self._first[robot]]
            del self._edges[robot][left - self._first[robot] :]
            self._ends[robot] = self._tail[first]
            self.length[robot] = left
            self.planned[robot] = min(int(self.planned[robot]), left)
            self.changed.add(robot)
        self.allowed[robot] = min(int(self.allowed[robot]), left)
        return left

    def after(self, robot: int, moves: int) -> list[int]:
        """Return the edges of a path after its first moves."""
        return self._edges[robot][moves - self._first[robot] :]

    def adopt(self, moves: Int) -> None:
        """Note that all paths are planned, and forget what comes before some `moves` i8[n] of each, which is driven."""
        self.planned = self.length.copy()
        self.changed.clear()
        for robot in np.flatnonzero(moves > self._first).tolist():
            del self._edges[robot][: int(moves[robot]) - self._first[robot]]
            self._first[robot] = int(moves[robot])


@attrs.frozen(kw_only=True, eq=False)
class FleetState:
    """The state of a fleet in one control period, as robots estimate it."""

    now: float
    """simulated seconds."""
    pose: Float
    """f8[n,3] x, y, yaw."""
    level: Int16
    """i2[n]."""
    driving: Bool
    """bool[n]: the robot follows its path, or is recovering from what was in its way."""
    gave_up: Bool
    """bool[n]: its navigator gave up, and it will not move any more."""
    velocity: Float
    """f8[n,3] m/s and rad/s in the frame of the robot, from the last two poses."""
