"""Times of one plan under many draws of the delays (`delays.draws`)."""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.distribution import mean, percentile
from mrpbench_metrics_standard.samples import measurable, nulls

_NORMAL = 1.959964
"""97.5th percentile of the standard normal distribution."""
_QUANTITIES = {
    "makespan": "time at which the last robot completes its last move",
    "arrival": "mean over robots of the time at which each completes its last move",
    "waiting": "time in which robots have completed all that is released, and have not arrived, all robots together",
}
_SUMMARIES = {
    "mean_s": "mean over draws",
    "low_s": "mean - 1.96 standard errors, the lower end of its 95 % interval for many draws",
    "high_s": "mean + 1.96 standard errors, the upper end of its 95 % interval for many draws",
    "p50_s": "median over draws",
    "p95_s": "95th percentile over draws, linear between draws",
}


@attrs.frozen(kw_only=True)
class Draws(Metric):
    """Summarizes the executions of one plan under `delays.draws` draws of the delays.

    Draws in which not all robots arrive are left out (they are censored): read the other columns together with
    `arrived`. All draws have the same plan, so the intervals do not cover other plans or scenarios.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column("draws", "", "neither", "executions of the plan"),
        Column("arrived", "", "higher", "executions in which all robots arrived; the other columns are about these"),
        *(
            Column(f"{quantity}_{summary}", "s", "lower", f"{of}; {what}")
            for quantity, what in _QUANTITIES.items()
            for summary, of in _SUMMARIES.items()
        ),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"draw", "draw_arrival", "draw_waiting"})

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; null where no draw ended, and the interval also where only one did."""
        if not measurable(self, run):
            return nulls(self)
        arrival, waiting = run.channel("draw_arrival"), run.channel("draw_waiting")
        ended = np.isfinite(arrival).all(axis=1)
        arrival, waiting = arrival[ended], waiting[ended]
        each = {
            "makespan": arrival.max(axis=1, initial=0.0),
            "arrival": np.array([mean(row) or 0.0 for row in arrival]),
            "waiting": np.array([math.fsum(row) for row in waiting]),
        }
        values: dict[str, Value] = {"draws": len(ended), "arrived": int(ended.sum())}
        for quantity, drawn in each.items():
            values |= {f"{quantity}_{name}": value for name, value in _summary(drawn).items()}
        return values


def _summary(drawn: Float) -> dict[str, float | None]:
    """Summarize the values f8[d] of draws."""
    centre = mean(drawn)
    low = high = None
    if centre is not None and len(drawn) > 1:
        error = _NORMAL * float(drawn.std(ddof=1)) / math.sqrt(len(drawn))
        low, high = centre - error, centre + error
    return {
        "mean_s": centre,
        "low_s": low,
        "high_s": high,
        "p50_s": percentile(drawn, 50),
        "p95_s": percentile(drawn, 95),
    }
