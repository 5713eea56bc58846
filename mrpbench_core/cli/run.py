"""`mrpbench run CONFIG… [key=value…]`: do the runs of studies."""

import argparse
import signal
import sys
from collections import Counter
from collections.abc import Sequence
from contextlib import closing, redirect_stdout
from typing import Any

from mrpbench_core.cli.input.arguments import add_configuration, read_options, split_words
from mrpbench_core.cli.output.progress import SHORT, Printed
from mrpbench_core.cli.output.summary import plugins_line, print_summary
from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.engine.loading.runs import StudyRuns
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.engine.study.invoke import prepare
from mrpbench_core.engine.study.reading import read_studies
from mrpbench_core.engine.study.study import Request, StudyOutcome, choose, run_study
from mrpbench_core.files.text import counted
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_core.report.reading.axes import word
from mrpbench_core.store.results import Results

GROUPS_SHOWN = 20
"""Rows of the summary."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "Runs that have a record are not repeated. Exit code: 0 every run has a definite status, 1 some runs crashed or"
        " could not be done, 2 the configuration is wrong, 130 interrupted (the same command continues)."
    )
    add_configuration(parser)
    parser.add_argument(
        "--out", metavar="DIR", help="results folder (default: results/NAME, with the name of the study)"
    )
    parser.add_argument("--workers", type=int, default=1, metavar="N", help="number of runs at a time (default: 1)")
    parser.add_argument(
        "--executor", default="processes", metavar="NAME", help="executor of the runs (default: %(default)s)"
    )
    parser.add_argument("--executor-option", action="append", default=[], metavar="K=V", help="option of the executor")
    parser.add_argument(
        "--shard", metavar="i/n", help="do only part i of n, counted from 0; give each part its own --out"
    )
    parser.add_argument(
        "--rerun",
        choices=("failed", "changed", "all"),
        help="also repeat runs: `failed` = crashed, out of memory or wall time, or broken contract; `changed` = made"
        " with other versions or sources; `all`",
    )
    parser.add_argument("--dry-run", action="store_true", help="list the runs without doing them")
    parser.add_argument(
        "--json",
        action="store_true",
        help="print the outcome (with --dry-run, the list) as JSON; everything else goes to stderr",
    )


def run(arguments: argparse.Namespace) -> int:
    """Do the runs."""
    files, overrides = split_words(arguments.words)
    options = read_options(arguments.executor_option, "--executor-option")
    with slots_of_this_process() as slots:
        if not arguments.json or arguments.dry_run:
            return _work(slots, arguments, files, overrides, options)[0]
        with redirect_stdout(sys.stderr):
            code, done = _work(slots, arguments, files, overrides, options)
    print_json([_outcome(request, results) for request, results in done])
    return code


def _work(
    slots: str, arguments: argparse.Namespace, files: Sequence[str], overrides: Sequence[str], options: dict[str, Any]
) -> tuple[int, list[tuple[Request, Results]]]:
    """Do the runs, or list them; return the exit code and the results of each finished study."""
    studies = read_studies(slots, files, overrides)
    progress = Printed()
    requests = [
        prepare(
            study.name,
            slots,
            overrides,
            out=arguments.out,
            workers=arguments.workers,
            executor=arguments.executor,
            executor_options=options,
            shard=arguments.shard,
            rerun=arguments.rerun,
            progress=progress,
        )
        for study in studies
    ]
    for error in (error for study in studies for error in study.errors):
        sys.stderr.write(f"{error}\n")
    if arguments.dry_run:
        _list(studies, requests, arguments.json)
        return int(any(study.errors for study in studies)), []
    print(plugins_line(studies), flush=True)
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # batch systems end jobs with SIGTERM
    ended = [_run_one(study, request, progress) for study, request in zip(studies, requests, strict=True)]
    done = [(request, results) for request, (_, results) in zip(requests, ended, strict=True)]
    return max(code for code, _ in ended), done


def _outcome(request: Request, results: Results) -> dict[str, Any]:
    return {"out": str(request.out), "runs": len(results), "statuses": results.statuses()}


def _run_one(study: StudyRuns, request: Request, progress: Printed) -> tuple[int, Results]:
    try:
        with closing(progress):
            done = run_study(study, request)
    except KeyboardInterrupt:
        sys.stderr.write(f"interrupted; finished runs are in {request.out}, and the same command continues\n")
        raise SystemExit(130) from None
    for mistake, runs in Counter(line for text in done.mistakes.values() for line in text.splitlines()).items():
        sys.stderr.write(f"{mistake}\n" if runs == 1 else f"{mistake} ({runs} runs)\n")
    if done.mistakes and not len(done.results):
        return 2, done.results
    _summarize(done, request)
    return int(RunStatus.CRASHED in done.results.statuses() or bool(done.mistakes or study.errors)), done.results


def _list(studies: Sequence[StudyRuns], requests: Sequence[Request], as_json: bool) -> None:
    found: list[dict[str, Any]] = []
    for study, request in zip(studies, requests, strict=True):
        selection, _ = choose(study, request)
        found += [
            {"run_id": point.run_id, "attempt": attempt, "out": str(request.out), "axes": point.axes}
            | {"config": point.canonical}
            for point, attempt in selection.todo
        ]
    if as_json:
        print_json(found)
        return
    axes = list(dict.fromkeys(key for entry in found for key in entry["axes"]))
    rows = [
        [entry["run_id"][:SHORT], entry["attempt"], *(word(entry["axes"].get(key, "–")) for key in axes)]
        for entry in found
    ]
    print_table(
        ["run", "attempt", *axes],
        rows,
        f"{len(rows)} of {counted(sum(len(study.runs) for study in studies), 'run')} to do",
    )


def _summarize(done: StudyOutcome, request: Request) -> None:
    results = done.results
    print_summary(results, limit=GROUPS_SHOWN)
    statuses = sorted(results.statuses().items(), key=lambda item: -item[1])
    counts = ", ".join(f"{count} {status}" for status, count in statuses)
    print(f"{counted(len(results), 'run')}: {counts}; results in {request.out}")
    print(f"for intervals, comparisons and an HTML page: `mrpbench report {request.out}`")
    if results.statuses().get(RunStatus.CRASHED):
        print(f"{request.out}/logs shows why runs crashed; `--rerun failed` repeats them")
