"""Tells whether robots, as discs, keep clear of walls, obstacles, holes and blocked cells of a level.

Each of these is a closed polygon. A disc of radius r that moves straight from p to q keeps clear of a polygon if p is
outside and no side is closer than r to the segment p-q; touching at exactly r is allowed.
"""

import numpy as np

from mrpbench_core.checking.tiles import Tiles
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.common.geometry import inside, segment_distance
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.solids import wall_boxes
from mrpbench_core.model.worlds.world import Level

TOLERANCE = 1e-9
"""Metres by which a disc may overlap a polygon because of rounding."""


def solids(level: Level) -> list[Float]:
    """Outlines f8[k,2] of walls, obstacles and holes in the floor; blocked cells are not included."""
    boxes = wall_boxes(level.walls, level.wall_thickness).reshape(-1, 4, 4)[:, :, :2]
    return [*boxes, *(obstacle.polygon for obstacle in level.obstacles), *(hole.polygon for hole in level.holes)]


def has_clearance(level: Level, start: Float, end: Float, radius: float) -> Bool:
    """Tell bool[k] whether a disc of `radius` metres moving straight from `start` to `end` f8[k,2] touches nothing."""
    start, end = np.asarray(start, float).reshape(-1, 2), np.asarray(end, float).reshape(-1, 2)
    clear = np.ones(len(start), bool)
    low, high = np.minimum(start, end) - radius, np.maximum(start, end) + radius
    nearby = Tiles(low, high)
    for outline in solids(level):
        least, most = outline.min(axis=0) - TOLERANCE, outline.max(axis=0) + TOLERANCE
        chosen = nearby(least, most)
        near = (high[chosen] >= least).all(axis=1) & (low[chosen] <= most).all(axis=1)
        chosen = chosen[near & clear[chosen]]
        clear[chosen] = ~_touches(outline[None], start[chosen], end[chosen], radius)
    if level.occupancy is not None:
        left = np.flatnonzero(clear)
        clear[left] = _clear_of_cells(level.occupancy, start[left], end[left], radius)
    return clear


def touches(outline: Float, start: Float, end: Float, radius: float) -> Bool:
    """Tell bool[k] whether a disc moving from `start` to `end` f8[k,2] touches a polygon f8[c,2], even a flat one."""
    low, high = np.minimum(start, end) - radius, np.maximum(start, end) + radius
    near = np.flatnonzero((high >= outline.min(axis=0)).all(axis=1) & (low <= outline.max(axis=0)).all(axis=1))
    met = np.zeros(len(start), bool)
    met[near] = _touches(outline[None], start[near], end[near], radius)
    return met


def _touches(outline: Float, start: Float, end: Float, radius: float) -> Bool:
    """bool[k] for outlines f8[k or 1,sides,2]: whether the moving disc touches the polygon."""
    after = np.roll(outline, -1, axis=1)
    gap = segment_distance(outline, after, start[:, None], end[:, None]).min(axis=1)
    touching: Bool = inside(outline, start) | (gap <= max(radius - TOLERANCE, 0.0))
    return touching


def _clear_of_cells(occupancy: Occupancy, start: Float, end: Float, radius: float) -> Bool:
    """bool[k] for blocked cells; long moves are cut into pieces so that their bounding boxes stay small."""
    size = occupancy.resolution
    pieces = np.maximum(1, np.ceil(np.hypot(*(end - start).T) / (4 * size))).astype(np.int64)
    sweep = np.repeat(np.arange(len(start)), pieces)
    part = np.arange(len(sweep)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    step = ((end - start) / pieces[:, None])[sweep]
    p = start[sweep] + part[:, None] * step
    clear = np.ones(len(start), bool)
    clear[sweep[_pieces_touch(occupancy, p, p + step, radius)]] = False
    return clear


def _pieces_touch(occupancy: Occupancy, start: Float, end: Float, radius: float) -> Bool:
    touching = np.zeros(len(start), bool)
    if not len(start):
        return touching
    first = occupancy.cells(np.minimum(start, end) - radius)
    span = occupancy.cells(np.maximum(start, end) + radius) - first
    square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]) * occupancy.resolution
    for row in range(int(span[:, 0].max()) + 1):
        for column in range(int(span[:, 1].max()) + 1):
            cell = first + (row, column)
            there = (span >= (row, column)).all(axis=1) & ~touching & _blocked(occupancy, cell)
            chosen = np.flatnonzero(there)
            corner = cell[chosen][:, ::-1] * occupancy.resolution + np.asarray(occupancy.origin)
            touching[chosen] = _touches(corner[:, None] + square, start[chosen], end[chosen], radius)
    return touching


def _blocked(occupancy: Occupancy, cells: Int) -> Bool:
    """bool[k]; cells outside the raster count as blocked."""
    rows, columns = occupancy.shape
    row, column = cells[:, 0], cells[:, 1]
    inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
    blocked: Bool = ~inside | occupancy.blocked[np.where(inside, row, 0), np.where(inside, column, 0)]
    return blocked
