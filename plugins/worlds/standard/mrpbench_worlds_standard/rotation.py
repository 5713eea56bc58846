"""Rotates rasters about their lower left corner."""

import math

import numpy as np

from mrpbench_core.model.worlds.occupancy import Occupancy

TOLERANCE = 1e-6
"""radians."""


def rotate(occupancy: Occupancy, angle: float) -> Occupancy:
    """Return the raster rotated counter-clockwise by `angle` radians about its origin, with axes parallel to x and y.

    Quarter turns are exact. Otherwise each new cell takes the value at its centre, and cells outside the raster are
    blocked.
    """
    (rows, columns), size = occupancy.shape, occupancy.resolution
    cosine, sine = math.cos(angle), math.sin(angle)
    corners = np.array([(0, 0), (columns, 0), (columns, rows), (0, rows)]) * size
    around = corners @ np.array([(cosine, sine), (-sine, cosine)])
    low, high = around.min(axis=0), around.max(axis=0)
    quarters = round(angle / (math.pi / 2))
    x, y = occupancy.origin
    origin = (x + float(low[0]), y + float(low[1]))
    if abs(angle - quarters * math.pi / 2) <= TOLERANCE:
        # row 0 is the lowest, so `rot90` rotates in the opposite direction
        blocked = np.rot90(occupancy.blocked, -quarters)
        return Occupancy(blocked=blocked, resolution=size, origin=origin)
    shape = np.ceil((high - low) / size - 1e-9).astype(int)
    dx = low[0] + (np.arange(shape[0]) + 0.5) * size
    blocked = np.empty((shape[1], shape[0]), bool)
    for row, dy in enumerate(low[1] + (np.arange(shape[1]) + 0.5) * size):  # by rows, which takes little memory
        across = np.floor((dx * cosine + dy * sine) / size).astype(int)
        up = np.floor((dy * cosine - dx * sine) / size).astype(int)
        inside = (across >= 0) & (across < columns) & (up >= 0) & (up < rows)
        blocked[row] = ~inside | occupancy.blocked[np.where(inside, up, 0), np.where(inside, across, 0)]
    return Occupancy(blocked=blocked, resolution=size, origin=origin)
