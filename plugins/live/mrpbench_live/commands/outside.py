"""One run of a study with an outside party: its arguments, the run, and what it prints."""

import argparse
import signal
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from mrpbench_core.cli.input.arguments import add_configuration, split_words
from mrpbench_core.cli.output.progress import Printed
from mrpbench_core.cli.output.summary import print_summary
from mrpbench_core.engine.loading.runs import StudyRun, StudyRuns
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.engine.study.options import StudyOptions
from mrpbench_core.engine.study.reading import read_study
from mrpbench_core.engine.study.study import run_study
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_core.store.results import Results

EXIT_CODES = (
    " Exit code: 0 the run has a definite status, 1 it crashed, 2 the configuration is wrong or the broker cannot be"
    " reached, 130 interrupted."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of all commands that do such a run."""
    add_configuration(parser)
    parser.add_argument("--pace", type=float, default=1.0, metavar="X", help="times real time (default: 1)")
    parser.add_argument("--vda5050", metavar="URL", required=True, help="broker, e.g. mqtt://127.0.0.1:1883")
    parser.add_argument("--version", choices=("2.1", "3.0"), default="3.0", help="of VDA 5050 (default: 3.0)")
    parser.add_argument("--duration", metavar="TIME", help="simulated time of the run, e.g. '10 min'")
    parser.add_argument("--out", metavar="DIR", help="results folder (default: results/NAME)")


def run_one(
    arguments: argparse.Namespace, components: Sequence[str], more: Callable[[StudyRun], str] | None = None
) -> tuple[int, Results | None]:
    """Do the only run of a configuration, and print its summary; return the exit code and its results.

    Args:
        arguments: those of `add_arguments`.
        components: overrides that bring the outside party into the run; they come after those of the command line.
        more: gives a further override for the run that these describe.

    Raises:
        InputError: the configuration is wrong, or describes several runs.
    """
    files, overrides = split_words(arguments.words)
    if len(files) > 1:
        raise InputError(f"one configuration is run at a time, got {' and '.join(files)}")
    limit = [f"limits.execution={arguments.duration}"] if arguments.duration else []
    with slots_of_this_process() as slots:
        if more is not None:
            components = [*components, more(_only_run(read_study(files[0], [*overrides, *components]), files[0]))]
        study = read_study(files[0], [*overrides, *components, *limit])
        _only_run(study, files[0])
        signal.signal(signal.SIGTERM, signal.default_int_handler)
        options = StudyOptions(out=arguments.out, rerun="all", progress=_Told())
        try:
            done = run_study(study, options, slots)
        except KeyboardInterrupt:
            sys.stderr.write("interrupted: nothing was recorded\n")
            return 130, None
    for mistake in done.mistakes.values():
        sys.stderr.write(f"{mistake}\n")
    if done.mistakes:
        return 2, None
    print_summary(done.results)
    print(f"results in {options.folder_of(study.name)}")
    return int(RunStatus.CRASHED in done.results.statuses()), done.results


def _only_run(study: StudyRuns, file: str) -> StudyRun:
    """Return the run of a study that describes one.

    Raises:
        InputError: it is wrong, or describes several.
    """
    if study.errors:
        raise InputErrors(*study.errors)
    if len(study.runs) != 1:
        axes = ", ".join(study.runs[0].axes) if study.runs else "no axis"
        raise InputError(
            f"{file} describes {len(study.runs)} runs (by {axes}), and one can meet an outside party",
            hint="choose it by overrides, e.g. seed=0",
        )
    return study.runs[0]


class _Told(Printed):
    """Prints, besides progress, what the run says while it goes on, such as that it is behind the clock."""

    def __init__(self) -> None:
        super().__init__(live=False)
        self.interval_s = 0.5
        self._log: Path | None = None
        self._read = 0

    def started(self, point: StudyRun) -> None:
        """Follow the log of the run."""
        super().started(point)
        assert self._folder is not None
        self._log, self._read = self._folder.log(point.run_id), 0

    def going(self, progress: list[dict[str, Any]]) -> None:  # noqa: ARG002
        """Print what is new in the log."""
        if self._log is not None and self._log.exists():
            text = self._log.read_bytes()[self._read :]
            self._read += len(text)
            sys.stderr.write(text.decode(errors="replace"))
            sys.stderr.flush()

    def finished(self, point: StudyRun, record: dict[str, Any]) -> None:
        """Print the rest of the log, and how the run ended."""
        self.going([])
        super().finished(point, record)
