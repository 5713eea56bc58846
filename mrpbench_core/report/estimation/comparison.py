"""Compares groups in pairs, on the units that both have."""

from collections.abc import Iterable, Sequence
from itertools import combinations

import attrs
import numpy as np

from mrpbench_core.api.metric import Column
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.report.estimation.groups import RunGroup, Setting, differing_factors
from mrpbench_core.report.reading.columns import direction
from mrpbench_core.report.reading.runs import Runs
from mrpbench_core.report.statistics.paired import Difference, adjust, compare_rates, compare_values

SIGNIFICANT = 0.05
"""Adjusted p below which a difference is significant."""


@attrs.frozen(kw_only=True)
class Comparison:
    """One column of two groups: the second compared with the first."""

    setting: str
    first: str
    second: str
    unit: str
    column: Column
    is_rate: bool
    found: Difference
    unpaired: tuple[int, int]
    """Number of units of each group that have a value but no partner."""
    p_adjusted: float = 1.0

    @property
    def is_mixed(self) -> bool:
        """True if the mean and the ranks, which decide the verdict, have different signs."""
        return self.found.effect * self.found.difference.value < 0

    @property
    def verdict(self) -> str:
        """The verdict on the second: better, worse, different (where no direction is known), or not shown to differ."""
        if self.p_adjusted >= SIGNIFICANT:
            return "not shown"
        return {1: "better", -1: "worse", 0: "different"}[direction(self.column) * (1 if self.found.effect > 0 else -1)]


def compare_pair(
    runs: Runs,
    units: Int,
    unit: str,
    sides: tuple[RunGroup, RunGroup],
    names: tuple[str, str, str],
    columns: Iterable[Column],
) -> list[Comparison]:
    """Compare two groups in every column in which both have values for a common unit.

    Args:
        runs: of both groups.
        units: of each run, what it is a sample of.
        unit: the word for that.
        sides: first and second.
        names: of the setting, the first and the second.
        columns: what to compare.
    """
    found = []
    for column in columns:
        (one, first, _), (other, second, _) = (group.by_unit(runs, units, column.name) for group in sides)
        both, at_first, at_second = np.intersect1d(one, other, assume_unique=True, return_indices=True)
        is_rate = column.name in runs.flags
        difference = (compare_rates if is_rate else compare_values)(first[at_first], second[at_second])
        if difference is not None:
            found.append(
                Comparison(
                    setting=names[0],
                    first=names[1],
                    second=names[2],
                    unit=unit,
                    column=column,
                    is_rate=is_rate,
                    found=difference,
                    unpaired=(len(one) - len(both), len(other) - len(both)),
                )
            )
    return found


def compare_settings(runs: Runs, settings: Sequence[Setting], columns: Sequence[Column]) -> list[Comparison]:
    """Compare all pairs of groups of a setting that differ in one choice; p is adjusted for the number of tests."""
    found = []
    for setting in settings:
        for (i, first), (j, second) in combinations(enumerate(setting.groups), 2):
            if len(differing_factors(first.axes, second.axes)) == 1:
                names = setting.name, setting.names[i], setting.names[j]
                found += compare_pair(runs, setting.units, setting.unit, (first, second), names, columns)
    return adjusted(found)


def adjusted(comparisons: Sequence[Comparison]) -> list[Comparison]:
    """Return the comparisons with p adjusted for the number of tests."""
    p = adjust([entry.found for entry in comparisons])
    return [attrs.evolve(entry, p_adjusted=value) for entry, value in zip(comparisons, p, strict=True)]
