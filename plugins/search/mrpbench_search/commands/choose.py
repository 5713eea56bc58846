"""`mrpbench choose STUDY [key=value…]`: let the candidates of a study race on paired seeds."""

import argparse
from collections.abc import Sequence
from pathlib import Path

import attrs

from mrpbench_core.api.metric import Column
from mrpbench_core.cli.input.arguments import split_names
from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.engine.loading.runs import StudyRuns
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.report.reading.columns import describe_columns, direction
from mrpbench_search.asking.arguments import add_search, searching, study_of
from mrpbench_search.asking.requests import read_whole_study
from mrpbench_search.choosing.answer import results_of, sentence, table, trend
from mrpbench_search.choosing.candidates import CHOICES, find_candidates
from mrpbench_search.choosing.search import Rules, SettingRace, run_races, start_races

DEFAULT_METRICS = ("tasks.per_hour", "execution.duration_s", "planning.sum_of_costs")
"""The metric of a race is the first of these that the study measures and that its runs can have."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "Candidates are dropped when they are shown to fail more often than another one or to be worse in the metric."
        " The race ends when every other candidate is dropped or as good as the leader, or when all seeds of the study"
        " are used. Exit code: 0 everything is decided, 1 something is not, 2 the configuration is wrong, 130"
        " interrupted (the same command continues)."
    )
    add_search(parser, "results/NAME, as of `mrpbench run`")
    parser.add_argument("--metric", metavar="X", help="column that decides after success (default: of the study)")
    parser.add_argument(
        "--candidates", metavar="X,Y", help=f"options in which candidates differ (default: {','.join(CHOICES)})"
    )
    parser.add_argument(
        "--margin",
        type=float,
        default=0.02,
        metavar="X",
        help="share of the metric within which candidates are as good (default: %(default)s)",
    )
    parser.add_argument(
        "--error",
        type=float,
        default=0.05,
        metavar="X",
        help="probability that a best candidate is dropped, over all looks and candidates (default: %(default)s)",
    )


def run(arguments: argparse.Namespace) -> int:
    """Run the races and print the answer."""
    file, overrides = study_of(arguments)
    for name, value in (("--margin", arguments.margin), ("--error", arguments.error)):
        if not 0 < value < 1:
            raise InputError(f"{name} {value:g}: between 0 and 1")
    with slots_of_this_process():
        study = read_whole_study(file, overrides)
        rules = Rules(column=_column(study, arguments.metric), level=arguments.error, margin=arguments.margin)
        races = start_races(find_candidates(study, split_names(arguments.candidates) or CHOICES), rules)
        out = Path(arguments.out or f"results/{study.name}")
        with searching(arguments, out, overrides) as requests:
            end = run_races(races, study, requests, rules, print)
    _print(study, races, rules, len(requests.asked), end, out, arguments.json)
    return int(end is not None or any(each.race.open for each in races))


def _column(study: StudyRuns, name: str | None) -> Column:
    known = describe_columns(study.columns)
    plans_only = all(point.canonical["simulator"] in (None, "none") for point in study.runs)
    if name is None:
        possible = DEFAULT_METRICS[-1:] if plans_only else DEFAULT_METRICS
        name = next((column for column in possible if column in study.columns), None)
        if name is None:
            raise InputError(
                f"--metric: the study measures none of {', '.join(possible)}", hint="name a column of its metrics"
            )
    if name not in known:
        raise InputError(f"--metric {name}: the study has no such column", hint=did_you_mean(name, list(known)))
    if not direction(known[name]):
        raise InputError(f"--metric {name}: neither more nor less of it is better")
    return known[name]


def _print(
    study: StudyRuns, races: Sequence[SettingRace], rules: Rules, runs: int, end: str | None, out: Path, as_json: bool
) -> None:
    """Print one sentence and one table for each setting."""
    results = [results_of(each, rules.column) for each in races]
    if as_json:
        print_json(
            {
                "metric": rules.column.name,
                "margin": rules.margin,
                "error": rules.level,
                "settings": [
                    {
                        "setting": each.setting.name,
                        "answer": sentence(rows, rules),
                        "looks": each.race.looks.seeds,
                        "candidates": [attrs.asdict(row) for row in rows],
                    }
                    for each, rows in zip(races, results, strict=True)
                ],
                "trend": trend(races),
                "runs": runs,
                "runs_of_study": len(study.runs),
                "ended": end,
                "out": str(out),
            }
        )
        return
    for each, rows in zip(races, results, strict=True):
        print()
        print_table(*table(rows, rules.column), f"{each.setting.name or study.name}: {sentence(rows, rules)}")
    for said in trend(races):
        print(said)
    print(
        f"\n{runs} of the {len(study.runs)} runs of the study, in {out}. At most {rules.level:.0%} of such races drop a"
        " candidate that no other one beats,\nand as many call two candidates as good that differ by more."
    )
    if end:
        print(f"the search ended before: {end}")
