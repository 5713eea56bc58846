"""Places the levels of a world side by side in one plane, so that planar simulators simulate all of them at once."""

from collections.abc import Mapping

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.model.worlds.solids import segments
from mrpbench_core.model.worlds.world import World

SPACING = 50.0
"""Metres between levels, in addition to the range of the lidars."""


class LevelLayout:
    """The offset of each level: level 0 keeps its coordinates, the others follow in a row along x.

    No lidar sees from one level to another as long as its range is at most `reach` metres.
    """

    def __init__(self, world: World, reach: float) -> None:
        solid = [segments(world, level) for level in range(len(world.levels))]
        xs = [part[:, [0, 2]].ravel() for part in solid]
        xs.append(np.array([vertex.x for vertex in world.vertices]))
        xs.append(np.array([lift.x for lift in world.lifts]))
        x = np.concatenate(xs)
        pitch = float(np.ptp(x)) + reach + SPACING if len(x) and len(solid) > 1 else 0.0
        self._shift = np.array([(level * pitch, 0.0) for level in range(len(solid))])
        self.segments = np.concatenate([self._shifted(part, level) for level, part in enumerate(solid)])
        """The outlines f8[S,4] of everything solid that does not move; see `mrpbench_core.model.worlds.solids`."""

    def _shifted(self, outline: Float, level: int) -> Float:
        apart: Float = outline + np.tile(self._shift[level], 2)
        return apart

    def to_plane(self, pose: Float, level: Int16) -> Float:
        """Return poses f8[n,2+] in the plane, of robots at `pose` f8[n,2+] on `level` i2[n]."""
        spread: Float = np.array(pose, float)
        if len(self._shift) > 1:
            spread[:, :2] += self._shift[level]
        return spread

    def to_levels(self, pose: Float, level: Int16) -> Float:
        """Return poses f8[n,2+] in the frame `map`, of robots at `pose` f8[n,2+] in the plane; maybe `pose` itself."""
        if len(self._shift) == 1:
            return pose
        gathered: Float = np.array(pose, float)
        gathered[:, :2] -= self._shift[level]
        return gathered

    def door_outlines(self, facilities: Facilities, state: Mapping[str, float]) -> Float:
        """Return the outlines f8[S,4] in the plane of the leaves of all doors."""
        levels = range(len(self._shift))
        return np.concatenate([self._shifted(facilities.outlines(state, level), level) for level in levels])
