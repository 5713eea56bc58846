"""Runs what a study still lacks, and keeps each record as soon as it is there."""

import os
import socket
from collections import Counter, deque
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import closing, contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.api.executor import ExecutorSource
from mrpbench_core.config.study import RunPoint, Study
from mrpbench_core.engine.job import Failure, Job, Outcome
from mrpbench_core.engine.machine import machine
from mrpbench_core.engine.record import code_of, complete
from mrpbench_core.engine.selection import Rerun, Selection, select
from mrpbench_core.engine.slots import close_slots, run_in_slot
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.jsonl import Writer
from mrpbench_core.plugins.hooks import Hooks, load_hooks
from mrpbench_core.store.folder import ResultsFolder, new_invocation
from mrpbench_core.store.invocation import write_document
from mrpbench_core.store.lock import locked
from mrpbench_core.store.results import Results, origin

LOSSES = 3
"""A run whose worker is ended from outside is done again, as the next attempt; after so many it counts as crashed."""


class Progress:
    """Told in the invoking process what happens; does nothing by default."""

    def selected(self, selection: Selection, results: Results) -> None:
        """The runs to do are known."""

    def started(self, point: RunPoint) -> None:
        """A run was handed to a worker."""

    def finished(self, record: dict[str, Any]) -> None:
        """A run's record was stored."""

    def lost(self, run_id: str, reason: str) -> None:
        """A run's worker was ended from outside; it will be done again."""

    def refused(self, run_id: str, mistake: str) -> None:
        """A run could not be made of what the user wrote; nothing was recorded."""


@attrs.frozen(kw_only=True)
class Request:
    """How a study is to be run."""

    out: Path
    executor: ExecutorSource
    workers: int = attrs.field(default=1, validator=attrs.validators.ge(1))
    shard: tuple[int, int] | None = None
    rerun: Rerun | None = None
    overrides: tuple[str, ...] = ()
    """What of the study came from the command line, to be written down."""
    progress: Progress = attrs.field(factory=Progress)


@attrs.frozen(kw_only=True)
class Done:
    """What came of it."""

    results: Results
    """Every record of the study's runs, new and old."""
    mistakes: dict[str, str]
    """What was wrong with each run that was refused, by run id."""


def choose(study: Study, request: Request) -> tuple[Selection, Results]:
    """Which runs would be done now; changes nothing on disk."""
    results = Results(ResultsFolder(request.out), only=(point.run_id for point in study.runs))
    codes: dict[int, str] = {}

    def origin_now(point: RunPoint) -> str:
        return codes.setdefault(id(point), origin(code_of(point)))

    return select(study.runs, results, request.rerun, request.shard, origin_now), results


def run_study(study: Study, request: Request) -> Done:
    """Do the runs that `choose` names.

    Raises:
        InputError: the results folder cannot be used.
        KeyboardInterrupt: after the runs in flight were ended; everything finished is kept.
    """
    folder = ResultsFolder(request.out)
    folder.create()
    with locked(folder.path):
        folder.sweep()
        selection, results = choose(study, request)
        request.progress.selected(selection, results)
        mistakes: dict[str, str] = {}
        if selection.todo:
            hooks = load_hooks()
            invocation = new_invocation()
            _describe(study, request, folder, invocation)
            hooks.call("mrpbench_study_started", study=study.document, runs=len(selection.todo))
            with closing(_open_shard(folder, invocation)) as shard:
                _run_all(selection, request, folder, invocation, shard, hooks, mistakes)
            hooks.call("mrpbench_study_finished", records=len(selection.todo) - len(mistakes))
        return Done(results=Results(folder, only=selection.chosen), mistakes=mistakes)


def _run_all(
    selection: Selection,
    request: Request,
    folder: ResultsFolder,
    invocation: str,
    shard: Writer,
    hooks: Hooks,
    mistakes: dict[str, str],
) -> None:
    """Keep `workers` runs going until all are done; no more are queued, so that memory does not grow with the study."""
    waiting = deque(selection.todo)
    losses: Counter[str] = Counter()
    going: dict[Future[Outcome], tuple[RunPoint, int]] = {}
    with _opened(request, invocation) as executor:
        while True:
            while waiting and len(going) < request.workers:
                point, attempt = waiting.popleft()
                hooks.switch_on()
                hooks.call("mrpbench_run_started", run_id=point.run_id, config=point.canonical)
                request.progress.started(point)
                going[executor.submit(run_in_slot, invocation, _job(point, folder))] = point, attempt
            if not going:
                return
            for future in wait(going, return_when=FIRST_COMPLETED).done:
                point, attempt = going.pop(future)
                outcome = future.result()
                if outcome.lost is not None:
                    losses[point.run_id] += 1
                    if losses[point.run_id] < LOSSES:
                        request.progress.lost(point.run_id, outcome.lost)
                        waiting.append((point, attempt + 1))
                        continue
                    outcome = _given_up(outcome, outcome.lost)
                if outcome.mistake is not None:
                    mistakes[point.run_id] = outcome.mistake
                    request.progress.refused(point.run_id, outcome.mistake)
                    continue
                record = complete(point, attempt, outcome, request.workers)
                try:
                    shard.write(record)
                except OSError as error:
                    raise InputError(f"cannot be written: {error.strerror}", file=shard.path) from error
                hooks.call("mrpbench_run_finished", record=record)
                request.progress.finished(record)


@contextmanager
def _opened(request: Request, invocation: str) -> Iterator[Executor]:
    """An executor whose runs are ended when anything, Ctrl-C included, ends the study."""
    executor = request.executor.open(request.workers)
    try:
        yield executor
    finally:
        close_slots(invocation)
        executor.shutdown(wait=True, cancel_futures=True)


def _job(point: RunPoint, folder: ResultsFolder) -> Job:
    return Job(
        run_id=point.run_id,
        parcel=point.parcel,
        paths=folder.run(point.run_id),
        log=folder.log(point.run_id),
        wall_s=point.config.limits.wall,
        memory_bytes=int(point.config.limits.memory),
    )


def _given_up(outcome: Outcome, reason: str) -> Outcome:
    """A run whose worker was ended time and again: perhaps by the run itself."""
    message = f"{reason} {LOSSES} times"
    return attrs.evolve(
        outcome, lost=None, failure=Failure(status="crashed", stage="start", message=message, seconds=0.0)
    )


def _open_shard(folder: ResultsFolder, invocation: str) -> Writer:
    try:
        return Writer(folder.shard(invocation), exclusive=True)
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", file=folder.shard(invocation)) from error


def _describe(study: Study, request: Request, folder: ResultsFolder, invocation: str) -> None:
    """Write what is needed to do this again."""
    points = {id(point.config.planner): point for point in study.runs}.values()
    codes = [code_of(point) for point in points]
    columns = {
        f"{name}.{column.name}": {"unit": column.unit, "better": column.better, "description": column.description}
        for point in points
        for name, metric in point.config.metrics.items()
        for column in metric.columns
    }
    facts = {
        "invocation": invocation,
        "started": datetime.now(UTC).isoformat(timespec="seconds"),
        "process": os.getpid(),
        "host": socket.gethostname(),
        "machine": machine(),
        "versions": {name: version for code in codes for name, version in code["versions"].items()},
        "columns": columns,
        "overrides": list(request.overrides),
        "study": study.document,
    }
    try:
        write_document(folder.invocation(invocation), facts)
        write_document(folder.study, study.document)
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", file=folder.path) from error
