"""Prisms as triangles, for formats that have no boxes."""

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_world.solids import Prism


def mesh(prism: Prism) -> tuple[Float, Int]:
    """Corners f8[2k,3] and triangles i8[4k-4,3], counter-clockwise seen from outside."""
    count = len(prism.base)
    corners = np.vstack([np.column_stack([prism.base, np.full(count, z)]) for z in (prism.bottom, prism.top)])
    fan = np.array([(0, index, index + 1) for index in range(1, count - 1)])
    ahead = np.roll(np.arange(count), -1)
    here = np.arange(count)
    sides = np.concatenate(
        [np.column_stack([here, ahead, ahead + count]), np.column_stack([here, ahead + count, here + count])]
    )
    return corners, np.concatenate([fan[:, ::-1], fan + count, sides])
