"""Contacts of robots with each other and with everything else."""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_simulators_pybullet.bullet import Bullet

ContactPairs = set[tuple[int, int]]
"""A robot, and a robot of higher index, the number of robots + the index of a mover, or -1 for what does not move."""


class Contacts:
    """Collects contacts in physics steps. Queries by body are cheaper than listing every wheel on the floor."""

    def __init__(self, bullet: Bullet, robots: Sequence[int], reach: Float) -> None:
        self._bullet, self._robots, self._reach = bullet, robots, reach
        self._pairs = np.triu_indices(len(robots), 1)
        self._index = {body: robot for robot, body in enumerate(robots)}
        self._close: list[tuple[int, int]] = []
        self._obstacles: Sequence[tuple[int, int]] = ()
        self.found: ContactPairs = set()

    def begin(self, place: Float, obstacles: Sequence[tuple[int, int]]) -> None:
        """Start anew: robots at f8[n,2] can touch robots within their `reach`, and `obstacles`: (body, index)."""
        first, second = self._pairs
        gap = place[first] - place[second]
        near = (gap * gap).sum(axis=1) < (self._reach[first] + self._reach[second]) ** 2
        self._close = list(zip(first[near].tolist(), second[near].tolist(), strict=True))
        self._obstacles, self.found = obstacles, set()

    def collect(self) -> None:
        """Add the contacts of the last physics step."""
        for obstacle, other in self._obstacles:
            for point in self._bullet.getContactPoints(bodyA=obstacle):
                if point[8] <= 0:
                    self.found.add((self._index[point[2]], other))
        for first, second in self._close:
            if (first, second) in self.found:
                continue
            for point in self._bullet.getContactPoints(bodyA=self._robots[first], bodyB=self._robots[second]):
                if point[8] <= 0:
                    self.found.add((first, second))
                    break
