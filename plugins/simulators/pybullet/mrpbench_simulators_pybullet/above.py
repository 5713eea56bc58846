"""Occupancy as the original benchmark found it: by vertical rays through the 3D world, one per cell.

Schaefer et al., "A Benchmark for Multi-Robot Planning in Realistic, Complex and Cluttered Environments", ICRA 2023. It
uses no outlines, only what a ray hits, and so serves to check `mrpbench_core.checking.occupancy`, which needs no
simulator.
"""

import math
from itertools import pairwise

import attrs
import numpy as np
from mrpbench_simulators_bodies.polygons import row_rectangles, triangulate
from mrpbench_simulators_bodies.scene import HEIGHT

from mrpbench_core.checking.occupancy import bounds
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.solids import wall_boxes
from mrpbench_core.model.worlds.world import Level
from mrpbench_simulators_pybullet.bullet import SEEN, Bullet, Group, quiet

ABOVE = 1.0
"""metres above the highest roof at which rays begin."""
FLOOR = 0.01
"""metres above the floor at which they end."""
_TRIANGLES = 10_000
"""Per mesh."""
_BATCH = 16_000
"""Rays per call; PyBullet takes no more than 16,383."""


def occupancy_from_above(
    level: Level,
    resolution: float,
    origin: tuple[float, float] | None = None,
    shape: tuple[int, int] | None = None,
) -> Occupancy:
    """Rasterise walls, obstacles and the level's own raster: a cell is blocked if a ray down its middle hits something.

    Doors are open, as in `mrpbench_core.checking.occupancy.rasterise`, whose arguments these are. Rays do not
    hit holes in the floor, nor anything beyond a level's own raster.

    Raises:
        InputError: PyBullet is not installed.
    """
    low, high = bounds(level)
    origin = (float(low[0]), float(low[1])) if origin is None else origin
    if shape is None:
        across, up = ((high - origin) / resolution - 1e-9).tolist()
        shape = (max(1, math.ceil(up)), max(1, math.ceil(across)))
    blank = Occupancy(blocked=np.zeros(shape, bool), resolution=resolution, origin=origin)
    triangles = roofs(level)
    if not len(triangles):
        return blank
    bullet = Bullet()
    try:
        with quiet():
            _build(bullet, triangles)
        centres = blank.centres(np.argwhere(~blank.blocked))
        hit = _hit(bullet, centres, float(triangles[..., 2].max()) + ABOVE)
    finally:
        bullet.close()
    return attrs.evolve(blank, blocked=hit.reshape(shape))


def roofs(level: Level) -> Float:
    """Triangles f8[k,3,3] that cover everything solid from above, each at its height in metres."""
    boxes = wall_boxes(level.walls, level.wall_thickness).reshape(-1, 4, 4)[:, :, :2]
    covers = [(box, HEIGHT) for box in boxes]
    covers += [(obstacle.polygon, obstacle.height) for obstacle in level.obstacles]
    if level.occupancy is not None:
        covers += [(run, HEIGHT) for run in row_rectangles(level.occupancy)]
    parts = [np.empty((0, 3, 3))]
    for polygon, height in covers:
        flat = triangulate(np.asarray(polygon))
        parts.append(np.concatenate([flat, np.full((len(flat), 3, 1), height)], axis=2))
    return np.concatenate(parts)


def _build(bullet: Bullet, triangles: Float) -> None:
    for first, last in pairwise([*range(0, len(triangles), _TRIANGLES), len(triangles)]):
        part = triangles[first:last]
        shape = bullet.createCollisionShape(
            bullet.module.GEOM_MESH,
            vertices=part.reshape(-1, 3).tolist(),
            indices=list(range(3 * len(part))),
            flags=bullet.module.GEOM_FORCE_CONCAVE_TRIMESH,
        )
        bullet.body(Group.WALLS, shape)


def _hit(bullet: Bullet, points: Float, top: float) -> Bool:
    """Tell bool[k] whether rays straight down at `points` f8[k,2] hit anything."""
    start, end = (np.column_stack([points, np.full(len(points), z)]) for z in (top, FLOOR))
    hits: list[bool] = []
    for first in range(0, len(points), _BATCH):
        part = slice(first, first + _BATCH)
        rays = bullet.rayTestBatch(start[part], end[part], collisionFilterMask=int(SEEN))
        hits += [ray[0] >= 0 for ray in rays]
    return np.array(hits, bool)
