"""The levels of a world side by side in one plane, so that what moves in a plane moves on all of them."""

from collections.abc import Mapping

import numpy as np

from mrpbench_core.model.arrays import Float, Int16
from mrpbench_core.model.facilities import Facilities
from mrpbench_core.model.solids import segments
from mrpbench_core.model.world import World

APART = 50.0
"""Metres between levels, on top of what lidars reach."""


class Storeys:
    """Where each level lies: level 0 at its own place, the others in a row to its right.

    Nothing reaches from one to another, if lidars reach no farther than `reach` metres.
    """

    def __init__(self, world: World, reach: float) -> None:
        solid = [segments(world, level) for level in range(len(world.levels))]
        xs = [part[:, [0, 2]].ravel() for part in solid]
        xs.append(np.array([vertex.x for vertex in world.vertices]))
        xs.append(np.array([lift.x for lift in world.lifts]))
        x = np.concatenate(xs)
        pitch = float(np.ptp(x)) + reach + APART if len(x) and len(solid) > 1 else 0.0
        self._shift = np.array([(level * pitch, 0.0) for level in range(len(solid))])
        self.segments = np.concatenate([self._apart(part, level) for level, part in enumerate(solid)])
        """Everything solid that does not move, f8[S,4]; see `mrpbench_core.model.solids`."""

    def _apart(self, outline: Float, level: int) -> Float:
        apart: Float = outline + np.tile(self._shift[level], 2)
        return apart

    def spread(self, pose: Float, level: Int16) -> Float:
        """Poses f8[n,2+] of robots on `level` i2[n], in the plane."""
        spread: Float = np.array(pose, float)
        if len(self._shift) > 1:
            spread[:, :2] += self._shift[level]
        return spread

    def gather(self, pose: Float, level: Int16) -> Float:
        """Poses f8[n,2+] on their levels, from those in the plane."""
        gathered: Float = np.array(pose, float)
        if len(self._shift) > 1:
            gathered[:, :2] -= self._shift[level]
        return gathered

    def leaves(self, facilities: Facilities, state: Mapping[str, float]) -> Float:
        """Outlines f8[S,4] in the plane of all leaves of doors."""
        levels = range(len(self._shift))
        return np.concatenate([self._apart(facilities.outlines(state, level), level) for level in levels])
