"""`mrpbench hunt STUDY --for FAILURE [key=value…]`: search for runs that fail, and shrink them."""

import argparse
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.engine.loading.runs import StudyRuns
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import counted
from mrpbench_core.report.reading.columns import describe_columns
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.results import load
from mrpbench_search.asking.arguments import add_search, searching, study_of
from mrpbench_search.asking.configurations import by_configuration
from mrpbench_search.asking.requests import read_whole_study
from mrpbench_search.choosing.metrics import metric_of
from mrpbench_search.hunting.answer import document, sentence, table, write_failure
from mrpbench_search.hunting.moves import Moves
from mrpbench_search.hunting.properties import ANY, COMPARES, KINDS, LESS, Property, read_property
from mrpbench_search.hunting.runs import CaseRuns
from mrpbench_search.hunting.search import Hunt
from mrpbench_search.hunting.space import first_case, read_space

BUDGET = "10min"
_NO_WORD = re.compile(r"[^\w.]+")


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "Varied are starts, goals, order and times of tasks, the entries of `faults.events` and the people who are"
        " `given` in `crowds`. Exit code: 0 nothing was found, 1 failures were found, 2 the configuration is wrong, 130"
        " interrupted (the same command continues)."
    )
    add_search(parser, "results/NAME-hunt", BUDGET)
    parser.add_argument(
        "--for",
        dest="wanted",
        default=ANY,
        metavar="FAILURE",
        help=f"{', '.join(KINDS)}, a bound such as `execution.duration_s > 60`, or `B worse than A by 20 %%`"
        f" (default: any of the first but {' and '.join(LESS)})",
    )
    parser.add_argument("--metric", metavar="X", help="column by which two candidates are compared")
    parser.add_argument("--most", type=int, metavar="N", help="end after so many different failures")
    parser.add_argument("--seed", type=int, default=0, help="of the search (default: %(default)s)")


def run(arguments: argparse.Namespace) -> int:
    """Hunt, and print what was found."""
    file, overrides = study_of(arguments)
    if arguments.most is not None and arguments.most < 1:
        raise InputError(f"--most {arguments.most}: at least 1")
    with slots_of_this_process():
        study = read_whole_study(file, overrides)
        candidates = {name: points[0] for name, points in by_configuration(study).items()}
        tried = _property(study, arguments, list(candidates))
        points = list(candidates.values())
        space = read_space(points[0], min(point.canonical["seed"] for point in study.runs))
        out = Path(arguments.out or f"results/{study.name}-hunt")
        ResultsFolder(out).create()
        with searching(arguments, out, overrides) as requests:
            runs = CaseRuns(study=study, candidates=points, tried=tried, requests=requests, folder=out / "cases")
            moves = Moves(space=space, first=first_case(points[0], space), rng=np.random.default_rng(arguments.seed))
            hunt = Hunt(moves=moves, runs=runs, announce=print)
            end = hunt.run(arguments.most)
            files = [
                write_failure(out / "failures" / f"{number}-{_NO_WORD.sub('-', each.kind).strip('-')}", each, runs)
                for number, each in enumerate(hunt.failures.values(), start=1)
            ]
    if arguments.json:
        print_json(document(study.name, hunt, files, len(requests.asked), end, out))
    else:
        _print(study.name, hunt, files, len(requests.asked), end, out)
    return int(bool(hunt.failures))


def _property(study: StudyRuns, arguments: argparse.Namespace, candidates: list[str]) -> Property:
    column = metric_of(study, arguments.metric) if COMPARES in arguments.wanted else None
    return read_property(arguments.wanted, candidates, describe_columns(study.columns), column)


def _print(name: str, hunt: Hunt, files: Sequence[dict[str, str]], runs: int, end: str, out: Path) -> None:
    failures = list(hunt.failures.values())
    print(f"\n{sentence(name, hunt)}")
    if failures:
        print_table(*table(failures))
    for number, (failure, written) in enumerate(zip(failures, files, strict=True), start=1):
        print(f"{number}: {failure.reason}")
        if not failure.is_smallest:
            print("   shrinking has not ended: the same command with a higher --budget continues")
        print(f"   {', '.join(written.values())}")
    if hunt.left_out:
        refused = (load(out)[hunt.left_out[0]].get("error") or {}).get("message", "skipped")
        print(f"{counted(len(hunt.left_out), 'further case')} left out, e.g. run {hunt.left_out[0][:12]}: {refused}")
    for kind, run_id in hunt.others.items():
        print(f"also seen, but not searched for: {kind}, e.g. run {run_id[:12]}")
    print(f"{counted(runs, 'run')} in {out}; the search ended: {end}")
