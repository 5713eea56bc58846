"""The occupancy raster of one level: every cell that a wall or an obstacle touches."""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import World

MARGIN = 0.5
"""metres around the outermost wall."""
MOST_CELLS = 2**24
"""Worlds that would need more get larger cells: a viewer holds a map in memory."""


def rasterise(world: World, index: int, resolution: float) -> Occupancy:
    """Return the raster of level `index`; one that is a raster by nature keeps its cells and gets its walls added."""
    level = world.levels[index]
    shapes = [wall_outline(wall, level.wall_thickness) for wall in level.walls]
    shapes += [obstacle.polygon for obstacle in level.obstacles]
    if level.occupancy is not None:
        resolution, origin = level.occupancy.resolution, level.occupancy.origin
        blocked = level.occupancy.blocked.copy()
    else:
        low, high = _extent(world, index, shapes)
        while np.prod(np.ceil((high - low) / resolution)) > MOST_CELLS:
            resolution *= 2
        first = np.floor(low / resolution)
        columns, rows = (np.ceil(high / resolution) - first).astype(int)
        origin = (float(first[0] * resolution), float(first[1] * resolution))
        blocked = np.zeros((rows, columns), bool)
    for shape in shapes:
        block(blocked, (shape - origin) / resolution)
    return Occupancy(blocked=blocked, resolution=resolution, origin=origin)


def wall_outline(wall: Float, thickness: float) -> Float:
    """Corners f8[4,2] of the box around a centre line x1, y1, x2, y2, extended by half the thickness at both ends."""
    start, end = wall[:2], wall[2:]
    length = float(np.hypot(*(end - start)))
    along = (end - start) / length if length > 0 else np.array([1.0, 0.0])
    along = along * thickness / 2
    across = np.array([-along[1], along[0]])
    return np.array([start - along - across, end + along - across, end + along + across, start - along + across])


def block(blocked: Bool, polygon: Float) -> None:
    """Block every cell that `polygon` f8[k,2], in cells (x, y) from the lower left corner, touches with its inside."""
    rows, columns = blocked.shape
    left, bottom = np.clip(np.floor(polygon.min(axis=0)).astype(int), 0, (columns, rows))
    right, top = np.clip(np.ceil(polygon.max(axis=0)).astype(int), 0, (columns, rows))
    x, y = np.meshgrid(np.arange(left, right) + 0.5, np.arange(bottom, top) + 0.5)
    covered = np.zeros(x.shape, bool)
    for (x1, y1), (x2, y2) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        if y1 != y2:  # even-odd rule: an edge to the right of the centre switches inside and outside
            covered ^= ((y1 > y) != (y2 > y)) & (x < x1 + (y - y1) * (x2 - x1) / (y2 - y1))
    for (x1, y1), (x2, y2) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        covered |= _crosses(x, y, x1, y1, x2, y2)
    blocked[bottom:top, left:right] |= covered


def _crosses(x: Float, y: Float, x1: float, y1: float, x2: float, y2: float) -> Bool:
    """Tell for each unit cell with centre x, y whether the segment passes through its inside (separating axes)."""
    eps = 1e-9
    dx, dy = x2 - x1, y2 - y1
    beside = np.abs(dx * (y - y1) - dy * (x - x1)) < (abs(dx) + abs(dy)) / 2 - eps
    within_x = (x + 0.5 - eps > min(x1, x2)) & (x - 0.5 + eps < max(x1, x2))
    within_y = (y + 0.5 - eps > min(y1, y2)) & (y - 0.5 + eps < max(y1, y2))
    crosses: Bool = beside & within_x & within_y
    return crosses


def _extent(world: World, index: int, shapes: list[Float]) -> tuple[Float, Float]:
    """Lower left and upper right corner f8[2] of all that stands on a level, with a margin."""
    places = [[vertex.x, vertex.y] for vertex in world.vertices if vertex.level == index]
    points = np.concatenate([*shapes, np.array(places or [[0.0, 0.0]])])
    return points.min(axis=0) - MARGIN, points.max(axis=0) + MARGIN
