"""The calls of runs by an executor, which may be a plugin that works in this process: its faults end the study by name.

Nothing that it says can be proved here. It is required to say something about the run that it was given.
"""

import logging
import re
import threading
from collections.abc import Iterator
from concurrent.futures import Executor, Future
from contextlib import contextmanager
from typing import Any, NoReturn

import attrs

from mrpbench_core.api.executor import ExecutorSource, RemoteExecutor, WorkerLost
from mrpbench_core.engine.processes.job import Failure, Job, JobOutcome
from mrpbench_core.engine.processes.slots import close_slots, run_in_slot
from mrpbench_core.engine.record import RunRecord
from mrpbench_core.files.errors import InputError, one_line
from mrpbench_core.plugins.contract import is_of
from mrpbench_core.plugins.provenance import title

LOG = logging.getLogger(__name__)
PATIENCE_S = 60.0
"""Seconds that a call of an executor may take before the user is told."""
_SUM = re.compile(r"[0-9a-f]{64}  (?P<name>[^/]+/(?P<run>[^/]+).*)")


@attrs.frozen(kw_only=True)
class Calls:
    """Calls by one executor.

    Every method raises an `InputError` of one line if the executor fails.
    """

    executor: Executor
    source: ExecutorSource
    """What opened it."""
    slots: str
    """Key of the worker slots, in each process that executes runs."""

    def submit(self, job: Job) -> Future[JobOutcome]:
        """Hand over a run."""
        with _named(self.source, "submit"):
            future = self.executor.submit(run_in_slot, self.slots, job)
        if not isinstance(future, Future):
            _refuse(self.source, f"returned {type(future).__name__} instead of a Future")
        return future

    def outcome(self, future: Future[JobOutcome], job: Job) -> JobOutcome:
        """The outcome of a call that is done.

        Raises:
            WorkerLost: the worker was lost.
        """
        with _named(self.source, "result"):
            outcome = future.result()
        try:
            fault = _fault(outcome, job)
        except (AttributeError, TypeError, ValueError) as error:
            fault = f"something that is not an outcome of a run: {one_line(error)}"
        if fault is not None:
            _refuse(self.source, f"returned for the run {job.run_id} {fault}")
        return outcome

    def end_slots(self) -> None:
        """End the worker slots in other processes."""
        if isinstance(self.executor, RemoteExecutor):
            with _named(self.source, "everywhere"):
                self.executor.everywhere(close_slots, self.slots)


@contextmanager
def opened(source: ExecutorSource, workers: int, slots: str) -> Iterator[Calls]:
    """Open an executor, and shut it down in the end."""
    before = threading.enumerate()
    with _named(source, "open"):
        executor = source.open(workers)
    if not isinstance(executor, Executor):
        _refuse(source, f"opened {type(executor).__name__} instead of a concurrent.futures.Executor")
    try:
        yield Calls(executor=executor, source=source, slots=slots)
    finally:
        with _named(source, "shutdown"):
            executor.shutdown(wait=True, cancel_futures=True)
        for thread in threading.enumerate():
            if thread not in before and not thread.daemon:
                LOG.warning("the %s left the thread %r, without whose end no command ends", title(source), thread.name)


@contextmanager
def _named(source: ExecutorSource, call: str) -> Iterator[None]:
    """Name the executor in errors that it raises, and say when a call of it takes long: nothing can end the call."""
    timer = None if is_of(type(source)) else threading.Timer(PATIENCE_S, _remind, (source, call))
    if timer is not None:
        timer.daemon = True
        timer.start()
    try:
        yield
    except (InputError, WorkerLost, KeyboardInterrupt):
        raise
    except BaseException as error:
        raise InputError(f"the {title(source)} raised {one_line(error)}") from error
    finally:
        if timer is not None:
            timer.cancel()


def _remind(source: ExecutorSource, call: str) -> None:
    LOG.warning("the %s has not returned from %s after %g s (Ctrl-C ends it)", title(source), call, PATIENCE_S)


def _refuse(source: ExecutorSource, what: str) -> NoReturn:
    raise InputError(f"the {title(source)} {what}")


def _fault(outcome: Any, job: Job) -> str | None:
    """Return what keeps something from being the outcome of a job, or None."""
    if not isinstance(outcome, JobOutcome):
        return f"{type(outcome).__name__} instead of its outcome"
    record, failure = outcome.record, outcome.failure
    mistake: Any = outcome.mistake
    machine: Any = outcome.machine
    if sum(part is not None for part in (record, failure, mistake)) != 1:
        return "neither a record nor a failure nor a mistake, or several of them"
    if not isinstance(mistake, str | None) or not isinstance(machine, dict | None):
        return "a mistake that is not text, or a machine that is not a mapping"
    if failure is not None:
        Failure.of_message(attrs.asdict(failure))
    if record is not None:
        RunRecord.of_message(record.message())
        record.timing.keys(), record.metrics.keys()
    for run_id in (outcome.run_id, outcome.run_id if record is None else record.run_id):
        if run_id != job.run_id:
            return f"the outcome of {run_id!r:.40}"
    return None if record is None else _file_fault(record, job)


def _file_fault(record: RunRecord, job: Job) -> str | None:
    """Return which file a record names that is not the run's, or is not there."""
    folders = {"recordings": job.paths.recording, "exports": job.paths.exports}
    for line in record.files:
        match = _SUM.fullmatch(line)
        part, _, rest = match["name"].partition("/") if match else ("", "", "")
        place = folders.get(part)
        if place is None or ".." in rest.split("/") or rest.split("/")[0] != place.name:
            return f"a file of something else: {line!r:.100}"
        if not (place.parent / rest).is_file():
            return f"a file that is not there: {rest!r:.80}"
    return None
