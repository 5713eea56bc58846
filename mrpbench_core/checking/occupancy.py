"""Rasterises a level: finds the cells that contain something solid."""

import math
from typing import Literal

import attrs
import numpy as np

from mrpbench_core.checking.clearance import solids
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.common.geometry import inside
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Level

LIMIT = 100_000_000
"""Cells."""
HAIR = 1e-9
"""Share of a cell by which something must reach over the border of a cell to be in it."""


def rasterise(
    level: Level,
    resolution: float,
    rule: Literal["centre", "touched"] = "centre",
    origin: tuple[float, float] | None = None,
    shape: tuple[int, int] | None = None,
) -> Occupancy:
    """Rasterise walls, obstacles, holes and the level's own raster; doors are open.

    Args:
        level: the level.
        resolution: metres.
        rule: `centre`: a cell is blocked if its centre lies in something solid, as a vertical ray finds it; `touched`:
            a cell is blocked if anything solid reaches into it.
        origin: lower left corner of the raster; by default that of everything solid.
        shape: rows and columns; by default enough to cover everything solid.

    Raises:
        InputError: the raster would have more than `LIMIT` cells.
    """
    occupancy = level.occupancy
    outlines = solids(level)
    if (
        occupancy is not None
        and not outlines
        and resolution == occupancy.resolution
        and origin is None
        and shape is None
    ):
        return occupancy
    low, high = bounds(level)
    origin = (float(low[0]), float(low[1])) if origin is None else origin
    if shape is None:
        across, up = ((high - origin) / resolution - HAIR).tolist()
        shape = (max(1, math.ceil(up)), max(1, math.ceil(across)))
    if shape[0] * shape[1] > LIMIT:
        raise InputError(f"a raster of {shape[0]} × {shape[1]} cells is too large", hint="choose larger cells")
    blank = Occupancy(blocked=np.zeros(shape, bool), resolution=resolution, origin=origin)
    blocked = blank.blocked.copy() if occupancy is None else _resampled(occupancy, blank, rule)
    for outline in outlines:
        first, last = _reach(blank, outline)
        rows, columns = np.arange(first[0], last[0]), np.arange(first[1], last[1])
        if not len(rows) or not len(columns):
            continue
        cells = np.stack(np.meshgrid(rows, columns, indexing="ij"), axis=-1).reshape(-1, 2)
        centres = blank.centres(cells)
        solid = inside(outline, centres)
        if rule == "touched":
            solid |= _crosses(outline, centres, resolution / 2 * (1 - HAIR))
        blocked[first[0] : last[0], first[1] : last[1]] |= solid.reshape(len(rows), len(columns))
    return attrs.evolve(blank, blocked=blocked)


def bounds(level: Level) -> tuple[Float, Float]:
    """Lower left and upper right corner of everything solid; both are (0, 0) for an empty level."""
    corners = solids(level)
    if level.occupancy is not None:
        rows, columns = level.occupancy.shape
        corners.append(level.occupancy.centres(np.array([(-0.5, -0.5), (rows - 0.5, columns - 0.5)])))
    points = np.concatenate(corners) if corners else np.zeros((1, 2))
    return points.min(axis=0), points.max(axis=0)


def _reach(raster: Occupancy, outline: Float) -> tuple[Int, Int]:
    """The first row and column that an outline may reach, and the row and column after the last."""
    first = np.clip(raster.cells(outline.min(axis=0))[0], 0, raster.shape)
    last = np.clip(raster.cells(outline.max(axis=0))[0] + 1, 0, raster.shape)
    return first, last


def _crosses(outline: Float, centres: Float, half: float) -> Bool:
    """bool[k]: whether a side of the outline runs through the open square around each centre (Liang, Barsky 1984)."""
    start = outline[None] - centres[:, None]
    along = np.roll(outline, -1, axis=0) - outline
    still = along == 0
    step = np.where(still, 1.0, along)
    with np.errstate(over="ignore"):  # infinitely far along is right for sides that hardly move
        near, far = (-half - start) / step, (half - start) / step
    enter, leave = np.minimum(near, far), np.maximum(near, far)
    within = np.abs(start) < half
    enter = np.where(still, np.where(within, -np.inf, np.inf), enter)
    leave = np.where(still, np.where(within, np.inf, -np.inf), leave)
    meets: Bool = (np.maximum(enter.max(axis=2), 0.0) < np.minimum(leave.min(axis=2), 1.0)).any(axis=1)
    return meets


def _resampled(source: Occupancy, raster: Occupancy, rule: str) -> Bool:
    """The level's own raster on the cells of another; beyond its edge it is solid."""
    solid = np.ones((source.shape[0] + 2, source.shape[1] + 2), bool)
    solid[1:-1, 1:-1] = source.blocked
    # rows and columns of `own` below each line of cells, and how many of its cells are blocked up to there
    total = np.zeros((solid.shape[0] + 1, solid.shape[1] + 1), np.int64)
    total[1:, 1:] = solid.cumsum(axis=0).cumsum(axis=1)
    spans = []
    for axis, cells in ((1, raster.shape[0]), (0, raster.shape[1])):
        low = (raster.origin[axis] - source.origin[axis] + np.arange(cells) * raster.resolution) / source.resolution
        width = raster.resolution / source.resolution
        if rule == "centre":
            first = np.floor(low + width / 2)
            last = first + 1
        else:
            first, last = np.floor(low + 1e-6), np.ceil(low + width - 1e-6)
        size = source.shape[1 - axis]
        spans.append((np.clip(first, -1, size).astype(int) + 1, np.clip(last, 0, size + 1).astype(int) + 1))
    (bottom, top), (left, right) = spans
    count = (
        total[np.ix_(top, right)]
        - total[np.ix_(bottom, right)]
        - total[np.ix_(top, left)]
        + total[np.ix_(bottom, left)]
    )
    blocked: Bool = count > 0
    return blocked
