"""The plan filter of the original MRP-Bench: robots cut the corners of staircases.

MRP-Bench does this to schedules on its grid (`smoothPath`; Schaefer et al., "A Benchmark for Multi-Robot Planning in
Realistic, Complex and Cluttered Environments", ICRA 2023): if a waypoint and the next but one are as far apart in x as
in y, the waypoint between them is removed. So is one of two equal waypoints.
"""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float

_EQUAL = 1e-6
"""metres."""


def without_stairs(waypoint: Float) -> Bool:
    """Tell bool[k] which waypoints f8[k,2] (metres, the start first) of one robot remain.

    The scan begins at the start: from a kept waypoint, it looks at the next but one.
    """
    mask: Bool = np.ones(len(waypoint), bool)
    at = 0
    while at + 2 < len(waypoint):
        across, up = np.abs(waypoint[at + 2] - waypoint[at])
        if abs(across - up) <= _EQUAL:
            mask[at + 1] = False
            at += 2
        else:
            at += 1
    return mask
