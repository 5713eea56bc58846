"""Distributes the runs of one invocation to workers, and has each record stored as soon as it arrives."""

from collections import Counter, deque
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import closing, contextmanager
from typing import Any

import attrs

from mrpbench_core.api.executor import RemoteExecutor, WorkerLost
from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.engine.processes.job import Failure, Job, JobOutcome
from mrpbench_core.engine.processes.slots import close_slots, progress_in_slots, run_in_slot
from mrpbench_core.engine.study.commits import Commits, EndedRun
from mrpbench_core.engine.study.hooks import StudyHooks
from mrpbench_core.engine.study.progress import StudyProgress
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.store.folder import ResultsFolder

LOSSES = 3
"""A run whose worker is ended from outside is repeated as the next attempt; after so many it counts as crashed."""


@attrs.define(kw_only=True)
class RunQueue:
    """The runs that wait for a worker, and those that are being executed."""

    slots: str
    """Key of the worker slots, in each process that executes runs."""
    waiting: deque[tuple[StudyRun, int]]
    """Runs with their attempts."""
    workers: int
    folder: ResultsFolder
    commits: Commits
    hooks: StudyHooks
    progress: StudyProgress
    mistakes: dict[str, str] = attrs.field(factory=dict)
    """The errors of refused runs, by run id."""
    _going: dict[Future[JobOutcome], tuple[StudyRun, int]] = attrs.field(factory=dict, init=False)
    _losses: Counter[str] = attrs.field(factory=Counter, init=False)

    def run_all(self, executor: Executor) -> None:
        """Execute all runs, at most as many at once as there are workers, so that memory does not grow with the study.

        When anything, Ctrl-C included, ends it early, the runs in flight are ended too; those that finished are stored.
        """
        with closing(self.commits), self._ending(executor):
            while self._hand_out(executor) or self.commits.going is not None:
                pending: set[Future[Any]] = {*self._going, *filter(None, [self.commits.going])}
                done = wait(pending, self.progress.interval_s, FIRST_COMPLETED).done
                if not done:
                    self.progress.going(progress_in_slots(self.slots))
                if self.commits.going in done:
                    self._tell()
                ended = [(*self._going.pop(future), future) for future in done & self._going.keys()]
                self._hand_out(executor)  # before storing, so that no worker waits
                self.commits.add([run for run in (self._take(*entry) for entry in ended) if run is not None])
                for _, _, future in ended:  # an executor's own failure ends the study, after the others were stored
                    if not isinstance(future.exception(), WorkerLost):
                        future.result()

    def _tell(self) -> None:
        """Tell hooks and progress which records were stored."""
        for ended, record in self.commits.stored():
            self.hooks.call("mrpbench_run_finished", record=record)
            self.progress.finished(ended.point, record)

    def _hand_out(self, executor: Executor) -> bool:
        """Give runs to idle workers; tell whether any run is being executed."""
        while self.waiting and len(self._going) < self.workers:
            point, attempt = self.waiting.popleft()
            self.hooks.call("mrpbench_run_started", run_id=point.run_id, config=point.canonical)
            self.progress.started(point)
            try:
                self.folder.forget(point.run_id, attempt)  # what a killed invocation left
            except OSError as error:
                self._refuse(point, f"{error.filename}: is in the way of a file of a run: {error.strerror} (remove it)")
                continue
            self._going[executor.submit(run_in_slot, self.slots, self._job(point, attempt))] = point, attempt
        return bool(self._going)

    def _take(self, point: StudyRun, attempt: int, future: Future[JobOutcome]) -> EndedRun | None:
        """Return the run if it is to be stored."""
        failed = future.exception()
        if failed is not None and not isinstance(failed, WorkerLost):
            return None
        outcome = future.result() if failed is None else _lost(point, failed)
        if outcome.failure is not None and outcome.failure.lost:
            self._losses[point.run_id] += 1
            if self._losses[point.run_id] < LOSSES:  # else it was perhaps the run itself
                self.progress.lost(point, outcome.failure.message)
                self.waiting.append((point, attempt + 1))
                return None
        if outcome.mistake is not None:
            self._refuse(point, outcome.mistake)
            return None
        return EndedRun(point=point, attempt=attempt, outcome=outcome)

    def _refuse(self, point: StudyRun, mistake: str) -> None:
        self.mistakes[point.run_id] = mistake
        self.progress.refused(point, mistake)

    def _job(self, point: StudyRun, attempt: int) -> Job:
        return Job(
            run_id=point.run_id,
            parcel=point.parcel,
            paths=self.folder.run(point.run_id, attempt),
            log=self.folder.log(point.run_id),
            wall_s=point.wall_s,
            memory_bytes=point.memory_bytes,
        )

    @contextmanager
    def _ending(self, executor: Executor) -> Iterator[None]:
        try:
            yield
        except BaseException:
            close_slots(self.slots)  # or the runs in flight would go on
            raise
        finally:
            if isinstance(executor, RemoteExecutor):
                for future in self._going:
                    future.cancel()
                executor.everywhere(close_slots, self.slots)
            executor.shutdown(wait=True, cancel_futures=True)


def _lost(point: StudyRun, loss: WorkerLost) -> JobOutcome:
    """The outcome of a run whose remote worker was lost."""
    failure = Failure(status=RunStatus.CRASHED, stage=Stage.WORKER, message=str(loss), seconds=0.0, lost=True)
    return JobOutcome(run_id=point.run_id, failure=failure)
