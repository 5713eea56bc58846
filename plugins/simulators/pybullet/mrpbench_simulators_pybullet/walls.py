"""Everything solid as static triangle meshes; one concave mesh is several times faster than many boxes."""

import numpy as np
from mrpbench_simulators_bodies.scene import HEIGHT

from mrpbench_core.model.common.arrays import Float
from mrpbench_simulators_pybullet.bullet import Bullet, Group

_SEGMENTS = 10_000
"""Per mesh; Bullet's shared memory holds about three times as many."""


def build_walls(bullet: Bullet, segments: Float) -> tuple[int, ...]:
    """Raise segments f8[S,4] to vertical walls; returns the bodies they are."""
    bodies = []
    for first in range(0, len(segments), _SEGMENTS):
        body = bullet.body(Group.WALLS, build_mesh(bullet, segments[first : first + _SEGMENTS]))
        bullet.changeDynamics(body, -1, lateralFriction=0, restitution=0)
        bodies.append(body)
    return tuple(bodies)


def build_mesh(bullet: Bullet, segments: Float) -> int:
    """A shape of one vertical face per segment f8[S,4]."""
    corners = np.zeros((len(segments), 4, 3))  # start and end on the floor, then end and start on top
    corners[:, [0, 3], :2] = segments[:, None, :2]
    corners[:, [1, 2], :2] = segments[:, None, 2:]
    corners[:, 2:, 2] = HEIGHT
    triangles = np.arange(len(segments))[:, None] * 4 + (0, 1, 2, 0, 2, 3)
    shape: int = bullet.createCollisionShape(
        bullet.module.GEOM_MESH,
        vertices=corners.reshape(-1, 3).tolist(),
        indices=triangles.ravel().tolist(),
        flags=bullet.module.GEOM_FORCE_CONCAVE_TRIMESH,
    )
    return shape
