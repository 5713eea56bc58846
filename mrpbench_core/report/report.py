"""Computes all numbers of a report once."""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.api.metric import Column
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.extras import has
from mrpbench_core.files.suggestions import suggest
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.report.estimation.comparison import Comparison, compare_settings
from mrpbench_core.report.estimation.estimates import Numbers, numbers_of
from mrpbench_core.report.estimation.groups import Setting, find_settings, group_runs
from mrpbench_core.report.reading.columns import Columns, direction, primary_columns, shown_columns
from mrpbench_core.report.reading.folders import read_folders
from mrpbench_core.report.reading.runs import Runs
from mrpbench_core.report.tables.build import (
    RATES,
    UNTESTED,
    common_table,
    means_table,
    outcome_table,
    pairs_table,
    promises_table,
)
from mrpbench_core.report.tables.table import Table
from mrpbench_core.store.results import Results


@attrs.frozen(kw_only=True)
class Report:
    """The runs of results folders with their estimates and comparisons."""

    folders: tuple[Results, ...]
    runs: Runs
    settings: tuple[Setting, ...]
    numbers: tuple[tuple[Numbers, ...], ...]
    """Of each group of each setting."""
    columns: tuple[Column, ...]
    """Columns that are shown in addition to success."""
    profiled: tuple[Column, ...]
    """Primary and shown columns that have a performance profile."""
    compared: tuple[Column, ...]
    """Columns that are compared."""
    comparisons: tuple[Comparison, ...]
    """None without SciPy, which does the tests."""

    def tables(self, brief: bool = False) -> list[Table]:
        """Return the tables; `brief` leaves out comparisons that cannot be significant, and empty tables."""
        means = means_table(self.settings, self.numbers, self.columns, self.runs) if self.columns else None
        common = common_table(self.settings, self.numbers, self.columns, self.runs)
        if has("scipy"):
            pairs = pairs_table(self.comparisons, brief=brief)
        else:
            pairs = UNTESTED if any(len(setting.groups) > 1 for setting in self.settings) else None
        candidates = (
            outcome_table(self.runs, self.settings, self.numbers),
            promises_table(self.runs),
            means,
            common,
            pairs,
        )
        return [table for table in candidates if table is not None and (table.rows or table is UNTESTED or not brief)]

    def failures_first(self) -> Int:
        """Return the indices of all runs: failed ones first, and every configuration in turn."""
        groups = [group.members for setting in self.settings for group in setting.groups]
        order = np.concatenate(groups)
        succeeded = self.runs.values["succeeded"][order] == 1
        number = np.repeat(np.arange(len(groups)), [len(members) for members in groups])
        alike = 2 * number + succeeded  # runs of one configuration with the same outcome
        grouped, sizes = np.argsort(alike, kind="stable"), np.bincount(alike)
        turn = np.empty(len(order), np.int64)
        turn[grouped] = np.arange(len(order)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
        return order[np.lexsort((number, turn, succeeded))]


def make_report(
    folders: Sequence[Results], metrics: Sequence[str] | None = None, by: Sequence[str] | None = None
) -> Report:
    """Read folders, estimate all columns and compare all groups.

    Args:
        folders: the last record of a run that is in several counts.
        metrics: columns to show; None = the primary columns, `["all"]` = all.
        by: options that distinguish groups; None = all that vary.

    Raises:
        InputError: there are no runs, or none has a column or option that is asked for.
    """
    runs, known = read_folders(folders)
    if not len(runs):
        raise InputError("no run is recorded here yet", file=folders[0].folder.path)
    columns = choose_columns(runs, known, metrics)
    settings = tuple(find_settings(runs, group_runs(runs, by)))
    wanted = [*RATES, *(column.name for column in columns)]
    compared = tested(runs, known, columns)
    return Report(
        folders=tuple(folders),
        runs=runs,
        settings=settings,
        numbers=tuple(tuple(numbers_of(runs, setting, wanted)) for setting in settings),
        columns=columns,
        profiled=profiled_columns(runs, known, columns),
        compared=tuple(compared),
        comparisons=tuple(compare_settings(runs, settings, compared)) if has("scipy") else (),
    )


def choose_columns(runs: Runs, known: Columns, metrics: Sequence[str] | None) -> tuple[Column, ...]:
    """Return the columns to show, without those that every table has.

    Args:
        runs: which hold the values.
        known: all columns.
        metrics: names, also former ones; None = see `shown_columns`, `["all"]` = all.

    Raises:
        InputError: no run has a value of one that is asked for.
    """
    offered = [name for name in runs.values if name not in RATES]
    if metrics is None:
        return tuple(column for column in shown_columns(known, runs.values) if column.name in offered)
    if list(metrics) == ["all"]:
        return tuple(known[name] for name in offered)
    current = {alias: column.name for column in known.values() for alias in column.aliases}
    names = [name if name in runs.values else current.get(name, name) for name in metrics]
    for name in names:
        if name not in runs.values:
            raise InputError(f"no run has a value of {name!r}", hint=suggest(name, list(runs.values)))
    return tuple(known[name] for name in dict.fromkeys(names) if name in offered)


def profiled_columns(runs: Runs, known: Columns, shown: Sequence[Column]) -> tuple[Column, ...]:
    """Return the columns with a performance profile, whose values must not be below 0 and less of which is better."""
    return tuple(
        column
        for column in dict.fromkeys([*primary_columns(known), *shown])
        if column.drawn != "interval"
        and column.better == "lower"
        and column.name in runs.values
        and not (runs.values[column.name] < 0).any()
    )


def tested(runs: Runs, known: Columns, columns: Sequence[Column]) -> list[Column]:
    """Return the columns that are compared: success, plans found if that differs, and others that have a direction.

    Planning time is compared as PAR2 if possible, which counts the runs that a limit ended.
    """
    penalised = any(column.name == "timing.planning_par2_s" for column in columns)
    having = np.isfinite(runs.values["planned"])
    rates = RATES if (runs.values["succeeded"] != runs.values["planned"])[having].any() else RATES[:1]
    return [
        *(known[name] for name in rates),
        *(column for column in columns if direction(column) and not (penalised and column.name == "timing.planning_s")),
    ]
