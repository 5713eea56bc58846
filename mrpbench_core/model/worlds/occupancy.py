"""An occupancy raster in the map frame."""

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, array

CELL_SIZES = 0.01, 100
"""Least and largest side of a cell that a configuration may choose, metres."""


@attrs.frozen(kw_only=True)
class Occupancy:
    """A raster of free and blocked square cells.

    Row 0 is the lowest y, column 0 the lowest x (the order of `nav_msgs/OccupancyGrid`).
    """

    blocked: Bool = array("?")
    """bool[rows, columns]."""
    resolution: float = attrs.field(metadata={"recorded_as": "cell_size"})
    """Side of a cell, metres (`map_server`'s word)."""
    origin: tuple[float, float] = (0.0, 0.0)
    """x, y of the lower left corner of cell (0, 0), metres."""

    @property
    def shape(self) -> tuple[int, int]:
        """Rows, columns."""
        rows, columns = self.blocked.shape
        return int(rows), int(columns)

    def cells(self, points: Float) -> Int:
        """Row and column i8[n,2] of the cells that hold `points` f8[n,2]; may lie outside the raster."""
        offset = (np.atleast_2d(points) - self.origin) / self.resolution
        return np.floor(offset[:, ::-1]).astype(np.int64)

    def centres(self, cells: Int) -> Float:
        """Centres f8[n,2] (x, y) of `cells` i8[n,2] (row, column)."""
        centres: Float = (np.atleast_2d(cells)[:, ::-1] + 0.5) * self.resolution + np.asarray(self.origin)
        return centres
