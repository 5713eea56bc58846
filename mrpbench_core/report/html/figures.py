"""The charts of each setting."""

from collections.abc import Sequence
from html import escape

import numpy as np

from mrpbench_core.api.metric import Column
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.report.estimation.estimates import Numbers
from mrpbench_core.report.estimation.groups import RunGroup, Setting
from mrpbench_core.report.html.charts import Curve, intervals, legend, steps
from mrpbench_core.report.reading.columns import direction, heading
from mrpbench_core.report.reading.runs import Runs
from mrpbench_core.report.report import Report
from mrpbench_core.report.statistics.profiles import cactus, profiles

_DONE = {"planning": ("planned", "had a plan"), "execution": ("succeeded", "succeeded")}
"""For each stage, the rate whose runs completed it, and the words for that."""


def figures(report: Report) -> str:
    """Charts of every setting, as markup."""
    parts = []
    for setting, numbers in zip(report.settings, report.numbers, strict=True):
        title = f"<h3>{escape(setting.name)}</h3>" if setting.name else ""
        charts = [*_rates(setting, numbers), *_means(report, setting, numbers), *_curves(report, setting)]
        cards = "".join(
            f"<figure>{chart}<figcaption>{escape(text)}</figcaption></figure>" for chart, text in charts if chart
        )
        parts.append(
            f'<section class="setting">{title}{legend(setting.names)}<div class="charts">{cards}</div></section>'
        )
    return "".join(parts)


def _rates(setting: Setting, numbers: Sequence[Numbers]) -> list[tuple[str, str]]:
    rows = {
        name: [(n, i, numbers[i].overall[name]) for i, n in enumerate(setting.names)]
        for name in ("succeeded", "planned")
    }
    charts = [
        (
            intervals(rows["planned"], "plans found [%]", percent=True),
            "Share of runs with a plan, of all runs that count; Wilson 95 %.",
        ),
        (
            intervals(rows["succeeded"], "succeeded [%]", percent=True),
            "Share of runs that succeeded, of all runs that count; Wilson 95 %.",
        ),
    ]
    same = all(entry.overall["planned"] in (None, entry.overall["succeeded"]) for entry in numbers)
    return charts[1:] if same else charts


def _means(report: Report, setting: Setting, numbers: Sequence[Numbers]) -> list[tuple[str, str]]:
    charts = []
    for column in report.columns:
        if column.name in report.runs.flags:
            continue
        rows = [(name, index, numbers[index].common[column.name]) for index, name in enumerate(setting.names)]
        count = max((entry.n for _, _, entry in rows if entry is not None), default=0)
        best = {1: " More is better.", -1: " Less is better."}.get(direction(column), "")
        has_intervals = any(entry.has_interval for _, _, entry in rows if entry is not None)
        text = f"Mean over the {count} {setting.unit} that all groups have in common"
        text += f"{'; bootstrap 95 %' if has_intervals else ''}.{best}"
        charts.append((intervals(rows, heading(column), percent=False), text))
    return charts


def _curves(report: Report, setting: Setting) -> list[tuple[str, str]]:
    if len(setting.groups) < 2:
        return []
    units = np.unique(np.concatenate([setting.units[group.counted] for group in setting.groups]))
    charts = []
    for column in report.profiled:
        table = [_on(report.runs, setting, group, column, units) for group in setting.groups]
        if not any(np.isfinite(row).any() for row in table):
            continue
        if column.drawn == "cactus":
            rate, done = _DONE[column.stage]
            curves = [Curve(name, index, *cactus(table[index])) for index, name in enumerate(setting.names)]
            y_label = f"{setting.unit} {rate}"
            chart = steps(curves, heading(column), y_label, log_x=True, start=0.0, top=float(len(units)))
            text = f"Cactus plot: how many of the {len(units)} {setting.unit} {done} within each {column.name}."
            charts.append((chart, text))
        curves = [
            Curve(name, index, *curve)
            for (index, name), curve in zip(enumerate(setting.names), profiles(table), strict=True)
        ]
        x_label, y_label = f"{column.name}, ratio to the best", f"share of {setting.unit}"
        chart = steps(curves, x_label, y_label, log_x=_wide(curves), start=0.0, top=1.0)
        over = f"over {len(units)} {setting.unit}; those without a value never count"
        charts.append((chart, f"Performance profile (Dolan and Moré 2002) {over}."))
    return charts


def _wide(curves: Sequence[Curve]) -> bool:
    values = np.concatenate([curve.x for curve in curves])
    return bool(values[np.isfinite(values)].max(initial=1.0) > 10)


def _on(runs: Runs, setting: Setting, group: RunGroup, column: Column, units: Float) -> Float:
    """Mean of a group for each unit; NaN if a run of the unit failed in the stage."""
    numbers, values, _ = group.by_unit(runs, setting.units, column.name)
    asked, done, _ = group.by_unit(runs, setting.units, _DONE[column.stage][0])
    whole = np.isin(numbers, asked[done == 1])
    row = np.full(len(units), np.nan)
    row[np.searchsorted(units, numbers[whole])] = values[whole]
    return row
