"""Solids of a level as convex polygons."""

from collections.abc import Iterator

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.geometry import inside
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.solids import wall_boxes
from mrpbench_core.model.worlds.world import Level

_FRAME = 1.0
"""metres: the thickness of what is solid outside the edge of a raster."""


def convex_solids(level: Level) -> Iterator[tuple[str, Float]]:
    """Everything solid on a level that does not move, as convex polygons f8[k,2], counter-clockwise, that may overlap.

    Each with what it is a part of: `wall`, `obstacle i` or `block` (of a raster).
    """
    for box in wall_boxes(level.walls, level.wall_thickness).reshape(-1, 4, 4):
        yield "wall", box[:, :2]
    for index, obstacle in enumerate(level.obstacles):
        yield from ((f"obstacle {index}", part) for part in convex_parts(np.asarray(obstacle.polygon)))
    if level.occupancy is not None:
        yield from (("block", rectangle) for rectangle in raster_rectangles(level.occupancy))


def convex_parts(polygon: Float) -> list[Float]:
    """A simple polygon f8[c,2] itself if it is convex, else its triangles f8[3,2]; counter-clockwise."""
    x, y = polygon.T
    turn = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum()
    polygon = polygon if turn > 0 else polygon[::-1]
    before, after = polygon - np.roll(polygon, 1, axis=0), np.roll(polygon, -1, axis=0) - polygon
    bends = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    angle = np.arctan2(bends, (before * after).sum(axis=1)).sum()
    if (bends >= 0).all() and angle < 3 * np.pi:  # a star turns twice
        return [polygon]
    return [part for part in triangulate(polygon) if _area(part) > 1e-12]


def triangulate(polygon: Float) -> Float:
    """Triangles f8[c-2,3,2] of a simple polygon f8[c,2], by cutting off one ear after the other."""
    x, y = polygon.T
    turn = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum()
    left = polygon.tolist() if turn > 0 else polygon[::-1].tolist()
    ears = []
    while len(left) > 3:
        ear = next((index for index in range(len(left)) if _is_ear(left, index)), 0)
        ears.append([left[ear - 1], left[ear], left[(ear + 1) % len(left)]])
        del left[ear]
    return np.array([*ears, left], float)


def row_rectangles(occupancy: Occupancy) -> list[Float]:
    """Rectangles f8[4,2] over the blocked cells of each row."""
    return [_rectangle(occupancy, *run) for run in _runs(occupancy)]


def raster_rectangles(occupancy: Occupancy) -> list[Float]:
    """Rectangles f8[4,2] over the blocked cells, those of equal rows joined, and round the raster's edge."""
    rows, columns = occupancy.shape
    open_runs: dict[tuple[int, int], int] = {}
    rectangles = []
    by_row: dict[int, set[tuple[int, int]]] = {}
    for first, row, last, _ in _runs(occupancy):
        by_row.setdefault(row, set()).add((first, last))
    for row in range(rows + 1):
        here = by_row.get(row, set())
        for run in [run for run in open_runs if run not in here]:
            rectangles += [_rectangle(occupancy, run[0], open_runs.pop(run), run[1], row)]
        for run in here:
            open_runs.setdefault(run, row)
    margin = max(1, round(_FRAME / occupancy.resolution))
    for left, low, right, high in (
        (-margin, -margin, columns + margin, 0),
        (-margin, rows, columns + margin, rows + margin),
        (-margin, 0, 0, rows),
        (columns, 0, columns + margin, rows),
    ):
        rectangles.append(_rectangle(occupancy, left, low, right, high))
    return rectangles


def _runs(occupancy: Occupancy) -> list[tuple[int, int, int, int]]:
    """First column, row, last column + 1 and row + 1 of each run of blocked cells of a row."""
    runs = []
    for row, blocked in enumerate(occupancy.blocked):
        ends = np.flatnonzero(np.diff(np.concatenate([[0], blocked.astype(np.int8), [0]])))
        runs += [(first, row, last, row + 1) for first, last in ends.reshape(-1, 2).tolist()]
    return runs


def _rectangle(occupancy: Occupancy, left: int, low: int, right: int, high: int) -> Float:
    corners = np.array([(left, low), (right, low), (right, high), (left, high)], float)
    placed: Float = np.asarray(occupancy.origin) + occupancy.resolution * corners
    return placed


def _area(polygon: Float) -> float:
    x, y = polygon.T
    return abs(float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())) / 2


def _is_ear(corners: list[list[float]], index: int) -> bool:
    """Tell whether the triangle at a corner lies in the polygon: the corner is convex, and no other is in the way."""
    before, here, after = corners[index - 1], corners[index], corners[(index + 1) % len(corners)]
    if (here[0] - before[0]) * (after[1] - before[1]) - (here[1] - before[1]) * (after[0] - before[0]) <= 0:
        return False
    others = [corner for corner in corners if corner not in (before, here, after)]
    return not others or not inside(np.array([before, here, after]), np.array(others)).any()
