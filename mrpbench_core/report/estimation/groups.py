"""Groups of runs that differ in seed and repeat only, and settings: groups that have scenarios in common."""

from collections import Counter
from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.report.reading.axes import Axes, factors, name_axes
from mrpbench_core.report.reading.runs import Runs


@attrs.frozen(kw_only=True, eq=False)
class RunGroup:
    """Runs of one configuration, or of several that are pooled."""

    axes: Axes
    """Options in which it differs from other groups, by dotted name."""
    members: Int
    """Indices of all its runs."""
    counted: Int
    """Indices of the runs that say something about the method."""

    def statuses(self, runs: Runs) -> Counter[str]:
        """Count the runs of each status."""
        return Counter(runs.status[index] for index in self.members)

    def by_unit(self, runs: Runs, units: Int, column: str) -> tuple[Int, Float, int]:
        """Return the units with a value, the mean over the runs of each unit, and the number of these runs."""
        values = runs.values[column][self.counted]
        having = np.isfinite(values)
        numbers, place = np.unique(units[self.counted][having], return_inverse=True)
        count = np.bincount(place, minlength=len(numbers))
        total = np.bincount(place, weights=values[having], minlength=len(numbers))
        return numbers, total / np.maximum(count, 1), int(having.sum())


@attrs.frozen(kw_only=True, eq=False)
class Setting:
    """Groups that share scenarios, so that they can be compared pair by pair."""

    name: str
    """The options in which it differs from other settings."""
    groups: tuple[RunGroup, ...]
    names: tuple[str, ...]
    """For each group, the options in which it differs from the others."""
    units: Int
    """The unit of each run of the folders; see `Runs.units`."""
    unit: str
    """`scenarios` or `runs`."""
    cells: int = 1
    """Units of one sample: unit u belongs to sample u // cells. Pairs are formed of units, and averaged to samples."""
    axes: Axes = attrs.field(factory=dict)
    """The options of `name`, by dotted name."""

    def by_sample(self, numbers: Int, values: Float) -> Float:
        """Average values of units, so that there is one for each sample."""
        place = np.unique(numbers // self.cells, return_inverse=True)[1]
        return np.bincount(place, weights=values) / np.maximum(np.bincount(place), 1)


def group_runs(runs: Runs, by: Sequence[str] | None = None) -> list[RunGroup]:
    """Group the runs, in the order of the first run of each group.

    Args:
        runs: of one or several folders.
        by: options that distinguish groups; None = all that vary.
    """
    axes = runs.axes(by)
    numbers: dict[str, int] = {}
    of_config = np.array([numbers.setdefault(repr(entry), len(numbers)) for entry in axes], np.int64)
    first = {of_config[index]: axes[index] for index in range(len(axes) - 1, -1, -1)}
    of_run = of_config[runs.config] if len(runs) else np.empty(0, np.int64)
    order = np.argsort(of_run, kind="stable")
    parts = np.split(order, np.cumsum(np.bincount(of_run, minlength=len(numbers)))[:-1]) if len(runs) else []
    return [
        RunGroup(axes=first[number], members=part, counted=part[runs.counted[part]])
        for number, part in enumerate(parts)
    ]


def find_settings(runs: Runs, groups: Sequence[RunGroup]) -> list[Setting]:
    """Collect groups that share scenarios, directly or through other groups.

    Groups that only plan are apart from those that execute their plans, since success is another thing there.
    """
    parts: list[tuple[set[tuple[int, bool]], list[RunGroup]]] = []
    for group in groups:
        plans = group.axes.get("simulator.plugin") == "none"
        scenarios = {(number, plans) for number in np.unique(runs.scenario[group.members]).tolist() if number >= 0}
        touching = [part for part in parts if part[0] & scenarios]
        parts = [part for part in parts if part not in touching]
        merged = [member for _, members in touching for member in members]
        parts.append((scenarios.union(*(known for known, _ in touching)), [*merged, group]))
    order = {id(group): index for index, group in enumerate(groups)}
    chosen = sorted(
        (sorted(members, key=lambda one: order[id(one)]) for _, members in parts), key=lambda m: order[id(m[0])]
    )
    shared = [constant_axes(members) for members in chosen]
    return [
        _setting(runs, members, {key: value for key, value in axes.items() if _differs(key, shared)})
        for members, axes in zip(chosen, shared, strict=True)
    ]


def merge_settings(runs: Runs, settings: Sequence[Setting], samples: str | None = None) -> list[Setting] | None:
    """Return fewer settings, with the runs of several in each; None if their configurations differ.

    Args:
        runs: of the settings.
        settings: of which those are merged that differ only in what `samples` names.
        samples: options below this name are samples, such as the files of scenarios; None = all options.
    """
    names = settings[0].names
    if len(names) < 2 or any(set(setting.names) != set(names) for setting in settings):
        return None
    parts: dict[str, list[Setting]] = {}
    for setting in settings:
        axes = (
            {}
            if samples is None
            else {k: v for k, v in constant_axes(setting.groups).items() if not k.startswith(samples)}
        )
        parts.setdefault(repr(axes), []).append(setting)
    merged = [
        [pooled([setting.groups[setting.names.index(name)] for setting in part]) for name in names]
        for part in parts.values()
    ]
    shared = [constant_axes(groups) for groups in merged]
    return [
        _setting(runs, groups, {key: value for key, value in axes.items() if _differs(key, shared)})
        for groups, axes in zip(merged, shared, strict=True)
    ]


def pooled(groups: Sequence[RunGroup]) -> RunGroup:
    """Return one group with the runs of all of these."""
    return RunGroup(
        axes=constant_axes(groups),
        members=np.sort(np.concatenate([group.members for group in groups])),
        counted=np.sort(np.concatenate([group.counted for group in groups])),
    )


def differing_factors(first: Axes, second: Axes) -> list[str]:
    """Return the blocks in which two groups differ; a planner and its options are one block."""
    one, other = factors(first), factors(second)
    return [name for name in dict.fromkeys([*one, *other]) if repr(one.get(name)) != repr(other.get(name))]


def _setting(runs: Runs, members: Sequence[RunGroup], axes: Axes) -> Setting:
    units, unit = runs.units([group.members for group in members])
    constant = constant_axes(members)
    varying = [{key: value for key, value in group.axes.items() if key not in constant} for group in members]
    return Setting(
        name=name_axes(axes),
        axes=axes,
        groups=tuple(members),
        names=tuple(name_axes(entry) or "all runs" for entry in varying),
        units=units,
        unit=unit,
    )


def constant_axes(members: Sequence[RunGroup]) -> Axes:
    """Return the axes that are the same in all groups."""
    return {
        key: value
        for key, value in members[0].axes.items()
        if all(repr(group.axes.get(key)) == repr(value) for group in members)
    }


def _differs(key: str, settings: Sequence[Axes]) -> bool:
    return len({repr(axes.get(key)) for axes in settings}) > 1
