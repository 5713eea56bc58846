"""Packs the list of runs. A page lists a limited number, so that it stays small."""

import base64
import json
import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np

from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.runs.status import LEFT_OUT, RunStatus
from mrpbench_core.report.reading.columns import heading
from mrpbench_core.report.report import Report
from mrpbench_core.report.tables.build import SHORT

FIGURES = 6
LISTED = 20_000
"""Number of runs up to which all are listed."""


def packed_runs(report: Report, replays: Mapping[str, str]) -> str:
    """Return the listed runs as deflated JSON in base64, in columns; a repeated text is stored once.

    Args:
        report: its runs, groups and columns.
        replays: addresses of pages, relative to the report, by run id.
    """
    runs = report.runs
    group = np.zeros(len(runs), int)
    names: list[str] = []
    for setting in report.settings:
        for entry, name in zip(setting.groups, setting.names, strict=True):
            group[entry.members] = len(names)
            names.append(" ".join(filter(None, (setting.name, name))))
    listed = _listed(report)
    statuses, messages = _Texts(), _Texts()
    columns = [column for column in report.columns if column.name in runs.values]
    data: dict[str, Any] = {
        "folders": [str(results.folder.path) for results in report.folders],
        "groups": names,
        "total": len(runs),
        "id": [runs.run_id[index][:SHORT] for index in listed],
        "folder": runs.folder[listed].tolist(),
        "group": group[listed].tolist(),
        "status": [statuses.number(runs.status[index]) for index in listed],
        "seed": runs.seed[listed].tolist(),
        "repeat": runs.repeat[listed].tolist(),
        "scenario": runs.scenario[listed].tolist(),
        "message": [messages.number(runs.message[index]) for index in listed],
        "columns": [heading(column) for column in columns],
        "values": [[_rounded(value) for value in runs.values[column.name][listed].tolist()] for column in columns],
        "replays": {run_id[:SHORT]: address for run_id, address in replays.items()},
    }
    data |= {"tones": [tone(status) for status in statuses.known]}
    data |= {"partial": [status == RunStatus.UNKNOWN for status in statuses.known]}
    data |= {"statuses": list(statuses.known), "messages": list(messages.known)}
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return base64.b64encode(zlib.compress(text.encode(), 7)).decode()


def _listed(report: Report) -> Int:
    """Indices of the runs in the list: all, or failures first and every configuration in turn."""
    count = len(report.runs)
    return np.arange(count) if count <= LISTED else np.sort(report.failures_first()[:LISTED])


def tone(status: str) -> str:
    """Return the style of a status: `good`, `bad`, or `out` for runs that do not count."""
    return "good" if status == RunStatus.SUCCEEDED else "out" if status in LEFT_OUT else "bad"


class _Texts:
    """Numbers texts in the order of their appearance."""

    def __init__(self) -> None:
        self.known: dict[str, int] = {}

    def number(self, text: str) -> int:
        return self.known.setdefault(text, len(self.known))


def _rounded(value: float) -> float | None:
    return float(f"{value:.{FIGURES}g}") if np.isfinite(value) else None
