"""Builds the tables of a report."""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.api.metric import Column
from mrpbench_core.files.extras import pip
from mrpbench_core.model.runs.status import LEFT_OUT, RunStatus
from mrpbench_core.report.estimation.comparison import SIGNIFICANT, Comparison
from mrpbench_core.report.estimation.estimates import Numbers
from mrpbench_core.report.estimation.groups import RunGroup, Setting
from mrpbench_core.report.reading.axes import word
from mrpbench_core.report.reading.columns import heading
from mrpbench_core.report.reading.runs import Runs
from mrpbench_core.report.statistics.estimate import IntervalEstimate
from mrpbench_core.report.tables.spans import spans
from mrpbench_core.report.tables.table import Cell, Shown, Table, exact, p_value

RATES = ("succeeded", "planned")
MOST_BROKEN = 20
"""Runs that the table of broken promises names."""
SHORT = 12
"""Characters of a run id; enough to name one."""


UNTESTED = Table(
    key="pairs",
    title="Pair by pair",
    headings=("column",),
    rows=(),
    keys=1,
    note=f"Paired comparisons need SciPy: {pip('statistics')} installs it.",
)
"""In place of the table of pairs where SciPy is missing."""


def outcome_table(runs: Runs, settings: Sequence[Setting], numbers: Sequence[Sequence[Numbers]]) -> Table:
    """Build the table of the statuses of each group."""
    axes = axes_of(settings)
    rows: list[tuple[Cell, ...]] = []
    unit = tuple({_unit(settings)} - {"runs"})
    planned = ("plans found",) if np.isfinite(runs.values["planned"]).any() else ()
    for setting, group, entry in _groups(settings, numbers):
        statuses = group.statuses(runs)
        failed = [
            f"{count} {status}" for status, count in statuses.items() if status not in {RunStatus.SUCCEEDED, *LEFT_OUT}
        ]
        left_out = [f"{count} {status}" for status, count in statuses.items() if status in LEFT_OUT]
        rows.append(
            (
                *_axes_cells(group, axes),
                len(group.members),
                *(len(np.unique(setting.units[group.counted])) for _ in unit),
                f"{statuses[RunStatus.SUCCEEDED]}/{len(group.counted)}",
                _rate(entry.overall["succeeded"]) or "n/a",
                *(_rate(entry.overall["planned"]) for _ in planned),
                ", ".join(failed) or None,
                ", ".join(left_out) or None,
            )
        )
    return Table(
        key="outcome",
        title="How the runs ended" + _reassigned(runs),
        headings=(*axes, "runs", *unit, "succeeded", "success rate", *planned, "else", "left out"),
        rows=tuple(rows),
        keys=len(axes),
        note=(
            "Rates: Wilson intervals, 95 %. Infeasible, skipped and unknown runs do not count in the denominator;"
            " the last column lists them. "
            f"Seeds: {spans(runs.seed)}; repeats: {spans(runs.repeat)}.{_true_poses(runs)}"
        ),
    )


def _reassigned(runs: Runs) -> str:
    """Return the part of a title that says in how many runs an assigner changed the goals of the scenario."""
    count = np.count_nonzero(runs.reassigned)
    return f" (the assigner changed the scenario's goals in {count} of {len(runs)} runs)" if count else ""


def _true_poses(runs: Runs) -> str:
    """Return a sentence that names the localizers that were given the true poses."""
    listed_robots = ", ".join(
        f"{name} in {count} of {len(runs)} runs" for name, count in sorted(runs.true_poses.items())
    )
    return f" True poses were given (grant_truth) to the localizer {listed_robots}." if listed_robots else ""


def promises_table(runs: Runs) -> Table | None:
    """Build the table of the runs whose planners break promises as other runs show; None if there is none."""
    broken = [index for index, status in enumerate(runs.status) if status == RunStatus.PROMISE_BROKEN]
    if not broken:
        return None
    more = f" {len(broken) - MOST_BROKEN} more are in the list of runs." if len(broken) > MOST_BROKEN else ""
    return Table(
        key="promises",
        title="Promises that other runs of the same problem refute",
        headings=("run", "planner", "seed", "repeat", "the planner"),
        rows=tuple(
            (
                runs.run_id[index][:SHORT],
                word(runs.configs[runs.config[index]].get("planner")),
                int(runs.seed[index]),
                int(runs.repeat[index]),
                runs.message[index],
            )
            for index in broken[:MOST_BROKEN]
        ),
        keys=5,
        note=(
            f"{len(broken)} runs have the status promise_broken: they count as failures, and none of their other values"
            f" counts. Costs are in ticks.{more}"
        ),
    )


def means_table(
    settings: Sequence[Setting], numbers: Sequence[Sequence[Numbers]], columns: Sequence[Column], runs: Runs
) -> Table:
    """Build the table of means over all units of each group that have a value."""
    axes = axes_of(settings)
    rows = [
        (
            *_axes_cells(group, axes),
            *(_shown(entry.overall[column.name], column, runs, _size(setting, group)) for column in columns),
        )
        for setting, group, entry in _groups(settings, numbers)
    ]
    return Table(
        key="overall",
        title="Means over all runs that have the value",
        headings=(*axes, *(heading(column) for column in columns)),
        rows=tuple(rows),
        keys=len(axes),
        note=(
            f"Mean over {_unit(settings)}{_interval(rows)}; n is given if some have no value."
            " Groups may have values for different scenarios: compare groups in the next tables only."
        ),
    )


def _interval(rows: Sequence[Sequence[Cell]]) -> str:
    """Return how intervals of means are made, where there are some."""
    shown = (cell.estimate for row in rows for cell in row if isinstance(cell, Shown))
    return " [95 % bootstrap interval]" if any(estimate.has_interval for estimate in shown) else ""


