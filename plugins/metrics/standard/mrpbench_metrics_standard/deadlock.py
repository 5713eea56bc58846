"""When nobody who still has to go anywhere gets on."""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value, option
from mrpbench_core.model.run import FinishedRun
from mrpbench_metrics_standard.progress import arrival_times, blocked_intervals, progress, under_way
from mrpbench_metrics_standard.samples import measurable, nulls
from mrpbench_metrics_standard.spells import spells

_POSITIVE = attrs.validators.gt(0)


@attrs.frozen(kw_only=True)
class Deadlock(Metric):
    """Measures spells in which all robots under way are blocked at once.

    A robot is blocked as in `execution.time_blocked_s`: it has advanced along its path by less than `distance` during
    the last `window`; so a spell begins `window` after the standstill. Robots that block one another while others still
    get on are not seen here but in `execution.time_blocked_s`.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column(
            "time_s",
            "s",
            "lower",
            "time at which some robot has not completed its path, and none of these has advanced along it by "
            "`distance` during the last `window`",
        ),
        Column("longest_s", "s", "lower", "the longest uninterrupted spell of that time"),
        Column("count", "", "lower", "number of such spells"),
        Column("unresolved", "", "lower", "the recording ends in such a spell"),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "truth", "reached", "path"})

    window: float = option(5.0, help="time over which progress is looked at", unit="s", validator=_POSITIVE)
    distance: float = option(
        0.35, help="progress along the path below which a robot is blocked", unit="m", validator=_POSITIVE
    )

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns."""
        if not measurable(self, run):
            return nulls(self)
        time, reached, routes = run.channel("time"), run.channel("reached"), run.context.routes
        arrival = arrival_times(time, reached, routes)
        along = progress(run.channel("truth"), reached, routes)
        going = under_way(time, arrival)
        blocked = blocked_intervals(time, along, arrival, self.window, self.distance)
        # Interval k ends at sample k; there is none before the first.
        stuck = np.stack([going.any(axis=1) & (blocked | ~going).all(axis=1)], axis=1)[1:]
        _, first, after = spells(stuck)
        lasted = time[after] - time[first]
        return {
            "time_s": math.fsum(lasted),
            "longest_s": float(lasted.max(initial=0.0)),
            "count": len(lasted),
            "unresolved": bool(stuck[-1:].any()),
        }
