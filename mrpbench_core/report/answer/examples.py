"""Chooses runs to look at: typical, best, worst and failed ones, and two of one scenario that took different times."""

from collections.abc import Iterable, Iterator
from itertools import islice
from textwrap import shorten

import attrs
import numpy as np

from mrpbench_core.api.metric import Column
from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.runs.status import LEFT_OUT, RunStatus
from mrpbench_core.report.answer.amounts import change, quantity
from mrpbench_core.report.answer.answer import Answer, SettingAnswer
from mrpbench_core.report.answer.ranking import Ranking
from mrpbench_core.report.report import Report
from mrpbench_core.report.statistics.estimate import IntervalEstimate

SETTINGS = 2
"""Settings of which runs are chosen."""
TRIED = 40
"""Runs of which the recordings are looked for, for each choice."""
REASON = 80
"""Characters of the message of a failed run."""


@attrs.frozen(kw_only=True)
class Example:
    """A run to look at."""

    run: int
    """Index of the run."""
    label: str
    text: str


@attrs.frozen(kw_only=True)
class Contrast:
    """Two runs of one scenario, of which the second took much longer."""

    first: int
    second: int
    text: str


@attrs.frozen(kw_only=True)
class Examples:
    """The runs of one setting."""

    name: str
    runs: tuple[Example, ...]
    """Failed, worst, typical and best."""
    contrast: Contrast | None


def choose_examples(report: Report, answer: Answer) -> list[Examples]:
    """Choose recorded runs of the first settings, by the time that they took; none if no run is recorded."""
    if not any(any((results.folder.path / "recordings").glob("*.zip")) for results in report.folders):
        return []
    parts = answer.parts or ((answer.whole,) if answer.whole else ())
    chosen = (_of_setting(report, part) for part in parts)
    return list(islice((examples for examples in chosen if examples.runs), SETTINGS))


def _of_setting(report: Report, part: SettingAnswer) -> Examples:
    topic = next((topic for topic in part.topics if _is_drawn(topic.ranking.column)), None)
    ranking = topic.ranking if topic else None
    what = "" if topic is None or topic.title.endswith("?") else f"{topic.title.lower()} "
    counted = np.concatenate([group.counted for group in part.setting.groups])
    runs = [*_failed(report, part, counted)]
    if ranking is not None:
        values = report.runs.values[ranking.column.name]
        done = counted[(report.runs.values["succeeded"][counted] == 1) & np.isfinite(values[counted])]
        ordered = done[np.argsort(values[done], kind="stable")]
        middle = ordered[np.argsort(np.abs(np.arange(len(ordered)) - (len(ordered) - 1) / 2), kind="stable")]
        for label, candidates in (("longest", ordered[::-1]), ("typical", middle), ("shortest", ordered)):
            for run in islice(_recorded(report, candidates), 1):
                if run not in [example.run for example in runs]:
                    took = quantity(ranking, IntervalEstimate(float(values[run]), np.nan, np.nan, 1))
                    runs.append(
                        Example(run=run, label=label, text=f"{_name(part, run)}, {_seed(report, run)}: {what}{took}")
                    )
    contrast = _contrast(report, part, ranking) if ranking is not None else None
    return Examples(name=part.name, runs=tuple(runs), contrast=contrast)


def _is_drawn(column: Column) -> bool:
    """Tell whether the runs of a column with durations have motion to show; those that only plan have none."""
    return column.answers == "duration" and column.stage == "execution"


def _failed(report: Report, part: SettingAnswer, counted: Int) -> Iterator[Example]:
    """One run of the most frequent failure."""
    statuses = np.array([report.runs.status[run] for run in counted])
    kinds, numbers = np.unique(statuses, return_counts=True)
    for kind in kinds[np.argsort(-numbers, kind="stable")].tolist():
        if kind == RunStatus.SUCCEEDED or kind in LEFT_OUT:
            continue
        for run in islice(_recorded(report, counted[statuses == kind]), 1):
            reason = shorten(report.runs.message[run], REASON, placeholder="…")
            words = ": ".join(filter(None, (kind.replace("_", " "), reason)))
            yield Example(run=run, label="failed", text=f"{_name(part, run)}, {_seed(report, run)}: {words}")
            return


def _contrast(report: Report, part: SettingAnswer, ranking: Ranking) -> Contrast | None:
    """The scenario that took another configuration the most time more than the first one, if that is noticeable."""
    values, units = report.runs.values[ranking.column.name], part.setting.units
    placed = [(place.name, *_by_unit(part, place.style, values, units)) for place in ranking.places if place.estimate]
    if not placed:
        return None
    first, *others = placed
    pairs = []
    for name, units_of_other, runs in others:
        _, here, there = np.intersect1d(first[1], units_of_other, assume_unique=True, return_indices=True)
        pairs += [(values[b] - values[a], a, b, name) for a, b in zip(first[2][here], runs[there], strict=True)]
    pairs.sort(key=lambda pair: -pair[0])
    for step, one, other, name in pairs[:TRIED]:
        if step > 0 and step >= (ranking.column.threshold or 0) and len(list(_recorded(report, [one, other]))) == 2:
            more = change(ranking, IntervalEstimate(float(step), np.nan, np.nan, 1))
            text = f"{name} took {more} than {first[0]} in the same scenario ({_seed(report, other)})"
            return Contrast(first=int(one), second=int(other), text=text)
    return None


def _by_unit(part: SettingAnswer, group: int, values: Float, units: Int) -> tuple[Int, Int]:
    """Units of a group with a value, and the first run of each."""
    counted = part.setting.groups[group].counted
    having = counted[np.isfinite(values[counted])]
    distinct, at = np.unique(units[having], return_index=True)
    return distinct, having[at]


def _recorded(report: Report, runs: Iterable[int]) -> Iterator[int]:
    """The runs of the first few that have a recording."""
    for run in islice(runs, TRIED):
        results = report.folders[int(report.runs.folder[run])]
        if results.paths(report.runs.run_id[run]).recording.is_file():
            yield int(run)


def _name(part: SettingAnswer, run: int) -> str:
    setting = part.setting
    return next(name for name, group in zip(setting.names, setting.groups, strict=True) if run in group.members)


def _seed(report: Report, run: int) -> str:
    repeat = f", repeat {report.runs.repeat[run]}" if report.runs.repeat[run] else ""
    return f"seed {report.runs.seed[run]}{repeat}"
