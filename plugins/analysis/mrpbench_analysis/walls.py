"""Finds poses inside walls, which a wrong map, frame or localization leads to."""

from collections.abc import Iterator, Sequence

import numpy as np

from mrpbench_core.checking.occupancy import bounds, rasterise
from mrpbench_core.model.common.arrays import Bool, Float, Int16
from mrpbench_core.model.worlds.world import Level, World

CELL = 0.05
"""metres, of the raster in which poses are looked up."""
MOST_CELLS = 4_000
"""Cells along a side of the raster; larger levels have larger cells."""


def poses_in_walls(names: Sequence[str], time: Float, truth: Float, level: Int16 | None, world: World) -> Iterator[str]:
    """Say of each robot whose centre is inside something solid how long, when first and where.

    Args:
        names: of the robots.
        time: f8[T] seconds of the samples.
        truth: f8[T,n,3] poses in `map`; NaN = unknown.
        level: i2[T,n] index of the level; None = unknown, then nothing is said.
        world: its doors count as open.
    """
    if level is None:
        return
    inside = np.zeros(truth.shape[:2], bool)
    for index, storey in enumerate(world.levels):
        here = (level == index) & np.isfinite(truth[..., :2]).all(axis=-1)
        inside[here] = _solid(storey, truth[here][:, :2])
    lasts = np.diff(time, append=time[-1])
    for robot, name in enumerate(names):
        samples = np.flatnonzero(inside[:, robot])
        if len(samples):
            x, y = truth[samples[0], robot, :2]
            where = f" on {world.levels[level[samples[0], robot]].name}" if len(world.levels) > 1 else ""
            yield (
                f"{name} is inside walls or obstacles for {lasts[samples].sum():.1f} s, "
                f"first at {time[samples[0]]:.1f} s"
                f" at ({x:.2f}, {y:.2f}){where}: the world, the frame or the localization may be wrong"
            )


def _solid(level: Level, place: Float) -> Bool:
    """Tell which places f8[k,2] are in solid cells; nothing is known, and so nothing solid, outside the raster."""
    low, high = bounds(level)
    occupancy = level.occupancy
    raster = rasterise(level, max(occupancy.resolution if occupancy else CELL, float((high - low).max()) / MOST_CELLS))
    cell = np.floor((place - raster.origin) / raster.resolution).astype(int)[:, ::-1]
    within = ((cell >= 0) & (cell < raster.shape)).all(axis=-1)
    solid = np.zeros(len(place), bool)
    solid[within] = raster.blocked[cell[within, 0], cell[within, 1]]
    return solid
