"""Lengths of the driven paths, compared with the planned and the shortest ones."""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.runs.arrivals import arrival_times
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.distribution import mean
from mrpbench_metrics_standard.motion import steps
from mrpbench_metrics_standard.samples import measurable, nulls
from mrpbench_metrics_standard.shortest import shortest_lengths

SPL = "Anderson et al., On Evaluation of Embodied Navigation Agents, arXiv:1807.06757, 2018"


@attrs.frozen(kw_only=True)
class Efficiency(Metric):
    """Compares the paths that robots truly drove until arrival with the planned and with the shortest paths.

    The shortest path of a robot leads on the roadmap from its start through its goals in order, without other robots.
    Robots that need not move are left out.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column(
            "spl",
            "",
            "higher",
            "success weighted by path length: mean over robots of the length of the shortest path, divided by the "
            "larger of it and the length of the driven path; 0 for a robot that never completes its path",
            SPL,
        ),
        Column(
            "path_efficiency",
            "",
            "higher",
            "length of the planned paths divided by that of the driven paths, of all robots that completed their path; "
            "above 1 where robots cut corners",
        ),
        Column(
            "detour",
            "",
            "lower",
            "length of the driven paths divided by that of the shortest paths, of all robots that completed their path",
        ),
        Column(
            "planned_detour",
            "",
            "lower",
            "length of the planned paths divided by that of the shortest paths, of all robots",
        ),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "end", "truth", "reached", "plan", "path"})

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; null where no robot needs to move, or the roadmap has no path for some robot."""
        if not measurable(self, run):
            return nulls(self)
        context, time = run.context, run.channel("time")
        shortest = shortest_lengths(context.problem)
        moving = shortest > 0
        if not moving.any() or not np.isfinite(shortest).all():
            return nulls(self)
        planned = np.array([math.fsum(np.hypot(*np.diff(route.waypoint[:, :2], axis=0).T)) for route in context.routes])
        arrival = arrival_times(run)
        before = ~(time[1:, None] > arrival)  # steps that end at the arrival or sooner
        driven = np.array([math.fsum(lengths) for lengths in np.where(before, steps(run.channel("truth")), 0.0).T])
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
