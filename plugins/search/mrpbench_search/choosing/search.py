"""Lets the candidates of all settings race, look by look."""

from collections.abc import Callable

import attrs

from mrpbench_core.api.metric import Column
from mrpbench_core.engine.loading.runs import StudyRuns
from mrpbench_core.files.errors import InputError
from mrpbench_core.report.reading.runs import read_runs
from mrpbench_search.asking.requests import Requests, SearchEnded
from mrpbench_search.choosing.candidates import Setting
from mrpbench_search.choosing.looks import plan_looks
from mrpbench_search.choosing.outcomes import outcomes
from mrpbench_search.choosing.race import Outcomes, Race


@attrs.define(kw_only=True)
class SettingRace:
    """The race of one setting and what its runs show."""

    setting: Setting
    race: Race
    outcomes: Outcomes | None = None
    """Outcomes at the last look."""


@attrs.frozen(kw_only=True)
class Rules:
    """What a race is about."""

    column: Column
    level: float
    """Probability that a race drops a best candidate; and, apart from that, that it calls two candidates as good."""
    margin: float
    """Share of the metric within which two candidates are as good."""


def start_races(settings: list[Setting], rules: Rules) -> list[SettingRace]:
    """Plan the races.

    Raises:
        InputError: the study has too few seeds to decide anything.
    """
    races = []
    for setting in settings:
        count, candidates = len(setting.seeds), len(setting.names)
        looks = plan_looks(count, candidates, rules.level)
        if not looks.seeds:
            least = next(n for n in range(count, 10**6) if plan_looks(n, candidates, rules.level).seeds)
            raise InputError(
                f"seed: {count} seeds cannot decide between {candidates} candidates with an error of {rules.level:.0%}",
                hint=f"at least {least}, better three times as many, e.g. seed=0..{3 * least - 1}",
            )
        race = Race(candidates=candidates, looks=looks, margin=rules.margin)
        races.append(SettingRace(setting=setting, race=race))
    return races


def run_races(
    races: list[SettingRace], study: StudyRuns, requests: Requests, rules: Rules, announce: Callable[[str], object]
) -> str | None:
    """Run the races to their ends; return why the search ended before, if it did.

    Args:
        races: of `start_races`.
        study: whose runs they are.
        requests: does the runs.
        rules: of the races.
        announce: is called with a line about each look before its runs are done.
    """
    while going := [each for each in races if each.race.wanted[0]]:
        for each in going:
            running, seeds = each.race.wanted
            names = ", ".join(each.setting.names[one] for one in running)
            announce(f"{each.setting.name or study.name}: {names} at {seeds} seeds")
        points = [
            point
            for each in going
            for one in range(each.race.candidates)
            for point in each.setting.runs(one, _seeds(each.race, one))
        ]
        try:
            results = requests.results(study, points)
        except SearchEnded as end:
            return str(end)
        runs = read_runs([results])
        for each in going:
            each.outcomes = outcomes(each.setting, runs, rules.column, each.race.wanted[1])
            each.race.judge(each.outcomes)
    return None


def _seeds(race: Race, candidate: int) -> int:
    """The seeds of a candidate at the next look: those that it had, if it does not run on."""
    running, seeds = race.wanted
    return seeds if candidate in running else race.seeds.get(candidate, 0)
