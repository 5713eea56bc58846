"""`mrpbench run CONFIG… [key=value…]`: do the runs of studies."""

import argparse
import signal
import sys
from collections import Counter
from collections.abc import Sequence
from contextlib import nullcontext, redirect_stdout
from pathlib import Path
from typing import Any

from mrpbench_core.cli.input.arguments import add_configuration, add_executor, read_options, split_words
from mrpbench_core.cli.output.progress import SHORT, Printed
from mrpbench_core.cli.output.summary import plugins_line, print_summary
from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.engine.loading.runs import StudyRuns
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.engine.study.options import StudyOptions
from mrpbench_core.engine.study.reading import read_studies
from mrpbench_core.engine.study.study import choose, run_study
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
    add_executor(parser)
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
    options = StudyOptions(
        overrides=overrides,
        out=arguments.out,
        workers=arguments.workers,
        executor={"plugin": arguments.executor} | read_options(arguments.executor_option, "--executor-option"),
        shard=arguments.shard,
        rerun=arguments.rerun,
        progress=Printed(),
    )
    with slots_of_this_process() as slots:
        studies = read_studies(files, overrides)
        for error in (error for study in studies for error in study.errors):
            sys.stderr.write(f"{error}\n")
        for note in dict.fromkeys(note for study in studies for note in study.notes):
            sys.stderr.write(f"note: {note}\n")
        if arguments.dry_run:
            _list(studies, options, arguments.json)
            return int(any(study.errors for study in studies))
        with redirect_stdout(sys.stderr) if arguments.json else nullcontext():
            print(plugins_line(studies), flush=True)
            signal.signal(signal.SIGTERM, signal.default_int_handler)  # batch systems end jobs with SIGTERM
            done = [_run_one(study, options, slots) for study in studies]
    if arguments.json:
        print_json(
            [
                {"out": str(options.folder_of(study.name)), "runs": len(results), "statuses": results.statuses()}
                for study, (_, results) in zip(studies, done, strict=True)
            ]
        )
    return max(code for code, _ in done)


def _run_one(study: StudyRuns, options: StudyOptions, slots: str) -> tuple[int, Results]:
    """Do the runs of one study; return the exit code and the results."""
    folder = options.folder_of(study.name)
    try:
        done = run_study(study, options, slots)
    except KeyboardInterrupt:
        sys.stderr.write(f"interrupted; finished runs are in {folder}, and the same command continues\n")
        raise SystemExit(130) from None
    for mistake, runs in Counter(line for text in done.mistakes.values() for line in text.splitlines()).items():
        sys.stderr.write(f"{mistake}\n" if runs == 1 else f"{mistake} ({runs} runs)\n")
    if done.mistakes and not len(done.results):
        return 2, done.results
    _summarize(done.results, folder)
    return int(RunStatus.CRASHED in done.results.statuses() or bool(done.mistakes or study.errors)), done.results


def _list(studies: Sequence[StudyRuns], options: StudyOptions, as_json: bool) -> None:
    entries: list[dict[str, Any]] = []
    for study in studies:
        out = str(options.folder_of(study.name))
        selection, _ = choose(study, options)
        entries += [
            {"run_id": point.run_id, "attempt": attempt, "out": out, "axes": point.axes, "config": point.canonical}
            for point, attempt in selection.todo
        ]
    if as_json:
        print_json(entries)
        return
    axes = list(dict.fromkeys(key for entry in entries for key in entry["axes"]))
    rows = [
        [entry["run_id"][:SHORT], entry["attempt"], *(word(entry["axes"].get(key, "–")) for key in axes)]
        for entry in entries
    ]
    print_table(
        ["run", "attempt", *axes],
        rows,
        f"{len(rows)} of {counted(sum(len(study.runs) for study in studies), 'run')} to do",
    )


def _summarize(results: Results, folder: Path) -> None:
    statuses = print_summary(results, limit=GROUPS_SHOWN).most_common()
    counts = ", ".join(f"{count} {status}" for status, count in statuses)
    print(f"{counted(len(results), 'run')}: {counts}; results in {folder}")
    print(f"for intervals, comparisons and an HTML page: `mrpbench report {folder}`")
    if results.statuses().get(RunStatus.CRASHED):
        print(f"{folder}/logs shows why runs crashed; `--rerun failed` repeats them")
