"""Ranks the configurations of a setting by one column.

A run that failed lacks values, or has the values of an execution that was cut short. Configurations whose runs fail
more often are therefore ranked after the others, whatever the mean of the runs that are left.
"""

from collections import Counter
from collections.abc import Iterable, Mapping
from functools import reduce

import attrs
import numpy as np

from mrpbench_core.api.metric import Column
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.runs.status import LEFT_OUT, RunStatus
from mrpbench_core.report.estimation.comparison import Comparison
from mrpbench_core.report.estimation.estimates import estimate
from mrpbench_core.report.estimation.groups import RunGroup, Setting
from mrpbench_core.report.estimation.relation import Relation, relation, turned
from mrpbench_core.report.reading.columns import OUTCOME, direction
from mrpbench_core.report.reading.runs import PAR2, Runs
from mrpbench_core.report.statistics.estimate import IntervalEstimate

Compared = Mapping[tuple[str, frozenset[str]], Comparison]
"""The comparisons of a setting by column and names of both groups."""
_RATE = {"planning": "planned", "execution": "succeeded"}
"""The rate of the runs that have values of a stage."""
_CLOSE = OUTCOME[0].threshold or 0.0
"""Difference of rates from which on one group fails more often than another."""


@attrs.frozen(kw_only=True)
class Place:
    """One configuration in a ranking."""

    name: str
    style: int
    """Place in the setting, which gives the colour and the mark."""
    estimate: IntervalEstimate | None
    relation: Relation | None = None
    """To the first place; None for the first place itself, and if there is no value."""
    difference: IntervalEstimate | None = None
    """This one minus the first, over the units that both have."""
    fails_more: bool = False
    """True if its rate of success is lower, so that its mean leaves out runs that others have."""
    failures: str = ""
    """Its failures by status, the most frequent one first."""


@attrs.frozen(kw_only=True)
class Ranking:
    """The configurations of a setting, best first."""

    column: Column
    is_rate: bool
    unit: str
    """The word for units."""
    places: tuple[Place, ...]
    ranked: int
    """Number of units over which the first places have their means."""

    def having(self, *relations: Relation) -> list[Place]:
        """Return the places with one of these relations to the first."""
        return [place for place in self.places if place.relation in relations]


def by_names(comparisons: Iterable[Comparison], setting: str) -> Compared:
    """Return the comparisons of one setting by column and names."""
    return {
        (entry.column.name, frozenset((entry.first, entry.second))): entry
        for entry in comparisons
        if entry.setting == setting
    }


def is_identical(compared: Compared) -> bool:
    """Tell whether the configurations have the same values in all pairs; what the engine measures does not count."""
    comparisons = [entry for (column, _), entry in compared.items() if not column.startswith("timing.")]
    has_values = any(not entry.is_rate for entry in comparisons)  # that all succeed says little
    return has_values and all(entry.paired.ties == entry.paired.difference.n for entry in comparisons)


def rank(runs: Runs, setting: Setting, column: Column, compared: Compared) -> Ranking:
    """Rank the groups of a setting by the mean of a column.

    Means are over the units that all groups have that do not fail more often; for one that does, over those of them
    that it has.
    """
    is_rate = column.name in runs.flags
    later = [False] * len(setting.groups) if is_rate or column.name == PAR2 else fail_more(runs, setting, column)
    units_of_groups = [group.by_unit(runs, setting.units, column.name)[0] for group in setting.groups]
    base = _common([units for units, after in zip(units_of_groups, later, strict=True) if len(units) and not after])
    means = [
        _mean(runs, setting, group, column, units, base if not is_rate else None)
        for group, units in zip(setting.groups, units_of_groups, strict=True)
    ]
    places = [
        Place(
            name=name,
            style=index,
            estimate=means[index],
            fails_more=later[index],
            failures=failures(runs, setting.groups[index]) if is_rate else "",
        )
        for index, name in enumerate(setting.names)
    ]
    places.sort(key=lambda place: _order(place, direction(column)))
    first = places[0]
    return Ranking(
        column=column,
        is_rate=is_rate,
        unit=setting.unit,
        places=(first, *(_related(place, first, column, compared) for place in places[1:])),
        ranked=first.estimate.n if first.estimate else 0,
    )


def fail_more(runs: Runs, setting: Setting, column: Column) -> list[bool]:
    """Tell for each group whether its rate of success in the column's stage is lower than that of another one."""
    rates = [estimate(runs, setting, group, _RATE[column.stage]) for group in setting.groups]
    best = max((rate.value for rate in rates if rate is not None), default=0.0)
    return [rate is not None and rate.value < best - _CLOSE + 1e-9 for rate in rates]


def failures(runs: Runs, group: RunGroup) -> str:
    """Count the failures of a group: `3 plan timeout, 1 crashed`."""
    counts = Counter({s: n for s, n in group.statuses(runs).items() if s not in {RunStatus.SUCCEEDED, *LEFT_OUT}})
    ordered = sorted(counts.items(), key=lambda item: (-item[1], item[0]))
    return ", ".join(f"{count} {status.replace('_', ' ')}" for status, count in ordered)


def _mean(
    runs: Runs, setting: Setting, group: RunGroup, column: Column, units: Int, base: Int | None
) -> IntervalEstimate | None:
    """The mean over the units in `base`, or over its own units if it has none of these."""
    if base is not None and not np.isin(units, base).any():
        base = None
    return estimate(runs, setting, group, column.name, base)


def _common(units: list[Int]) -> Int:
    return reduce(np.intersect1d, units) if units else np.empty(0, np.int64)


def _order(place: Place, sign: int) -> tuple[bool, bool, float, str]:
    value = 0.0 if place.estimate is None else float(f"{-sign * place.estimate.value:.9g}")
    return place.estimate is None, place.fails_more, value, place.name


def _related(place: Place, first: Place, column: Column, compared: Compared) -> Place:
    if place.estimate is None:
        return place
    comparison = compared.get((column.name, frozenset((first.name, place.name))))
    if comparison is None:
        return attrs.evolve(place, relation=Relation.NOT_COMPARED)
    comparison = comparison if comparison.second == place.name else turned(comparison)
    return attrs.evolve(place, relation=relation(comparison), difference=comparison.paired.difference)
