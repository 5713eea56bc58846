"""Compares groups in pairs, on the units that both have."""

from collections.abc import Iterable, Sequence
from itertools import combinations

import attrs
import numpy as np

from mrpbench_core.api.metric import Column
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.report.estimation.groups import Setting, differing_factors
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
    paired: Difference
    unpaired: tuple[int, int]
    """Number of units of each group that have a value but no partner."""
    p_adjusted: float = 1.0
    steps: Float = attrs.field(factory=lambda: np.empty(0), eq=False, repr=False)
    """f8[units], second minus first."""

    @property
    def is_mixed(self) -> bool:
        """True if the mean and the ranks, which decide the verdict, have different signs."""
        return self.paired.effect * self.paired.difference.value < 0

    @property
    def verdict(self) -> str:
        """The verdict on the second: better, worse, different (where no direction is known), or not shown to differ."""
        if self.p_adjusted >= SIGNIFICANT:
            return "not shown"
        return {1: "better", -1: "worse", 0: "different"}[
            direction(self.column) * (1 if self.paired.effect > 0 else -1)
        ]


def compare_pair(runs: Runs, setting: Setting, first: int, second: int, columns: Iterable[Column]) -> list[Comparison]:
    """Compare two groups of a setting in every column in which both have values for a common unit."""
    sides = setting.groups[first], setting.groups[second]
    comparisons = []
    for column in columns:
        (one, left, _), (other, right, _) = (group.by_unit(runs, setting.units, column.name) for group in sides)
        both, at_left, at_right = np.intersect1d(one, other, assume_unique=True, return_indices=True)
        is_rate = column.name in runs.flags
        left, right = (setting.by_sample(both, values) for values in (left[at_left], right[at_right]))
        difference = (compare_rates if is_rate else compare_values)(left, right)
        if difference is not None:
            comparisons.append(
                Comparison(
                    setting=setting.name,
                    first=setting.names[first],
                    second=setting.names[second],
                    unit=setting.unit,
                    column=column,
                    is_rate=is_rate,
                    paired=difference,
                    unpaired=(len(one) - len(both), len(other) - len(both)),
                    steps=right - left,
                )
            )
    return comparisons


def compare_settings(runs: Runs, settings: Sequence[Setting], columns: Sequence[Column]) -> list[Comparison]:
    """Compare all pairs of groups of a setting that differ in one choice; p is adjusted for the number of tests."""
    comparisons = []
    for setting in settings:
        for (i, first), (j, second) in combinations(enumerate(setting.groups), 2):
            if len(differing_factors(first.axes, second.axes)) == 1:
                comparisons += compare_pair(runs, setting, i, j, columns)
    return adjusted(comparisons)


def adjusted(comparisons: Sequence[Comparison]) -> list[Comparison]:
    """Return the comparisons with p adjusted for the number of tests."""
    p = adjust([entry.paired for entry in comparisons])
    return [attrs.evolve(entry, p_adjusted=value) for entry, value in zip(comparisons, p, strict=True)]
