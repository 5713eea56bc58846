"""Occupancy as the original MRP-Bench took it: by vertical rays through the world in three dimensions.

It is the other way to what `mrpbench_core.checking.occupancy.rasterise` computes, and holds it to account: one ray down
through the middle of each cell, from above everything to a millimetre above the floor; what it meets blocks the cell.
Holes in the floor, which rays do not meet, are not seen.
"""

import attrs
import numpy as np

from mrpbench_core.model.arrays import Bool, Float, Int
from mrpbench_core.model.geometry import inside, side
from mrpbench_core.model.occupancy import Occupancy
from mrpbench_core.model.solids import wall_boxes
from mrpbench_core.model.world import Level
from mrpbench_simulators_pybullet.bullet import Bullet, Group, quiet

_ABOVE, _BELOW = 10.0, 0.001
"""metres, the original's."""
_BATCH = 16_000
"""Rays per call; PyBullet takes 16,383."""
_TRIANGLES = 20_000
"""Per mesh."""


def occupancy_by_rays(level: Level, raster: Occupancy) -> Occupancy:
    """A level on the cells of `raster`, whose own values are not read; doors are open.

    Raises:
        InputError: PyBullet is not installed.
    """
    bullet = Bullet()
    try:
        with quiet():
            triangles = _triangles(level)
            for first in range(0, len(triangles), _TRIANGLES):
                bullet.body(Group.WALLS, _mesh(bullet, triangles[first : first + _TRIANGLES]))
        cells = np.argwhere(np.ones(raster.shape, bool))
        hit = _cast(bullet, raster.centres(cells))
    finally:
        bullet.close()
    return attrs.evolve(raster, blocked=hit.reshape(raster.shape))


def _cast(bullet: Bullet, points: Float) -> Bool:
    """bool[k]: whether rays down on points f8[k,2] meet anything."""
    hit = np.zeros(len(points), bool)
    for first in range(0, len(points), _BATCH):
        part = points[first : first + _BATCH]
        start = np.column_stack([part, np.full(len(part), _ABOVE)])
        end = np.column_stack([part, np.full(len(part), _BELOW)])
        met = bullet.rayTestBatch(start, end)
        hit[first : first + _BATCH] = [ray[0] >= 0 for ray in met]
    return hit


def _triangles(level: Level) -> Float:
    """The faces f8[k,3,3] of everything solid: sides, and tops, which rays from above meet."""
    boxes = wall_boxes(level.walls, level.wall_thickness).reshape(-1, 4, 4)[:, :, :2]
    prisms = [(box, level.wall_height) for box in boxes]
    prisms += [(obstacle.polygon, obstacle.height) for obstacle in level.obstacles]
    if level.occupancy is not None:
        prisms += [(box, level.wall_height) for box in _runs(level.occupancy)]
    faces = [np.empty((0, 3, 3))]
    for polygon, height in prisms:
        corners = counter_clockwise(polygon)
        low, high = (np.column_stack([corners, np.full(len(corners), z)]) for z in (0.0, height))
        ahead_low, ahead_high = np.roll(low, -1, axis=0), np.roll(high, -1, axis=0)
        faces += [np.stack([low, ahead_low, ahead_high], axis=1), np.stack([low, ahead_high, high], axis=1)]
        faces.append(high[ears(corners)])
    return np.concatenate(faces)


def _runs(occupancy: Occupancy) -> Float:
    """Rectangles f8[k,4,2] of the blocked cells that lie side by side in a row."""
    padded = np.pad(occupancy.blocked, ((0, 0), (1, 1))).astype(np.int8)
    change = np.diff(padded, axis=1)
    row, first = np.nonzero(change == 1)
    last = np.nonzero(change == -1)[1]
    corners = np.stack([(first, row), (last, row), (last, row + 1), (first, row + 1)]).transpose(2, 0, 1)
    boxes: Float = corners * occupancy.cell_size + np.asarray(occupancy.origin)
    return boxes


def counter_clockwise(polygon: Float) -> Float:
    """The same polygon f8[k,2], turned round if need be."""
    ahead = np.roll(polygon, -1, axis=0)
    area = (polygon[:, 0] * ahead[:, 1] - polygon[:, 1] * ahead[:, 0]).sum()
    return polygon if area >= 0 else polygon[::-1]


def ears(polygon: Float) -> Int:
    """Corners i8[k-2,3] of triangles that fill a simple polygon f8[k,2], counter-clockwise: ears are cut off.

    G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82, 1975.
    """
    left = list(range(len(polygon)))
    found = []
    while len(left) > 3:
        for place in range(len(left)):
            ear = [left[place - 1], left[place], left[(place + 1) % len(left)]]
            others = polygon[[index for index in left if index not in ear]]
            if side(*polygon[ear]) >= 0 and not inside(polygon[ear], others).any():
                break
        found.append(ear)
        left.remove(ear[1])
    return np.array([*found, left], np.int64)


def _mesh(bullet: Bullet, triangles: Float) -> int:
    shape: int = bullet.createCollisionShape(
        bullet.module.GEOM_MESH,
        vertices=triangles.reshape(-1, 3).tolist(),
        indices=list(range(3 * len(triangles))),
        flags=bullet.module.GEOM_FORCE_CONCAVE_TRIMESH,
    )
    return shape
