"""`mrpbench choose STUDY [key=value…]`: let the candidates of a study race on paired seeds."""

import argparse
from collections.abc import Sequence
from pathlib import Path

import attrs

from mrpbench_core.cli.input.arguments import split_names
from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.engine.loading.runs import StudyRuns
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError
from mrpbench_search.asking.arguments import add_search, searching, study_of
from mrpbench_search.asking.requests import read_whole_study
from mrpbench_search.choosing.answer import results_of, sentence, table, trend
from mrpbench_search.choosing.candidates import CHOICES, find_candidates
from mrpbench_search.choosing.metrics import metric_of
from mrpbench_search.choosing.search import Rules, SettingRace, run_races, start_races


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
        rules = Rules(column=metric_of(study, arguments.metric), level=arguments.error, margin=arguments.margin)
        races = start_races(find_candidates(study, split_names(arguments.candidates) or CHOICES), rules)
        out = Path(arguments.out or f"results/{study.name}")
        with searching(arguments, out, overrides) as requests:
            end = run_races(races, study, requests, rules, print)
    _print(study, races, rules, len(requests.asked), end, out, arguments.json)
    return int(end is not None or any(each.race.open for each in races))


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
