"""The arguments of commands that search, and what all of them do before and after."""

import argparse
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from pathlib import Path

from mrpbench_core.cli.input.arguments import add_configuration, add_executor, read_options, split_words
from mrpbench_core.cli.output.progress import Printed
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.engine.study.options import StudyOptions
from mrpbench_core.files.errors import InputError
from mrpbench_search.asking.budget import read_budget
from mrpbench_search.asking.requests import Requests


def add_search(parser: argparse.ArgumentParser, folder: str, budget: str | None = None) -> None:
    """Declare a study and how its runs are done.

    Args:
        parser: of the command.
        folder: the default of `--out`, for the help.
        budget: the default of `--budget`; None: no limit.
    """
    add_configuration(parser)
    add_execution(parser, folder, budget)


def add_execution(parser: argparse.ArgumentParser, folder: str, budget: str | None = None) -> None:
    """Declare how runs are done; see `add_search`."""
    parser.add_argument("--out", metavar="DIR", help=f"results folder (default: {folder})")
    add_executor(parser)
    parser.add_argument(
        "--shard", metavar="i/n", help="do only part i of n of each step, counted from 0; give each part its own --out"
    )
    parser.add_argument(
        "--budget",
        default=budget,
        metavar="X",
        help="end the search before a step that exceeds it: `10min` of wall time, or `300runs`"
        f" (default: {budget or 'no limit'})",
    )
    parser.add_argument("--json", action="store_true", help="print the answer as JSON; progress goes to stderr")


def study_of(arguments: argparse.Namespace) -> tuple[str, list[str]]:
    """Return the file of the one study and its overrides.

    Raises:
        InputError: there are several files, or none.
    """
    files, overrides = split_words(arguments.words)
    if len(files) > 1:
        raise InputError(f"{files[1]}: give one study at a time")
    return files[0], overrides


@contextmanager
def searching(arguments: argparse.Namespace, out: Path, overrides: list[str]) -> Iterator[Requests]:
    """Open the requests of a search. Progress is printed, with `--json` to stderr; an interruption says what is next.

    Args:
        arguments: of `add_execution`.
        out: results folder.
        overrides: of the study, for the record of the invocation.
    """
    options = StudyOptions(
        overrides=overrides,
        out=out,
        workers=arguments.workers,
        executor={"plugin": arguments.executor} | read_options(arguments.executor_option, "--executor-option"),
        shard=arguments.shard,
        progress=Printed(),
    )
    budget = read_budget(arguments.budget)
    with slots_of_this_process() as slots, redirect_stdout(sys.stderr if arguments.json else sys.stdout):
        signal.signal(signal.SIGTERM, signal.default_int_handler)  # batch systems end jobs with SIGTERM
        try:
            yield Requests(options=options, slots=slots, budget=budget)
        except KeyboardInterrupt:
            sys.stderr.write(f"interrupted; finished runs are in {out}, and the same command continues\n")
            raise SystemExit(130) from None
