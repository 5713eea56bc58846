"""Completed tasks per time, and service times."""

from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value
from mrpbench_core.model.runs.arrivals import arrival_times
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.distribution import mean, percentile
from mrpbench_metrics_standard.samples import measurable, nulls


@attrs.frozen(kw_only=True)
class Throughput(Metric):
    """Measures completed tasks: a robot's task is completed when the robot has completed its whole path.

    The service time of a task runs from its release (or the start of the recording, if that is later). A task
    that is never completed has no service time (it is censored). Read service times together with `tasks`.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column("tasks", "", "higher", "number of completed tasks"),
        Column(
            "tasks_per_hour",
            "1/h",
            "higher",
            "tasks completed per simulated hour, from the first sample to the last; null if there is only one",
        ),
        Column("service_mean_s", "s", "lower", "mean service time of completed tasks"),
        Column("service_p50_s", "s", "lower", "median service time of completed tasks"),
        Column("service_p95_s", "s", "lower", "95th percentile of the service times, linear between tasks"),
        Column("service_max_s", "s", "lower", "longest service time of completed tasks"),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "end", "reached"})

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; service times are null where no task was completed."""
        if not measurable(self, run):
            return nulls(self)
        context, time = run.context, run.channel("time")
        assigned = np.array(context.assigned or range(len(context.routes)), int)
        tasks = context.scenario.tasks
        released = np.array([tasks[task].release if task in range(len(tasks)) else np.nan for task in assigned])
        served = arrival_times(run) - np.maximum(released, time[0])
        served = served[np.isfinite(served)]
        hours = float(time[-1] - time[0]) / 3600
        return {
            "tasks": len(served),
            "tasks_per_hour": len(served) / hours if hours > 0 else None,
            "service_mean_s": mean(served),
            "service_p50_s": percentile(served, 50),
            "service_p95_s": percentile(served, 95),
            "service_max_s": percentile(served, 100),
        }
