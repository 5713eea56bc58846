"""The distribution of delays over robots.

Jain, Chiu, Hawe, "A Quantitative Measure of Fairness and Discrimination for Resource Allocation in Shared Computer
Systems", DEC Research Report TR-301, 1984.
"""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.delay import delays
from mrpbench_metrics_standard.samples import measurable, nulls

JAIN = "Jain, Chiu, Hawe, A Quantitative Measure of Fairness and Discrimination, DEC-TR-301, 1984"


@attrs.frozen(kw_only=True)
class Fairness(Metric):
    """Measures how evenly the delays (see `delay`) are distributed; a robot that is early has delay 0."""

    columns: ClassVar[tuple[Column, ...]] = (
        Column(
            "jain",
            "",
            "higher",
            "square of the sum of the n delays, divided by n times the sum of their squares: 1 if all delays are "
            "equal, 1/n if a single robot is delayed; null unless every robot arrived",
            JAIN,
        ),
        Column(
            "max_over_mean",
            "",
            "lower",
            "largest delay divided by mean delay; null unless every robot arrived and at least one was late",
        ),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "end", "reached", "plan"})

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return both columns; null where a delay is unknown, because censored delays are the largest."""
        if not measurable(self, run):
            return nulls(self)
        delay = delays(run)
        if not len(delay) or not np.isfinite(delay).all():
            return nulls(self)
        late = np.maximum(delay, 0.0)
        worst = float(late.max())
        return {"jain": jain(late), "max_over_mean": worst * len(late) / math.fsum(late) if worst > 0 else None}


def jain(shares: Float) -> float:
    """Jain's index of non-negative shares f8[n], n >= 1; 1 if all shares are 0."""
    most = float(shares.max())
    if most == 0:
        return 1.0
    scaled = shares / most  # neither overflow nor underflow of squares
    return math.fsum(scaled) ** 2 / (len(scaled) * math.fsum(scaled**2))
