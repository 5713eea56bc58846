"""The numbers of a report as plain data for JSON and CSV: an entry per group and column, an entry per comparison."""

import csv
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.printing import csv_cell
from mrpbench_core.report.estimation.comparison import Comparison
from mrpbench_core.report.report import Report
from mrpbench_core.report.statistics.estimate import IntervalEstimate
from mrpbench_core.report.tables.build import axes_of

PAIR_COLUMNS = (
    *("setting", "column", "first", "second", "unit", "pairs", "unpaired_first", "unpaired_second"),
    *("mean_first", "mean_second", "difference", "low", "high", "more", "same", "less"),
    *("effect", "p", "p_adjusted", "better", "verdict"),
)


def groups_of(report: Report) -> list[dict[str, Any]]:
    """Return for each group its axes, counts, and estimates by column over all units and over common units."""
    rows = []
    for setting, entries in zip(report.settings, report.numbers, strict=True):
        for group, numbers in zip(setting.groups, entries, strict=True):
            rows.append(
                {
                    "setting": setting.name,
                    "axes": group.axes,
                    "runs": len(group.members),
                    "counted": len(group.counted),
                    "units": len(np.unique(setting.units[group.counted])),
                    "unit": setting.unit,
                    "statuses": dict(group.statuses(report.runs)),
                    "overall": {name: _plain(value) for name, value in numbers.overall.items()},
                    "common": {name: _plain(value) for name, value in numbers.common.items()},
                }
            )
    return rows


def pairs_of(comparisons: Iterable[Comparison]) -> list[dict[str, Any]]:
    """Return the numbers of every comparison."""
    return [
        {
            "setting": entry.setting,
            "column": entry.column.name,
            "first": entry.first,
            "second": entry.second,
            "unit": entry.unit,
            "pairs": entry.paired.difference.n,
            "unpaired_first": entry.unpaired[0],
            "unpaired_second": entry.unpaired[1],
            "mean_first": entry.paired.first,
            "mean_second": entry.paired.second,
            "difference": entry.paired.difference.value,
            "low": _number(entry.paired.difference.low),
            "high": _number(entry.paired.difference.high),
            "more": entry.paired.above,
            "same": entry.paired.ties,
            "less": entry.paired.below,
            "effect": entry.paired.effect,
            "p": entry.paired.p,
            "p_adjusted": entry.p_adjusted,
            "better": entry.column.better,
            "verdict": entry.verdict,
        }
        for entry in comparisons
    ]


def write_estimates(report: Report, file: Path) -> None:
    """Write a CSV file with one line per group and column, over all units and over common units."""
    axes = axes_of(report.settings)
    units = {column.name: column.unit for column in report.columns}
    rows = [
        {key: group["axes"].get(key) for key in axes}
        | {"runs": group["runs"], "counted": group["counted"], "over": over}
        | {"column": name, "unit": units.get(name, ""), **(value or {"n": 0})}
        for group in groups_of(report)
        for over in ("overall", "common")
        for name, value in group[over].items()
    ]
    write_rows(file, rows, [*axes, "runs", "counted", "over", "column", "unit", "value", "low", "high", "n"])


def write_rows(file: Path, rows: Iterable[Mapping[str, Any]], columns: list[str]) -> None:
    """Write a CSV file; missing values stay empty, and text is never a formula."""
    try:
        with file.open("w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream)
            writer.writerow(map(csv_cell, columns))
            writer.writerows([csv_cell(row.get(column)) for column in columns] for row in rows)
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", file=file) from error


def _plain(estimate: IntervalEstimate | None) -> dict[str, Any] | None:
    if estimate is None:
        return None
    return {
        "value": estimate.value,
        "low": _number(estimate.low),
        "high": _number(estimate.high),
        "n": estimate.n,
    }


def _number(value: float) -> float | None:
    return value if np.isfinite(value) else None
