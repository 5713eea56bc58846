"""The execution compared with the plan: times of robots, and orders that were switched."""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.runs.arrivals import arrival_times
from mrpbench_core.model.runs.plans import read_plans
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.model.runs.switches import switches
from mrpbench_metrics_standard.distribution import mean, percentile
from mrpbench_metrics_standard.samples import measurable, nulls


@attrs.frozen(kw_only=True)
class Delay(Metric):
    """Compares the time at which each robot completed its last move with the time in the first plan.

    A robot that never arrives has no delay (it is censored). Read the other columns together with `robots`.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column("robots", "", "higher", "robots that completed their last planned move; their delays are known"),
        Column(
            "mean_s",
            "s",
            "lower",
            "mean over these robots of the time from the start until the first sample at which the last planned move "
            "is completed, minus the time at which the plan completes it; robots that need not move have delay 0",
            answers="duration",
            threshold=1.0,
        ),
        Column(
            "p95_s",
            "s",
            "lower",
            "95th percentile of these delays, linear between robots",
            answers="duration",
            threshold=1.0,
        ),
        Column("max_s", "s", "lower", "the largest of these delays", answers="duration", threshold=1.0),
        Column(
            "time_ratio",
            "",
            "lower",
            "sum over these robots of the executed times, divided by the sum of their planned times",
        ),
        Column(
            "makespan_s",
            "s",
            "lower",
            "time at which the last robot completes its last move, minus the time at which the last one does in the "
            "plan; null unless all robots did",
        ),
        Column(
            "switches",
            "",
            "neither",
            "times that a robot passes a place before another one that the current plan lets pass first; consecutive "
            "places of the same two robots count once",
        ),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "end", "reached", "plan"})

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; delays are null where no robot arrived."""
        if not measurable(self, run):
            return nulls(self)
        delay, planned = delays(run), _planned(run)
        arrived = np.isfinite(delay)
        known, total = delay[arrived], math.fsum(planned[arrived])
        last = (planned + delay).max(initial=0.0) - planned.max(initial=0.0)
        plans = read_plans(run.first_context(), run.channels)
        return {
            "robots": len(known),
            "mean_s": mean(known),
            "p95_s": percentile(known, 95),
            "max_s": percentile(known, 100),
            "time_ratio": 1 + math.fsum(known) / total if total else None,
            "makespan_s": float(last) if arrived.all() else None,
            "switches": len(switches(run.context.problem, plans, run.channel("time"), run.channel("reached"))),
        }


def delays(run: FinishedRun) -> Float:
    """Delays f8[n] in seconds of the last planned move of each robot; NaN if it was never completed."""
    time = run.channel("time")
    late: Float = arrival_times(run) - time[0] - _planned(run)
    return late


def _planned(run: FinishedRun) -> Float:
    """Seconds f8[n] from the start until the first plan completes the last move of each robot."""
    plan = run.context.result.plan
    assert plan is not None
    return np.array([path.arrival for path in plan.paths]) * run.context.problem.roadmap.tick
