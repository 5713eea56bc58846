"""The answer of a race in one sentence and a table."""

from collections.abc import Sequence
from typing import Any

import attrs
import numpy as np

from mrpbench_core.api.metric import Column
from mrpbench_core.files.text import counted
from mrpbench_core.report.answer.wording import listed
from mrpbench_core.report.reading.columns import direction, heading
from mrpbench_search.choosing.race import Outcomes, Race, Standing
from mrpbench_search.choosing.search import Rules, SettingRace


@attrs.frozen(kw_only=True)
class CandidateResult:
    """What a race shows of one candidate."""

    candidate: str
    standing: Standing
    seeds: int
    """Number of seeds that it took."""
    failed: int
    """Number of these seeds at which a run failed."""
    mean: float | None
    """Of the metric, over the seeds at which all runs of the candidate succeeded."""
    change: float | None
    """Its mean minus that of the best one as a share of the latter, over the seeds that both have."""


def results_of(each: SettingRace, column: Column) -> list[CandidateResult]:
    """Return the results of the candidates of a setting: the best first, then as good, not decided, and the losers."""
    outcomes, race = each.outcomes, each.race
    if outcomes is None:
        names = each.setting.names
        open_ = {"standing": Standing.OPEN, "seeds": 0, "failed": 0, "mean": None, "change": None}
        return [CandidateResult(candidate=name, **open_) for name in names]  # type: ignore[arg-type]
    rows = [_result(one, each.setting.names[one], race, outcomes, column) for one in range(race.candidates)]
    order = (Standing.BEST, Standing.AS_GOOD, Standing.OPEN, Standing.WORSE, Standing.FAILS, Standing.NOT_JUDGED)
    return sorted(rows, key=lambda row: (order.index(row.standing), abs(row.change or 0.0)))


def sentence(rows: Sequence[CandidateResult], rules: Rules) -> str:
    """Say which candidate is best, which are as good, which lose by what, and what is not decided."""
    by = {standing: [row for row in rows if row.standing is standing] for standing in Standing}
    if not by[Standing.BEST]:
        return "nothing is decided" if by[Standing.OPEN] else "no candidate can be judged"
    best = by[Standing.BEST][0]
    parts = [f"{best.candidate} leads" if by[Standing.OPEN] else best.candidate]
    if good := [row.candidate for row in by[Standing.AS_GOOD]]:
        parts.append(f"{listed(good)} {'is' if len(good) == 1 else 'are'} as good within {100 * rules.margin:g} %")
    name = rules.column.name.rpartition(".")[2]
    if not_decided := by[Standing.OPEN]:
        names = listed([f"{row.candidate} ({_change(row, name)})" for row in not_decided])
        parts.append(f"not decided after {counted(best.seeds, 'seed')}: {names}")
    parts += [f"{row.candidate} has {_change(row, name)}" for row in by[Standing.WORSE]]
    parts += [f"{row.candidate} fails at {row.failed} of {counted(row.seeds, 'seed')}" for row in by[Standing.FAILS]]
    if best.failed:
        parts.append(f"{best.candidate} itself fails at {best.failed} of {counted(best.seeds, 'seed')}")
    if left_out := [row.candidate for row in by[Standing.NOT_JUDGED]]:
        parts.append(f"no run judges {listed(left_out)}")
    return "; ".join(parts)


def trend(races: Sequence[SettingRace]) -> list[str]:
    """Say from which value of the one numeric option of the settings on each candidate fails."""
    keys = {key for each in races for key in each.setting.axes}
    values = [next(iter(each.setting.axes.values()), None) for each in races]
    if len(keys) != 1 or len(races) < 2 or not all(type(value) in (int, float) for value in values):
        return []
    name = next(iter(keys)).rpartition(".")[2]
    order = np.argsort(np.array(values, float), kind="stable")
    ordered = [races[index] for index in order]
    said = []
    for candidate in ordered[0].setting.names:
        fails = [
            candidate in each.setting.names
            and each.race.standing(each.setting.names.index(candidate)) is Standing.FAILS
            for each in ordered
        ]
        first = fails.index(True) if True in fails else len(fails)
        if 0 < first < len(fails) and all(fails[first:]):
            said.append(f"{candidate} fails more often from {name}={values[order[first]]} on")
    return said


def table(rows: Sequence[CandidateResult], column: Column) -> tuple[list[str], list[list[Any]]]:
    """Return headings and cells."""
    cells = [
        [
            row.candidate,
            row.standing,
            row.seeds,
            row.failed,
            None if row.mean is None else f"{row.mean:.4g}",
            None if row.change is None else f"{100 * row.change:+.1f} %",
        ]
        for row in rows
    ]
    return ["candidate", "standing", "seeds", "failed", heading(column), "to the best"], cells


def _result(one: int, name: str, race: Race, outcomes: Outcomes, column: Column) -> CandidateResult:
    success, values = outcomes.success[one], outcomes.values[one] * -direction(column)
    known = values[np.isfinite(values)]
    change = None
    if race.leader is not None and race.leader != one:
        theirs, mine = outcomes.means([race.leader, one]) * -direction(column)
        change = float(mine / theirs - 1) if np.isfinite([mine, theirs]).all() and theirs else None
    return CandidateResult(
        candidate=name,
        standing=race.standing(one),
        seeds=race.seeds.get(one, 0),
        failed=int((success < 1).sum()),
        mean=float(known.mean()) if len(known) else None,
        change=change,
    )


def _change(row: CandidateResult, name: str) -> str:
    if row.change is None:
        return f"no seed with a {name} of both"
    return f"{abs(100 * row.change):.1f} % {'more' if row.change >= 0 else 'less'} {name}"
