"""How much farther than necessary robots drive."""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value
from mrpbench_core.model.arrays import Bool, Float
from mrpbench_core.model.run import FinishedRun
from mrpbench_metrics_standard.distribution import mean
from mrpbench_metrics_standard.motion import steps
from mrpbench_metrics_standard.progress import arrival_times
from mrpbench_metrics_standard.samples import measurable, nulls
from mrpbench_metrics_standard.shortest import shortest_ways

SPL = "Anderson et al., On Evaluation of Embodied Navigation Agents, arXiv:1807.06757, 2018"


@attrs.frozen(kw_only=True)
class Efficiency(Metric):
    """Compares true ways until arrival with the planned paths, and with the shortest ways on the roadmap.

    The shortest way of a robot leads from its start through its goals in order, as if it were alone. Robots that need
    not move are left out everywhere.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column(
            "spl",
            "",
            "higher",
            "mean over robots of their shortest way over the larger of it and their true way; 0 for robots that never "
            "complete their path",
            SPL,
        ),
        Column(
            "path_efficiency",
            "",
            "higher",
            "length of the planned paths over that of the true ways, of all robots that completed their path; above 1 "
            "where corners were cut",
        ),
        Column("detour", "", "lower", "true ways over shortest ways, of all robots that completed their path"),
        Column("planned_detour", "", "lower", "planned paths over shortest ways, of all robots"),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "truth", "reached", "plan", "path"})

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; null where no robot needs to move, or one has no way on the roadmap."""
        if not measurable(self, run):
            return nulls(self)
        context, time = run.context, run.channel("time")
        shortest = shortest_ways(context.problem)
        moving = shortest > 0
        if not moving.any() or not np.isfinite(shortest).all():
            return nulls(self)
        planned = np.array([math.fsum(np.hypot(*np.diff(route.waypoint[:, :2], axis=0).T)) for route in context.routes])
        arrival = arrival_times(time, run.channel("reached"), context.routes)
        before = ~(time[1:, None] > arrival)  # steps that end at the arrival or sooner
        driven = np.array([math.fsum(own) for own in np.where(before, steps(run.channel("truth")), 0.0).T])
        arrived = moving & np.isfinite(arrival)
        share = np.where(arrived, shortest, 0.0)[moving] / np.maximum(driven, shortest)[moving]
        return {
            "spl": mean(share),
            "path_efficiency": _ratio(planned, driven, arrived),
            "detour": _ratio(driven, shortest, arrived),
            "planned_detour": _ratio(planned, shortest, moving),
        }


def _ratio(over: Float, under: Float, chosen: Bool) -> float | None:
    below = math.fsum(under[chosen])
    return math.fsum(over[chosen]) / below if below > 0 else None
