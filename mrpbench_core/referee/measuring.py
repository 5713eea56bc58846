"""Applies metrics to a finished run; a value that cannot be measured is null, with the reason."""

import traceback
from collections.abc import Mapping
from typing import Any

import numpy as np

from mrpbench_core.api.metric import Metric
from mrpbench_core.files.errors import one_line
from mrpbench_core.model.runs.run import FinishedRun

NUMBER = int | float | np.integer | np.floating | np.bool_
Measured = tuple[dict[str, Any], dict[str, str]]
"""Values by `<metric>.<column>`, and the reason for each metric or `<metric>.<column>` that cannot be measured."""


def measure(metrics: Mapping[str, Metric], run: FinishedRun) -> Measured:
    """Return the values of metrics, in their order."""
    values: dict[str, Any] = {}
    reasons: dict[str, str] = {}
    for name, metric in metrics.items():
        reason = _obstacle(metric.requires, run) or (None if metric.requires or run.planned else "planned by others")
        if reason is not None:
            reasons[name] = reason
            values |= {f"{name}.{column.name}": None for column in metric.columns}
            continue
        measured, reason = _measured(metric, run)
        if reason is not None:
            reasons[name] = reason
        for column in metric.columns:
            key, value = f"{name}.{column.name}", measured.get(column.name)
            if (reason := _obstacle(metric.requires | column.requires, run)) is not None:
                reasons[key], value = reason, None
            elif (fault := _fault(measured, column.name)) is not None:
                if name not in reasons:
                    reasons[key] = f"the metric returned {fault}"
                value = None
            values[key] = value
    return values, reasons


def _fault(measured: Mapping[str, Any], column: str) -> str | None:
    """What a metric returned instead of a number or None."""
    if column not in measured:
        return "no value for it"
    value = measured[column]
    if not isinstance(value, NUMBER | None):
        return f"{type(value).__name__} instead of a number"
    if isinstance(value, int) and not -(2**63) <= value < 2**63:
        return "an integer of more than 64 bits"
    if value is not None and not np.isfinite(value):
        return f"{float(value)}, and not None"
    return None


def _measured(metric: Metric, run: FinishedRun) -> tuple[Mapping[str, Any], str | None]:
    """The result of a metric, or the reason why it has none: its defects must not affect the run or other metrics."""
    try:
        measured = metric.measure(run)
    except (Exception, SystemExit) as error:  # noqa: BLE001 - a plugin may raise anything
        traceback.print_exc()  # into the run's log
        return {}, f"the metric raised {one_line(error)}"
    if not isinstance(measured, Mapping):
        return {}, f"the metric returned {type(measured).__name__} instead of a mapping"
    return measured, None


def describe(metrics: Mapping[str, Metric | type[Metric]]) -> dict[str, dict[str, Any]]:
    """The declaration of each column, by `<metric>.<column>`, for readers of records."""
    return {
        f"{name}.{column.name}": {
            "unit": column.unit,
            "better": column.better,
            "description": column.description,
            "source": column.source,
            "primary": column.primary,
            "stage": column.stage,
            "drawn": column.drawn,
            "answers": column.answers,
            "threshold": column.threshold,
            "threshold_share": column.threshold_share,
            "aliases": list(column.aliases),
        }
        for name, metric in metrics.items()
        for column in metric.columns
    }


def _obstacle(requires: frozenset[str], run: FinishedRun) -> str | None:
    """Return the reason why required data are missing, or None."""
    lacking = sorted(channel for channel in requires if not run.has(channel))
    if not lacking:
        same = next((channels for channels in run.alike if channels <= requires), None)
        return None if same is None else f"{' and '.join(sorted(same))} are from one source"
    return "not executed" if not run.executed and lacking != ["plan"] else f"no {', '.join(lacking)}"
