"""LastPlanFilter: straight lines without stops on the way."""

import attrs
import numpy as np
from mrpbench_core.api import PlanFilter, option
from mrpbench_core.model.common.arrays import Bool, Float


@attrs.frozen(kw_only=True)
class LastPlanFilter(PlanFilter):
    """Removes each waypoint at which a robot goes straight on; waypoints at which it waits stay."""

    angle: float = option(0.01, help="largest bend of what counts as straight", validator=attrs.validators.ge(0))

    def keep(self, waypoint: Float) -> Bool:
        """Tell which waypoints are ends, bends or waits."""
        kept: Bool = np.ones(len(waypoint), bool)
        step = np.diff(waypoint, axis=0)
        before, after = step[:-1], step[1:]
        across = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
        along = (before * after).sum(axis=1)
        kept[1:-1] = (along <= 0) | (np.abs(np.arctan2(across, along)) > self.angle)
        return kept
