"""Detects deadlocks of all robots that have not arrived."""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value, option
from mrpbench_core.model.common.intervals import runs
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.progress import blocked_intervals, progress, under_way
from mrpbench_metrics_standard.samples import measurable, nulls

_POSITIVE = attrs.validators.gt(0)


@attrs.frozen(kw_only=True)
class Deadlock(Metric):
    """Measures the periods in which all robots that have not arrived are blocked at once.

    A robot is blocked as in `execution.time_blocked_s`: it has advanced along its path by less than `distance` during
    the last `window`. A period therefore begins `window` after the robots stopped. Robots that block one another while
    other robots still move count in `execution.time_blocked_s` only.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column(
            "time_s",
            "s",
            "lower",
            "time during which at least one robot has not completed its path, and none of these robots has advanced "
            "by `distance` along its path during the last `window`",
        ),
        Column("longest_s", "s", "lower", "the longest uninterrupted period of this kind"),
        Column("count", "", "lower", "number of such periods"),
        Column("unresolved", "", "lower", "the recording ends during such a period"),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "truth", "reached", "path"})

    window: float = option(5.0, help="time over which progress is measured", unit="s", validator=_POSITIVE)
    distance: float = option(
        0.35, help="progress along the path below which a robot is blocked", unit="m", validator=_POSITIVE
    )

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns."""
        if not measurable(self, run):
            return nulls(self)
        time, reached, routes = run.channel("time"), run.channel("reached"), run.context.routes
        along = progress(run.channel("truth"), reached, routes)
        going = under_way(run)
        blocked = blocked_intervals(time, along, going, self.window, self.distance)
        # Interval k ends at sample k; there is none before the first.
        stuck = np.stack([going.any(axis=1) & (blocked | ~going).all(axis=1)], axis=1)[1:]
        _, first, after = runs(stuck.T)
        lasted = time[after] - time[first]
        return {
            "time_s": math.fsum(lasted),
            "longest_s": float(lasted.max(initial=0.0)),
            "count": len(lasted),
            "unresolved": bool(stuck[-1:].any()),
        }
