"""Whether a run has samples to measure, and what is told where it has none."""

import numpy as np

from mrpbench_core.api import Metric, Value
from mrpbench_core.model.run import FinishedRun


def measurable(metric: Metric, run: FinishedRun) -> bool:
    """Tell whether all that the metric requires is there, with samples, and all true positions are finite."""
    if not all(run.has(channel) for channel in metric.requires) or not len(run.channel("time")):
        return False
    return "truth" not in metric.requires or bool(np.isfinite(run.channel("truth")).all())


def nulls(metric: Metric) -> dict[str, Value]:
    """All columns of a metric, null."""
    return {column.name: None for column in metric.columns}
