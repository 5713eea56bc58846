"""Prints the table at the end of `mrpbench run`: counts and means, without intervals and comparisons."""

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

from mrpbench_core.cli.output.table import print_table
from mrpbench_core.engine.loading.runs import StudyRuns
from mrpbench_core.files.text import counted
from mrpbench_core.model.runs.status import LEFT_OUT, RunStatus
from mrpbench_core.report.estimation.groups import RunGroup, group_runs
from mrpbench_core.report.reading.axes import word
from mrpbench_core.report.reading.columns import SHOWN_IF_ANY, primary_columns, read_columns, shown_columns
from mrpbench_core.report.reading.runs import PAR2, Runs, read_runs
from mrpbench_core.report.tables.table import exact
from mrpbench_core.store.results import Results

ABREAST = 4
"""Number of groups up to which each group is a column of the table."""


def plugins_line(studies: Sequence[StudyRuns]) -> str:
    """Return one line with the distributions and versions of the plugins."""
    offered: dict[str, list[str]] = {}
    for entry in {
        id(part): part for study in studies for point in study.runs for part in point.code["components"]
    }.values():
        owner = f"{entry['distribution']} {entry['version']}" if "distribution" in entry else "local"
        names = offered.setdefault(owner, [])
        if entry["name"] not in names:
            names.append(entry["name"])
    return "plugins: " + "; ".join(f"{owner}: {', '.join(names)}" for owner, names in sorted(offered.items()))


def print_summary(results: Results, limit: int | None = None) -> Counter[str]:
    """Print a column for each group if there are few, otherwise a row for each, at most `limit` rows.

    Returns:
        The number of runs of each status, `promise_broken` included.
    """
    known = read_columns([results])
    runs = read_runs([results], [*(column.name for column in primary_columns(known)), *SHOWN_IF_ANY])
    shown = [column.name for column in shown_columns(known, runs.values) if column.name != PAR2]
    if not len(runs):
        return Counter()
    groups = group_runs(runs)
    axes = list(dict.fromkeys(key for group in groups for key in group.axes))
    statuses = [group.statuses(runs) for group in groups]
    table: dict[str, list[Any]] = {
        key: [word(group.axes[key]) if key in group.axes else None for group in groups] for key in axes
    }
    table["runs"] = [len(group.members) for group in groups]
    table["succeeded"] = [
        f"{counts[RunStatus.SUCCEEDED]}/{len(group.counted)}" if len(group.counted) else "n/a"
        for counts, group in zip(statuses, groups, strict=True)
    ]
    others = dict.fromkeys(status for counts in statuses for status in counts if status != RunStatus.SUCCEEDED)
    table |= {status: [counts[status] for counts in statuses] for status in sorted(others, key=LEFT_OUT.__contains__)}
    table |= {key: [_mean(runs, group, key) for group in groups] for key in shown if key in runs.values}
    if len(groups) <= ABREAST:
        numbers = [f"#{number + 1}" for number in range(len(groups))]
        print_table(["", *numbers], [[key, *row] for key, row in table.items()])
    else:
        print_table(_short(list(table)), list(zip(*table.values(), strict=True))[:limit])
    if limit is not None and len(groups) > max(limit, ABREAST):
        print(f"… {counted(len(groups) - limit, 'more row')}")
    return sum(statuses, Counter())


def _short(columns: Sequence[str]) -> list[str]:
    """Headings without the name of the metric, where they stay different."""
    short = [column.rpartition(".")[2] for column in columns]
    return [end if short.count(end) == 1 else column for end, column in zip(short, columns, strict=True)]


def _mean(runs: Runs, group: RunGroup, key: str) -> str | None:
    values = runs.values[key][group.counted]
    having = values[np.isfinite(values)]
    if not len(having):
        return None
    return f"{exact(having.mean()):.4g}" + ("" if len(having) == len(group.members) else f" (n={len(having)})")
