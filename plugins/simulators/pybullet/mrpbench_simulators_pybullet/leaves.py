"""Leaves of doors: boxes that are placed anew whenever a door moves."""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.worlds.doors import leaf_segments
from mrpbench_core.model.worlds.facilities import Facilities, OperatedDoor
from mrpbench_core.model.worlds.level_layout import LevelLayout
from mrpbench_simulators_pybullet.bullet import Bullet, Group


class Leaves:
    """The leaves of all doors on all levels."""

    def __init__(self, bullet: Bullet, facilities: Facilities, layout: LevelLayout, state: Mapping[str, float]) -> None:
        self._bullet, self._facilities, self._layout = bullet, facilities, layout
        lines, self._height = self._lines(state)
        self._reach = np.hypot(*(lines[:, 2:] - lines[:, :2]).T) / 2
        self._bodies = []
        sizes = [(gate.door.thickness, gate.door.height) for gate, _, line in self._parts(state) for _ in line]
        for reach, (thickness, height) in zip(self._reach.tolist(), sizes, strict=True):
            half = [reach + thickness / 2, thickness / 2, height / 2]
            body = bullet.body(Group.WALLS, bullet.createCollisionShape(bullet.module.GEOM_BOX, halfExtents=half))
            bullet.changeDynamics(body, -1, lateralFriction=0, restitution=0)
            self._bodies.append(body)
        self.move(state)

    def move(self, state: Mapping[str, float]) -> None:
        """Place every leaf where the state of its door puts it."""
        lines, _ = self._lines(state)
        self._centre = (lines[:, :2] + lines[:, 2:]) / 2
        yaw = np.arctan2(*(lines[:, 2:] - lines[:, :2]).T[::-1])
        for body, (x, y), turn, height in zip(
            self._bodies, self._centre.tolist(), yaw.tolist(), self._height, strict=True
        ):
            upright = (0.0, 0.0, math.sin(turn / 2), math.cos(turn / 2))
            self._bullet.resetBasePositionAndOrientation(body, (x, y, height / 2), upright)

    def near(self, place: Float, reach: float) -> list[int]:
        """The bodies of leaves within `reach` metres of any point f8[n,2] of the plane."""
        if not self._bodies or not len(place):
            return []
        gap = np.hypot(*(self._centre[:, None] - place).transpose(2, 0, 1)).min(axis=1) - self._reach
        return [self._bodies[index] for index in np.flatnonzero(gap <= reach).tolist()]

    def _parts(self, state: Mapping[str, float]) -> Iterator[tuple[OperatedDoor, int, Float]]:
        for gate in self._facilities.doors:
            for level in gate.levels:
                yield gate, level, leaf_segments(gate.door, self._facilities.opening(gate, state, level))

    def _lines(self, state: Mapping[str, float]) -> tuple[Float, list[float]]:
        """Centre lines f8[k,4] in the plane of all leaves, and their heights."""
        lines, heights = [np.empty((0, 4))], []
        for gate, level, line in self._parts(state):
            lines.append(
                self._layout.to_plane(line.reshape(-1, 2), np.full(2 * len(line), level, np.int16)).reshape(-1, 4)
            )
            heights += [gate.door.height] * len(line)
        return np.concatenate(lines), heights
