"""Applies metrics to a finished run; what cannot be measured is null with the reason."""

from collections.abc import Mapping
from typing import Any

from mrpbench_core.api.metric import Metric
from mrpbench_core.model.run import FinishedRun


def measure(metrics: Mapping[str, Metric], run: FinishedRun) -> tuple[dict[str, Any], dict[str, str]]:
    """Values by `<metric>.<column>`, and for each metric that could not be measured the reason."""
    values: dict[str, Any] = {}
    reasons: dict[str, str] = {}
    for name, metric in metrics.items():
        lacking = sorted(channel for channel in metric.requires if not run.has(channel))
        if lacking:
            reasons[name] = "not executed" if not run.executed and lacking != ["plan"] else f"no {', '.join(lacking)}"
            values |= {f"{name}.{column.name}": None for column in metric.columns}
            continue
        measured = metric.measure(run)
        for column in metric.columns:
            value = measured.get(column.name)
            values[f"{name}.{column.name}"] = None if isinstance(value, float) and value != value else value
    return values, reasons
