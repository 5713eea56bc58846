"""LastMetric: distance and speed of the robots."""

from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np
from mrpbench_core.api import Column, Metric, Value, option
from mrpbench_core.model.runs.run import FinishedRun


@attrs.frozen(kw_only=True)
class LastMetric(Metric):
    """Measures the true motion of all robots together."""

    columns: ClassVar[tuple[Column, ...]] = (
        Column("distance", "m", "lower", "total length of the true paths", primary=True),
        Column("mean_speed", "m/s", "higher", "distance divided by the time in motion"),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "truth"})

    moving: float = option(0.01, help="least speed of a moving robot", unit="m/s", validator=attrs.validators.ge(0))

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return both columns; the mean speed is null if no robot moved."""
        lasted = np.diff(run.channel("time"))[:, None]
        steps = np.diff(run.channel("truth")[..., :2], axis=0)
        length = np.hypot(steps[..., 0], steps[..., 1])
        moved = length > self.moving * lasted
        time = float((lasted * moved).sum())
        distance = float(length[moved].sum())
        return {"distance": distance, "mean_speed": distance / time if time > 0 else None}
