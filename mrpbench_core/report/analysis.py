"""All numbers of a report, made once."""

from collections.abc import Sequence

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import suggest
from mrpbench_core.report.columns import MAIN, Column, read_columns
from mrpbench_core.report.comparison import Comparison, compare_settings
from mrpbench_core.report.estimates import Numbers, numbers_of
from mrpbench_core.report.groups import Setting, find_settings, group_runs
from mrpbench_core.report.runs import Runs, read_runs
from mrpbench_core.report.tables.build import RATES, common_table, means_table, outcome_table, pairs_table
from mrpbench_core.report.tables.table import Table
from mrpbench_core.store.results import Results


@attrs.frozen(kw_only=True)
class Analysis:
    """Runs of results folders with what can be said of them."""

    folders: tuple[Results, ...]
    runs: Runs
    settings: tuple[Setting, ...]
    numbers: tuple[tuple[Numbers, ...], ...]
    """Of each group of each setting."""
    columns: tuple[Column, ...]
    """What is shown beside success."""
    comparisons: tuple[Comparison, ...]

    def tables(self, brief: bool = False) -> list[Table]:
        """What a report prints; `brief` counts comparisons that could not be significant instead of showing them."""
        means = means_table(self.settings, self.numbers, self.columns, self.runs) if self.columns else None
        common = common_table(self.settings, self.numbers, self.columns, self.runs)
        found = (
            outcome_table(self.runs, self.settings, self.numbers),
            means,
            common,
            pairs_table(self.comparisons, brief=brief),
        )
        return [table for table in found if table is not None]


def analyse(
    folders: Sequence[Results], metrics: Sequence[str] | None = None, by: Sequence[str] | None = None
) -> Analysis:
    """Read folders and estimate and compare everything.

    Args:
        folders: of a run in several, the last counts.
        metrics: columns to look at; None = a few that matter, `["all"]` = all.
        by: options that tell groups apart; None = all that vary.

    Raises:
        InputError: there are no runs, or none has a column or option that is asked for.
    """
    runs = read_runs(folders)
    if not len(runs):
        raise InputError("no run is recorded here yet", file=folders[0].folder.path)
    known = read_columns(folders, runs.values)
    columns = tuple(known[name] for name in choose_columns(list(runs.values), metrics))
    settings = tuple(find_settings(runs, group_runs(runs, by)))
    wanted = [*RATES, *(column.name for column in columns)]
    return Analysis(
        folders=tuple(folders),
        runs=runs,
        settings=settings,
        numbers=tuple(tuple(numbers_of(runs, setting, wanted)) for setting in settings),
        columns=columns,
        comparisons=tuple(compare_settings(runs, settings, tested(runs, known, columns))),
    )


def choose_columns(known: Sequence[str], metrics: Sequence[str] | None) -> list[str]:
    """Columns to show, without those that every table has.

    Raises:
        InputError: no run has a value of one that is asked for.
    """
    offered = [name for name in known if name not in RATES]
    if metrics is None:
        return [name for name in MAIN if name in offered]
    if list(metrics) == ["all"]:
        return offered
    for name in metrics:
        if name not in known:
            raise InputError(f"no run has a value of {name!r}", hint=suggest(name, known))
    return [name for name in metrics if name in offered]


def tested(runs: Runs, known: dict[str, Column], columns: Sequence[Column]) -> list[Column]:
    """Columns that are compared: success, plans found (where that is not the same), and others that have a direction.

    Planning time is compared as PAR2 where that is there: it counts what a limit cut off.
    """
    penalised = any(column.name == "timing.planning_par2_s" for column in columns)
    rates = RATES if (runs.values["succeeded"] != runs.values["planned"]).any() else RATES[:1]
    return [
        *(known[name] for name in rates),
        *(column for column in columns if column.direction and not (penalised and column.name == "timing.planning_s")),
    ]
