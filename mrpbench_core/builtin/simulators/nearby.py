"""A grid of cells for finding the segments near a point."""

import math

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.geometry import point_segment_distance

_CELL = 1.0
"""metres."""


class Nearby:
    """The segments f8[S,4] near each square cell of the plane, computed when the cell is first needed."""

    def __init__(self, segments: Float, reach: float) -> None:
        self._segments = segments
        self._reach = reach + _CELL * math.sqrt(0.5)
        self._cells: dict[tuple[int, int], Float] = {}

    def __call__(self, x: float, y: float) -> Float:
        """All segments f8[k,4] within `reach` of a point (and some that are farther), in their order."""
        cell = math.floor(x / _CELL), math.floor(y / _CELL)
        segments = self._cells.get(cell)
        if segments is None:
            centre = np.array([(cell[0] + 0.5) * _CELL, (cell[1] + 0.5) * _CELL])
            distance = point_segment_distance(centre, self._segments[:, :2], self._segments[:, 2:])
            segments = self._cells[cell] = self._segments[distance <= self._reach]
        return segments
