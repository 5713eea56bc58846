"""The plan filter `mrp_bench_stairs`: robots cut the corners of staircases.

MRP-Bench does this to schedules on its grid (`smoothPath`; Schaefer et al., "A Benchmark for Multi-Robot Planning in
Realistic, Complex and Cluttered Environments", ICRA 2023): if a waypoint and the next but one are as far apart in x as
in y, the waypoint between them is removed. So is one of two equal waypoints.
"""

import attrs
import numpy as np

from mrpbench_core.api.plan_filter import PlanFilter
from mrpbench_core.model.common.arrays import Bool, Float

_EQUAL = 1e-6
"""metres."""


@attrs.frozen(kw_only=True)
class Stairs(PlanFilter):
    """Removes the corners of staircases."""

    def keep(self, waypoint: Float) -> Bool:
        """Scan from the start: from a kept waypoint, look at the next but one."""
        kept: Bool = np.ones(len(waypoint), bool)
        at = 0
        while at + 2 < len(waypoint):
            across, up = np.abs(waypoint[at + 2] - waypoint[at])
            if abs(across - up) <= _EQUAL:
                kept[at + 1] = False
                at += 2
            else:
                at += 1
        return kept
