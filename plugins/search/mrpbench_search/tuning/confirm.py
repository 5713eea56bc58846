"""What held-out seeds show of a tuned setting, and what each parameter contributes."""

from collections.abc import Sequence
from enum import StrEnum
from typing import Any

import attrs
import numpy as np

from mrpbench_core.api.metric import Column
from mrpbench_core.report.reading.columns import direction
from mrpbench_core.report.statistics.estimate import LEVEL
from mrpbench_core.report.statistics.paired import Difference, adjust, compare_values
from mrpbench_search.tuning.constraints import Constraint
from mrpbench_search.tuning.evaluation import Evaluated, Evaluation, Sample
from mrpbench_search.tuning.parameters import Parameter


class Standing(StrEnum):
    """What held-out seeds show."""

    BETTER = "better"
    NOT_SHOWN = "not shown"
    WORSE = "worse"
    REFUSED = "refused"
    """It breaks a constraint."""


@attrs.frozen(kw_only=True)
class Comparison:
    """A setting against the defaults on held-out samples."""

    where: str
    """What these runs have instead of the study's options; empty = nothing."""
    differences: tuple[Difference | None, ...]
    """Of each objective, on the samples at which both succeed: the setting minus the defaults."""
    success: tuple[float, float]
    """Shares of runs that succeed: with the defaults, and with the setting."""
    broken: tuple[str, ...]
    """Constraints that do not hold."""

    def standing(self, column: Column, place: int = 0) -> Standing:
        """Return what is shown of one objective."""
        found = self.differences[place]
        if self.broken:
            return Standing.REFUSED
        if found is None or not found.can_be_significant or found.p > 1 - LEVEL:
            return Standing.NOT_SHOWN
        if not found.difference.low * found.difference.high > 0:
            return Standing.NOT_SHOWN
        return Standing.BETTER if found.difference.value * direction(column) > 0 else Standing.WORSE

    def share(self, place: int = 0) -> tuple[float, float, float] | None:
        """Return the difference and its interval as shares of the mean with the defaults; None without an interval."""
        found = self.differences[place]
        if found is None or not found.first or not found.difference.has_interval:
            return None
        each = found.difference
        return each.value / found.first, each.low / found.first, each.high / found.first


def compare_held_out(
    setting: dict[str, Any],
    evaluation: Evaluation,
    samples: Sequence[Sample],
    objectives: Sequence[Column],
    constraints: Sequence[Constraint],
    where: str = "",
) -> Comparison:
    """Run the defaults and a setting on held-out samples.

    Args:
        setting: values by option.
        evaluation: does the runs.
        samples: that the search has not had.
        objectives: columns that are compared.
        constraints: that are checked.
        where: what the runs of `evaluation` have instead of the study's options; empty = nothing.

    Raises:
        SearchEnded: runs of other shards are missing.
    """
    base, tuned = evaluation([{}, setting], samples)
    excess = [(each, each.excess(tuned.mean(each.column), base.mean(each.column))) for each in constraints]
    return Comparison(
        where=where,
        differences=tuple(_difference(base, tuned, column.name) for column in objectives),
        success=(base.mean("succeeded"), tuned.mean("succeeded")),
        broken=tuple(each.text for each, beyond in excess if beyond > 0),
    )


@attrs.frozen(kw_only=True)
class Importance:
    """What is lost on the training seeds if a parameter goes back to its default."""

    key: str
    value: Any
    default: Any
    loss: float | None
    """Share of the objective by which it becomes worse; None if it does not matter: all runs are the same."""
    low: float | None = None
    high: float | None = None
    """Of the interval; None if there are too few samples."""
    shown: bool = False
    """The paired test shows a difference, with Holm's correction."""


def importances(
    setting: dict[str, Any],
    tuned: Evaluated,
    parameters: Sequence[Parameter],
    evaluation: Evaluation,
    samples: Sequence[Sample],
    column: Column,
) -> list[Importance]:
    """Run a setting with each parameter at its default, one at a time; return the most important one first.

    Raises:
        SearchEnded: runs of other shards are missing.
    """
    moved = [each for each in parameters if setting[each.key] != each.default]
    if not moved:
        return []
    found = evaluation([setting | {each.key: each.default} for each in moved], samples)
    differences = [_difference(tuned, one, column.name) for one in found]
    levels = adjust([each for each in differences if each is not None])
    p = iter(levels)
    rows = []
    for each, one, difference in zip(moved, found, differences, strict=True):
        level = next(p) if difference is not None else 1.0
        value, default = setting[each.key], each.default
        if difference is None or tuned.same(one):
            rows.append(Importance(key=each.key, value=value, default=default, loss=None))
            continue
        scale = -direction(column) / difference.first if difference.first else np.nan
        low, high = _interval(difference, scale)
        loss, shown = difference.difference.value * scale, level <= 1 - LEVEL
        rows.append(Importance(key=each.key, value=value, default=default, loss=loss, low=low, high=high, shown=shown))
    return sorted(rows, key=lambda row: -np.inf if row.loss is None else row.loss, reverse=True)


def _interval(found: Difference, scale: float) -> tuple[float, float] | tuple[None, None]:
    if not found.difference.has_interval:
        return None, None
    low, high = sorted((found.difference.low * scale, found.difference.high * scale))
    return low, high


def _difference(one: Evaluated, other: Evaluated, column: str) -> Difference | None:
    first, second = one.columns[column], other.columns[column]
    both = np.isfinite(first) & np.isfinite(second)
    return compare_values(first[both], second[both])
