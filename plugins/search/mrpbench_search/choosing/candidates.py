"""The candidates of a study, and the settings in which they race."""

from collections.abc import Sequence

import attrs

from mrpbench_core.engine.loading.runs import StudyRun, StudyRuns
from mrpbench_core.files.errors import InputError
from mrpbench_core.report.reading.axes import Axes, is_below, name_axes
from mrpbench_search.asking.configurations import with_axes

CHOICES = ("planner", "assigner", "dispatcher", "navigator", "controller", "localizer")
"""Blocks in which candidates differ by default; in all other options settings differ."""


@attrs.define(kw_only=True)
class Setting:
    """Runs in which only the candidate, the seed and the repeat differ."""

    name: str
    axes: Axes
    """The options in which it differs from other settings."""
    names: list[str] = attrs.field(factory=list)
    """Of its candidates."""
    points: list[dict[int, list[StudyRun]]] = attrs.field(factory=list)
    """For each candidate, its runs by seed."""
    seeds: list[int] = attrs.field(factory=list)
    """In the order of the study."""

    def runs(self, candidate: int, seeds: int) -> list[StudyRun]:
        """Return the runs of a candidate at the first seeds."""
        return [point for seed in self.seeds[:seeds] for point in self.points[candidate][seed]]


def find_candidates(study: StudyRuns, choices: Sequence[str] = CHOICES) -> list[Setting]:
    """Group the runs of a study by setting and candidate.

    Args:
        study: its runs.
        choices: options, or blocks of options, in which candidates differ.

    Raises:
        InputError: a setting has one candidate, or its candidates have different seeds.
    """
    settings: dict[str, Setting] = {}
    for axes, points in with_axes(study):
        chosen = {key: value for key, value in axes.items() if is_below(key, choices)}
        others = {key: value for key, value in axes.items() if key not in chosen}
        setting = settings.setdefault(repr(others), Setting(name=name_axes(others), axes=others))
        by_seed: dict[int, list[StudyRun]] = {}
        for point in points:
            by_seed.setdefault(point.canonical["seed"], []).append(point)
        setting.seeds = setting.seeds or list(by_seed)
        where = f" with {setting.name}" if setting.name else ""
        if set(by_seed) != set(setting.seeds):
            raise InputError(f"seed: candidates have different seeds{where}", hint="they are compared seed by seed")
        setting.names.append(name_axes(chosen))
        setting.points.append(by_seed)
    for setting in settings.values():
        if len(setting.names) < 2:
            varied = ", ".join(dict.fromkeys(key.partition(".")[0] for key in setting.axes))
            raise InputError(
                f"the study has one candidate: none of {', '.join(choices)} varies"
                + (f" with {setting.name}" if setting.name else ""),
                hint=f"--candidates names other options; these vary: {varied}" if varied else "list some in the matrix",
            )
    return list(settings.values())
