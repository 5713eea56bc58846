"""Tells whether a run can be measured, and gives the result if it cannot."""

import numpy as np

from mrpbench_core.api import Metric, Value
from mrpbench_core.model.runs.run import FinishedRun


def measurable(metric: Metric, run: FinishedRun) -> bool:
    """Tell whether the run has everything that the metric requires, samples, and finite true positions."""
    if not all(run.has(channel) for channel in metric.requires) or not len(run.channel("time")):
        return False
    return "truth" not in metric.requires or bool(np.isfinite(run.channel("truth")).all())


def nulls(metric: Metric) -> dict[str, Value]:
    """All columns of a metric, as None."""
    return {column.name: None for column in metric.columns}
