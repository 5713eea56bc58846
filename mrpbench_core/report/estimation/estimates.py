"""Estimates for groups of runs, over all units and over the units that all groups of a setting have in common."""

from collections.abc import Iterable
from functools import reduce

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Int
from mrpbench_core.report.estimation.groups import RunGroup, Setting
from mrpbench_core.report.reading.runs import Runs
from mrpbench_core.report.statistics.estimate import IntervalEstimate
from mrpbench_core.report.statistics.means import mean
from mrpbench_core.report.statistics.rates import rate


@attrs.frozen(kw_only=True)
class Numbers:
    """Estimates of a group, by column."""

    overall: dict[str, IntervalEstimate | None]
    """Over every unit of the group that has a value."""
    common: dict[str, IntervalEstimate | None]
    """Over the units that every group of the setting has a value for."""


def estimate(
    runs: Runs, setting: Setting, group: RunGroup, column: str, only: Int | None = None
) -> IntervalEstimate | None:
    """Mean or rate of a column over a group's units, or over those in `only`; None where no unit has a value."""
    numbers, values, count = group.by_unit(runs, setting.units, column)
    if only is not None:
        chosen = np.isin(numbers, only)
        count = round(count * chosen.mean()) if len(chosen) else 0
        numbers, values = numbers[chosen], values[chosen]
    values = setting.by_sample(numbers, values)
    return rate(values, max(count, len(values))) if column in runs.flags else mean(values)


def common_units(runs: Runs, setting: Setting, column: str) -> Int:
    """Units for which every group has a value; for success, units for which every run of every group has a plan.

    Recordings without plans have every unit in which they count. A group that has plans but never the value, for
    example because it was not executed, does not count. A group that never finds a plan counts, so that no unit is
    common to all groups.
    """
    having = []
    for group in setting.groups:
        if not len(group.counted):
            continue  # the planner was skipped: n/a
        if column in ("succeeded", "planned"):
            numbers, values, _ = group.by_unit(runs, setting.units, "planned")
            known = np.isfinite(runs.values["planned"][group.counted]).any()
            having.append(numbers[values == 1] if known else np.unique(setting.units[group.counted]))
        else:
            numbers, _, _ = group.by_unit(runs, setting.units, column)
            if len(numbers) or not (runs.values["planned"][group.counted] == 1).any():
                having.append(numbers)
    return reduce(np.intersect1d, having) if having else np.empty(0, np.int64)


def numbers_of(runs: Runs, setting: Setting, columns: Iterable[str]) -> list[Numbers]:
    """Estimates of every group of a setting."""
    columns = list(columns)
    common = {column: common_units(runs, setting, column) for column in columns}
    return [
        Numbers(
            overall={column: estimate(runs, setting, group, column) for column in columns},
            common={column: estimate(runs, setting, group, column, common[column]) for column in columns},
        )
        for group in setting.groups
    ]
