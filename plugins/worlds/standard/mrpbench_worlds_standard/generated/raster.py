"""Rasters and random numbers of generated worlds."""

import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Level, World

CELL_SIZE = 0.4
"""metres; wide enough for one small robot."""
LIMIT = 10_000_000
"""Largest number of cells of a world."""


def free_raster(rows: int, columns: int) -> Bool:
    """Return a raster bool[rows, columns] without a blocked cell.

    Raises:
        InputError: the raster would have too many cells.
    """
    if rows * columns > LIMIT:
        raise InputError(f"the world would have {rows} × {columns} cells; the limit is {LIMIT}")
    return np.zeros((rows, columns), bool)


def raster_world(name: str, blocked: Bool, resolution: float) -> World:
    """Return a world of one level without places; scenarios draw from all cells."""
    return World(name=name, levels=(Level(name="L1", occupancy=Occupancy(blocked=blocked, resolution=resolution)),))


def chances(seed: int, count: int) -> Float:
    """Return random numbers f8[count] in [0, 1) that are the same in every version of NumPy."""
    drawn: Float = np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed % 2**64))).random(count)
    return drawn
