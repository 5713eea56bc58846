"""Compares two results folders, configuration by configuration, on the scenarios that both have."""

from collections.abc import Sequence
from typing import Any

import attrs
import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.extras import has, pip
from mrpbench_core.report.estimation.comparison import Comparison, adjusted, compare_pair
from mrpbench_core.report.estimation.groups import RunGroup, Setting
from mrpbench_core.report.reading.axes import Axes, name_axes, word
from mrpbench_core.report.reading.folders import read_folders
from mrpbench_core.report.reading.invocations import made_with, read_invocations
from mrpbench_core.report.reading.runs import Runs
from mrpbench_core.report.report import choose_columns, tested
from mrpbench_core.store.results import Results


@attrs.frozen(kw_only=True)
class FolderComparison:
    """Folder B compared with folder A."""

    comparisons: tuple[Comparison, ...]
    differing: dict[str, tuple[str, str]]
    """Options, versions and machines that have one value throughout A and another throughout B."""
    unmatched: tuple[tuple[str, ...], tuple[str, ...]]
    """Configurations of A that B lacks, and of B that A lacks."""
    no_common_scenario: tuple[str, ...]
    """Configurations in both folders that share no scenario."""


def compare_folders(
    first: Results, second: Results, metrics: Sequence[str] | None = None, by: Sequence[str] | None = None
) -> FolderComparison:
    """Compare B with A.

    Configurations match where they agree in every option that varies within a folder; options with one
    value in A and another in B are compared.

    Args:
        first: A.
        second: B.
        metrics: columns to compare; None = a few that matter, `["all"]` = all.
        by: options in which configurations must agree to match; runs that differ in others are pooled.

    Raises:
        InputError: SciPy is missing, a folder is empty, a name is wrong, or nothing can be paired.
    """
    if not has("scipy"):
        raise InputError("comparing needs SciPy", hint=pip("statistics"))
    folders = (first, second)
    for results in folders:
        if not len(results):
            raise InputError("no run is recorded here yet", file=results.folder.path)
    runs, known = read_folders(folders, once=False)
    columns = choose_columns(runs, known, metrics)
    axes = runs.axes()
    matching = _varying_within(runs, axes) if by is None else list(dict.fromkeys(k for a in runs.axes(by) for k in a))
    sides = [_groups(runs, axes, folder, matching) for folder in (0, 1)]
    comparisons: list[Comparison] = []
    no_common_scenario = []
    for key in (key for key in sides[0] if key in sides[1]):
        pair = sides[0][key], sides[1][key]
        units, unit = runs.units([group.members for group in pair])
        name = name_axes(pair[0].axes)
        setting = Setting(name=name, groups=pair, names=("A", "B"), units=units, unit=unit)
        entries = compare_pair(runs, setting, 0, 1, tested(runs, known, columns))
        comparisons += entries
        if not entries:
            no_common_scenario.append(name or "all runs")
    if not comparisons:
        raise InputError(
            f"have no {'scenario' if no_common_scenario else 'configuration'} in common, so that nothing can be paired",
            file=f"{first.folder.path} and {second.folder.path}",
            hint=f"configurations match by {', '.join(matching) or 'nothing'}; --by chooses other options",
        )
    return FolderComparison(
        comparisons=tuple(adjusted(comparisons)),
        differing=_differing(runs, axes, matching) | _made_differently(folders),
        unmatched=(_missing(sides[0], sides[1]), _missing(sides[1], sides[0])),
        no_common_scenario=tuple(no_common_scenario),
    )


def _varying_within(runs: Runs, axes: Sequence[Axes]) -> list[str]:
    """Options that are not the same throughout one of the folders."""
    keys = list(dict.fromkeys(key for entry in axes for key in entry))
    return [key for key in keys if any(len(_values(runs, axes, folder, key)) > 1 for folder in (0, 1))]


def _values(runs: Runs, axes: Sequence[Axes], folder: int, key: str) -> dict[str, Any]:
    """Different values of an option in a folder, by how they are written."""
    used = np.unique(runs.config[runs.folder == folder])
    return {repr(axes[index].get(key)): axes[index].get(key) for index in used}


def _groups(runs: Runs, axes: Sequence[Axes], folder: int, matching: Sequence[str]) -> dict[str, RunGroup]:
    """Groups of one folder, by the options in which they must agree."""
    chosen = [{key: entry[key] for key in matching if key in entry} for entry in axes]
    names = np.array([repr(entry) for entry in chosen])
    groups = {}
    for name in dict.fromkeys(names.tolist()):
        members = np.flatnonzero((runs.folder == folder) & (names == name)[runs.config])
        if len(members):
            part = next(entry for entry in chosen if repr(entry) == name)
            groups[name] = RunGroup(axes=part, members=members, counted=members[runs.counted[members]])
    return groups


def _differing(runs: Runs, axes: Sequence[Axes], matching: Sequence[str]) -> dict[str, tuple[str, str]]:
    differing = {}
    for key in dict.fromkeys(key for entry in axes for key in entry if key not in matching):
        one, other = (_values(runs, axes, folder, key) for folder in (0, 1))
        if one.keys() != other.keys():
            differing[key] = (", ".join(map(word, one.values())), ", ".join(map(word, other.values())))
    return differing


def _made_differently(folders: Sequence[Results]) -> dict[str, tuple[str, str]]:
    one, other = (made_with(read_invocations([results])) for results in folders)
    return {
        name: (", ".join(one.get(name, ("–",))), ", ".join(other.get(name, ("–",))))
        for name in dict.fromkeys([*one, *other])
        if one.get(name) != other.get(name)
    }


def _missing(here: dict[str, RunGroup], there: dict[str, RunGroup]) -> tuple[str, ...]:
    return tuple(name_axes(group.axes) or "all runs" for key, group in here.items() if key not in there)
