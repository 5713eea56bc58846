"""Everything solid on a level of a world as line segments. Every simulator and ray caster reads it from here."""

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.intervals import runs
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import World


def segments(world: World, level: int = 0) -> Float:
    """Return the outlines of everything solid on a level: x1, y1, x2, y2 f8[S,4] in metres, solid on their left.

    A wall gives the sides of its box, an obstacle the sides of its polygon, an occupancy raster the borders between
    blocked and free cells. A raster is solid outside its edge. Outlines of different solids may overlap. Doors are not
    included.
    """
    here = world.levels[level]
    parts = [wall_boxes(here.walls, here.wall_thickness)]
    parts += [polygon_outline(obstacle.polygon) for obstacle in here.obstacles]
    if here.occupancy is not None:
        parts.append(raster_outline(here.occupancy))
    return np.concatenate(parts)


def wall_boxes(walls: Float, thickness: float) -> Float:
    """Return the sides f8[4W,4] of boxes around centre lines f8[W,4], longer by half the thickness at both ends."""
    start, end = walls[:, :2], walls[:, 2:]
    length = np.hypot(*(end - start).T)[:, None]
    along = np.where(length > 0, (end - start) / np.where(length > 0, length, 1.0), (1.0, 0.0)) * thickness / 2
    left = along[:, ::-1] * (-1.0, 1.0)
    corners = np.stack([start - along - left, end + along - left, end + along + left, start - along + left], axis=1)
    return np.concatenate([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 4)


def polygon_outline(polygon: Float) -> Float:
    """Return the sides f8[k,4] of a polygon f8[k,2] in counter-clockwise order."""
    ahead = np.roll(polygon, -1, axis=0)
    sides = np.concatenate([polygon, ahead], axis=1)
    if (polygon[:, 0] * ahead[:, 1] - polygon[:, 1] * ahead[:, 0]).sum() < 0:
        return sides[:, [2, 3, 0, 1]]
    return sides


def raster_outline(occupancy: Occupancy) -> Float:
    """Return the borders f8[S,4] between blocked and free cells, joined into the longest straight segments."""
    rows, columns = occupancy.shape
    solid = np.ones((rows + 2, columns + 2), bool)
    solid[1:-1, 1:-1] = occupancy.blocked
    parts = []
    for grid, across in ((solid, False), (solid.T, True)):
        below, above = grid[:-1, 1:-1], grid[1:, 1:-1]
        # Along +x of `grid` the left side is above; transposing swaps left and right.
        for border, forward in ((above & ~below, not across), (below & ~above, across)):
            line, first, last = runs(border)
            ends = [first, line, last, line] if forward else [last, line, first, line]
            parts.append(np.stack([ends[1], ends[0], ends[3], ends[2]] if across else ends, axis=1))
    cells = np.concatenate(parts).astype(float)
    outline: Float = cells * occupancy.resolution + np.tile(occupancy.origin, 2)
    return outline
