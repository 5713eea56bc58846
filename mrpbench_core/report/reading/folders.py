"""Reads the runs of results folders together with the descriptions of their columns."""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.report.reading.columns import Columns, read_columns
from mrpbench_core.report.reading.runs import Runs, read_runs
from mrpbench_core.store.results import Results


def read_folders(folders: Sequence[Results], *, once: bool = True) -> tuple[Runs, Columns]:
    """Read the runs of folders and describe the columns for which they have values; see `read_runs`."""
    runs = read_runs(folders, once=once)
    known = read_columns(folders, runs.values)
    return merge_aliases(runs, known), known


def merge_aliases(runs: Runs, known: Columns) -> Runs:
    """Move values that older versions stored under other names to the current columns.

    Values under both names that differ, as where two metrics had different options, stay apart.
    """
    values, flags = dict(runs.values), set(runs.flags)
    for column in known.values():
        for alias in column.aliases:
            if alias not in values:
                continue
            former = values[alias]
            current = values.get(column.name, np.full(len(runs), np.nan))
            both = np.isfinite(former) & np.isfinite(current)
            if (former[both] == current[both]).all():
                values[column.name] = np.where(np.isfinite(current), current, former)
                del values[alias]
                flags = {column.name if name == alias else name for name in flags}
    return attrs.evolve(runs, values=values, flags=frozenset(flags))
