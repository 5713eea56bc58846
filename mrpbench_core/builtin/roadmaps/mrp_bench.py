"""The raster of the original benchmark, quirk by quirk, so that its Table I can be reproduced.

Schaefer, Palmieri, Heuer, Dillmann, Koenig, Kleiner, "A Benchmark for Multi-Robot Planning in Realistic, Complex and
Cluttered Environments", ICRA 2023. It differs from a clean raster: the walk between two cells compares only the
first two of its candidates, and depends on the direction; roads are widened where fewer than three of the *diagonal*
neighbours are open; and two passes along the lower and left border look at the neighbours of the opposite border.
"""

import math

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.builtin.roadmaps.cells import empty_raster
from mrpbench_core.checking.navigation import unique_edges
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import World

_BLOCKED, _ROAD, _VERTEX = 0, 1, 2
_STEPS = ((0, 1), (1, 0), (0, -1), (-1, 0))  # north, east, south, west
_Kinds = NDArray[np.int8]


def mrp_bench_raster(world: World, cell_size: float) -> Occupancy:
    """Return the original's raster over the vertices of `world`, with two-way roads."""
    point = np.array([(vertex.x, vertex.y) for vertex in world.vertices])
    low, high = point.min(axis=0), point.max(axis=0)
    raster = empty_raster(low, low + (np.ceil((high - low) / cell_size) + 1) * cell_size, cell_size)
    kind = np.zeros(raster.shape, np.int8)
    column, row = np.floor((point - low) / cell_size).astype(int).T.tolist()
    for a, b in unique_edges(world):
        start, end = (column[a], row[a]), (column[b], row[b])
        kind[row[a], column[a]] = kind[row[b], column[b]] = _VERTEX
        _walk(kind, start, end)
    _widen(kind)
    _widen_borders(kind)
    return Occupancy(blocked=kind == _BLOCKED, resolution=cell_size, origin=raster.origin)


def _walk(kind: _Kinds, start: tuple[int, int], end: tuple[int, int]) -> None:
    """Open cells from `start` to `end` (column, row) by steps that do not lead away and stay near the line."""
    here = start
    while here != end:
        steps = [(here[0] + dx, here[1] + dy) for dx, dy in _STEPS]
        steps = [step for step in steps if math.dist(step, end) <= math.dist(here, end)]
        here = steps[0]
        if len(steps) > 1 and not _off_line(steps[0], start, end) < _off_line(steps[1], start, end):
            here = steps[1]
        if kind[here[1], here[0]] == _BLOCKED:
            kind[here[1], here[0]] = _ROAD


def _off_line(point: tuple[int, int], start: tuple[int, int], end: tuple[int, int]) -> float:
    dx, dy = end[0] - start[0], end[1] - start[1]
    return abs(dx * (start[1] - point[1]) - (start[0] - point[0]) * dy) / math.hypot(dx, dy)


def _widen(kind: _Kinds) -> None:
    """Open the left and lower neighbours of narrow road cells, row by row; cells opened on the way count at once."""
    for row, column in np.argwhere(kind == _ROAD).tolist():  # cells opened meanwhile lie behind the scan
        if _is_narrow(kind, column, row):
            _open(kind, column - 1, row)
            _open(kind, column, row - 1)


def _widen_borders(kind: _Kinds) -> None:
    """Repeat the original's extra passes, with the loop variables that they take over from the scan."""
    rows, columns = kind.shape
    for column in range(columns):
        if kind[0, column] == _ROAD and _is_narrow(kind, column, rows - 1):
            _open(kind, column, 1)
    for row in range(rows):
        if kind[row, 0] == _ROAD and _is_narrow(kind, columns - 1, row):
            _open(kind, 1, row)


def _is_narrow(kind: _Kinds, column: int, row: int) -> bool:
    """Tell whether fewer than three diagonal neighbours are open; beyond the border, the border's own cells count."""
    rows, columns = kind.shape
    sides = [(row + dy, column + dx) for dy in (-1, 1) for dx in (-1, 1)]
    clamped = [(min(max(y, 0), rows - 1), min(max(x, 0), columns - 1)) for y, x in sides]
    return sum(int(kind[cell] != _BLOCKED) for cell in clamped) < 3


def _open(kind: _Kinds, column: int, row: int) -> None:
    rows, columns = kind.shape
    if 0 <= column < columns and 0 <= row < rows and kind[row, column] == _BLOCKED:
        kind[row, column] = _ROAD