def common_table(
    settings: Sequence[Setting], numbers: Sequence[Sequence[Numbers]], columns: Sequence[Column], runs: Runs
) -> Table | None:
    """Build the same table over the units that all groups of a setting have in common; None if there is one group."""
    compared = [
        (setting, results) for setting, results in zip(settings, numbers, strict=True) if len(setting.groups) > 1
    ]
    if not compared:
        return None
    some = [setting for setting, _ in compared]
    axes = axes_of(some)
    rows = [
        (
            *_axes_cells(group, axes),
            _n(results.common["succeeded"]),
            _rate(results.common["succeeded"]),
            *(_shown(results.common[column.name], column, runs, _n(results.common["succeeded"])) for column in columns),
        )
        for _, group, results in _groups(some, [results for _, results in compared])
    ]
    note = (
        f"Success over the {_unit(settings)} for which every group found a plan in every run; each other column over"
        " those for which every group has a value (n is given if it differs)."
    )
    everything = (
        _n(value) == _n(entry.overall[name])
        for _, results in compared
        for entry in results
        for name, value in entry.common.items()
    )
    if all(everything):
        rows, note = [], f"{note} Here these are all units, so the numbers are those of the overall table."
    return Table(
        key="common",
        title="Normalised: over what all groups of a setting have in common",
        headings=(*axes, _unit(some), "success rate", *(heading(column) for column in columns)),
        rows=tuple(rows),
        keys=len(axes),
        note=note,
    )


def pairs_table(comparisons: Sequence[Comparison], brief: bool = False) -> Table | None:
    """Build the table of paired differences and tests; None if nothing was compared.

    Args:
        comparisons: all of one family.
        brief: only count the comparisons that cannot be significant.
    """
    if not comparisons:
        return None
    able = [entry for entry in comparisons if entry.paired.can_be_significant]
    shown = able if brief else comparisons
    hidden = len(comparisons) - len(shown)
    others = f" (the page and the files have the other {hidden}, in which fewer than six pairs differ)" * bool(hidden)
    sides = len({(entry.first, entry.second) for entry in comparisons}) > 1
    named = any(entry.setting for entry in comparisons)
    rows = []
    for entry in sorted(shown, key=lambda entry: entry.column.name not in RATES):
        paired = entry.paired
        scale = 100 if entry.is_rate else 1
        relative = (
            None if entry.is_rate or not paired.first else f"{100 * paired.difference.value / abs(paired.first):+.1f} %"
        )
        rows.append(
            (
                *([entry.setting] if named else []),
                entry.column.name,
                *([entry.first, entry.second] if sides else []),
                paired.difference.n,
                "/".join(map(str, entry.unpaired)),
                _point(paired.first * scale, entry.is_rate),
                _point(paired.second * scale, entry.is_rate),
                Shown(paired.difference, percent=entry.is_rate, usual=paired.difference.n),
                relative,
                f"{paired.above}/{paired.ties}/{paired.below}",
                f"{paired.effect:+.2f}",
                p_value(paired.p),
                p_value(entry.p_adjusted),
                f"{entry.verdict}, mean disagrees"
                if entry.is_mixed and entry.p_adjusted < SIGNIFICANT
                else entry.verdict,
            )
        )
    return Table(
        key="pairs",
        title="Pair by pair: B against A on the same scenarios",
        headings=(
            *(["setting"] if named else []),
            "column",
            *(("A", "B") if sides else ()),
            *("pairs", "unpaired", "mean A", "mean B", "B - A", "relative", "more/same/less"),
            *("effect", "p", "p (Holm)", "B is"),
        ),
        rows=tuple(rows),
        keys=1 + named + 2 * sides,
        note=(
            "Rates: McNemar's exact test; values: Wilcoxon's signed-rank test; Holm's correction over the"
            f" {len(able)} of {len(comparisons)} tests that could be significant"
            f"{others}."
            " Effect: matched-pairs rank-biserial correlation."
        ),
    )


def axes_of(settings: Sequence[Setting]) -> list[str]:
    """Names of all axes, in the order of their first appearance."""
    return list(dict.fromkeys(key for setting in settings for group in setting.groups for key in group.axes))


def _groups(
    settings: Sequence[Setting], numbers: Sequence[Sequence[Numbers]]
) -> list[tuple[Setting, RunGroup, Numbers]]:
    return [
        (setting, group, entry)
        for setting, entries in zip(settings, numbers, strict=True)
        for group, entry in zip(setting.groups, entries, strict=True)
    ]


def _axes_cells(group: RunGroup, axes: Sequence[str]) -> list[Cell]:
    return [word(group.axes[key]) if key in group.axes else None for key in axes]


def _shown(estimate: IntervalEstimate | None, column: Column, runs: Runs, usual: int | None) -> Cell:
    return None if estimate is None else Shown(estimate, percent=column.name in runs.flags, usual=usual)


def _rate(estimate: IntervalEstimate | None) -> Cell:
    return None if estimate is None else Shown(estimate, percent=True, usual=estimate.n)


def _n(estimate: IntervalEstimate | None) -> int:
    return 0 if estimate is None else estimate.n


def _size(setting: Setting, group: RunGroup) -> int:
    return len(np.unique(setting.units[group.counted]))


def _unit(settings: Sequence[Setting]) -> str:
    return " or ".join(dict.fromkeys(setting.unit for setting in settings))


def _point(value: float, percent: bool) -> str:
    return f"{value:.0f} %" if percent else f"{exact(value):.4g}"
