"""Contacts of robots with each other and with everything else."""

from collections.abc import Sequence

import numpy as np
from mrpbench_simulators_bodies.engine import ContactForces

from mrpbench_core.model.common.arrays import Float
from mrpbench_simulators_pybullet.bullet import Bullet

_DISTANCE, FORCE = 8, 9
"""Entries of a contact point."""


class Contacts:
    """Collects contacts of physics steps. Queries by body are cheaper than listing every wheel on the floor."""

    def __init__(self, bullet: Bullet, robots: Sequence[int], reach: Float) -> None:
        self._bullet, self._robots, self._reach = bullet, robots, reach
        self._pairs = np.triu_indices(len(robots), 1)
        self._index = {body: robot for robot, body in enumerate(robots)}
        self._close: list[tuple[int, int]] = []
        self._obstacles: Sequence[tuple[int, int]] = ()

    def begin(self, place: Float, obstacles: Sequence[tuple[int, int]]) -> None:
        """Robots at f8[n,2] can touch robots within their `reach`, and `obstacles`: (body, index)."""
        first, second = self._pairs
        gap = place[first] - place[second]
        near = (gap * gap).sum(axis=1) < (self._reach[first] + self._reach[second]) ** 2
        self._close = list(zip(first[near].tolist(), second[near].tolist(), strict=True))
        self._obstacles = obstacles

    def collect(self) -> ContactForces:
        """The contacts of the last physics step."""
        forces: dict[tuple[int, int], float] = {}
        for obstacle, other in self._obstacles:
            for point in self._bullet.getContactPoints(bodyA=obstacle):
                if point[_DISTANCE] <= 0 or point[FORCE] > 0:
                    pair = (self._index[point[2]], other)
                    forces[pair] = forces.get(pair, 0.0) + point[FORCE]
        for first, second in self._close:
            for point in self._bullet.getContactPoints(bodyA=self._robots[first], bodyB=self._robots[second]):
                if point[_DISTANCE] <= 0 or point[FORCE] > 0:
                    forces[first, second] = forces.get((first, second), 0.0) + point[FORCE]
        return forces
