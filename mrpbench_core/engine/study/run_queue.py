"""Distributes the runs of one invocation to workers, and has each record stored as soon as it arrives."""

from collections import Counter, deque
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Future, wait
from contextlib import closing, contextmanager
from typing import Any

import attrs

from mrpbench_core.api.executor import WorkerLost
from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.engine.processes.job import Failure, Job, JobOutcome
from mrpbench_core.engine.processes.slots import close_slots, progress_in_slots
from mrpbench_core.engine.study.calls import Calls
from mrpbench_core.engine.study.commits import Commits, EndedRun
from mrpbench_core.engine.study.hooks import StudyHooks
from mrpbench_core.engine.study.progress import StudyProgress
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.store.folder import ResultsFolder

LOSSES = 3
"""A run whose worker is ended from outside is repeated as the next attempt; after so many it counts as crashed."""


@attrs.define(kw_only=True)
class RunQueue:
    """The runs that wait for a worker, and those that are being executed."""

    calls: Calls
    """Executes runs."""
    waiting: deque[tuple[StudyRun, int]]
    """Runs with their attempts."""
    workers: int
    folder: ResultsFolder
    commits: Commits
    hooks: StudyHooks
    progress: StudyProgress
    mistakes: dict[str, str] = attrs.field(factory=dict)
    """The errors of refused runs, by run id."""
    _going: dict[Future[JobOutcome], tuple[StudyRun, int, Job]] = attrs.field(factory=dict, init=False)
    _losses: Counter[str] = attrs.field(factory=Counter, init=False)

    def run_all(self) -> None:
        """Execute all runs, at most as many at once as there are workers, so that memory does not grow with the study.

        When anything, Ctrl-C included, ends it early, the runs in flight are ended too; those that finished are stored.

        Raises:
            InputError: the executor fails, or a record cannot be written.
        """
        with closing(self.commits), self._ending():
            while self._hand_out() or self.commits.going is not None:
                pending: set[Future[Any]] = {*self._going, *filter(None, [self.commits.going])}
                done = wait(pending, self.progress.interval_s, FIRST_COMPLETED).done
                if not done:
                    self.progress.going(progress_in_slots(self.calls.slots))
                if self.commits.going in done:
                    self._tell()
                self._take(done & self._going.keys())

    def _tell(self) -> None:
        """Tell hooks and progress which records were stored."""
        for ended, record in self.commits.stored():
            self.hooks.call("mrpbench_run_finished", record=record)
            self.progress.finished(ended.point, record)

    def _hand_out(self) -> bool:
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
            job = self._job(point, attempt)
            self._going[self.calls.submit(job)] = point, attempt, job
        return bool(self._going)

    def _take(self, done: set[Future[JobOutcome]]) -> None:
        """Take the runs that have ended; an executor's own failure ends the study, after the others were stored."""
        taken, failed = [], None
        for future in done:
            point, attempt, job = self._going.pop(future)
            try:
                outcome = self.calls.outcome(future, job)
            except WorkerLost as loss:
                outcome = _lost(point, loss)
            except InputError as error:
                failed = error
                continue
            taken += self._ended(point, attempt, outcome)
        try:
            if failed is not None:
                raise failed
            self._hand_out()  # before storing, so that no worker waits
        finally:
            self.commits.add(taken)

    def _ended(self, point: StudyRun, attempt: int, outcome: JobOutcome) -> list[EndedRun]:
        """Return the run if it is to be stored."""
        if outcome.failure is not None and outcome.failure.lost:
            self._losses[point.run_id] += 1
            if self._losses[point.run_id] < LOSSES:  # else it was perhaps the run itself
                self.progress.lost(point, outcome.failure.message)
                self.waiting.append((point, attempt + 1))
                return []
        if outcome.mistake is not None:
            self._refuse(point, outcome.mistake)
            return []
        return [EndedRun(point=point, attempt=attempt, outcome=outcome)]

    def _refuse(self, point: StudyRun, mistake: str) -> None:
        self.mistakes[point.run_id] = mistake
        self.progress.refused(point, mistake)

    def _job(self, point: StudyRun, attempt: int) -> Job:
        return Job(
            run_id=point.run_id,
            parcel=point.parcel,
            facts=point.facts,
            keep=point.canonical["recording"]["keep"],
            paths=self.folder.run(point.run_id, attempt),
            log=self.folder.log(point.run_id),
            wall_s=point.wall_s,
            memory_bytes=point.memory_bytes,
        )

    @contextmanager
    def _ending(self) -> Iterator[None]:
        try:
            yield
        except BaseException:
            close_slots(self.calls.slots)  # or the runs in flight would go on
            raise
        finally:
            for future in self._going:
                future.cancel()
            self.calls.end_slots()


def _lost(point: StudyRun, loss: WorkerLost) -> JobOutcome:
    """The outcome of a run whose remote worker was lost."""
    failure = Failure(status=RunStatus.CRASHED, stage=Stage.WORKER, message=str(loss), seconds=0.0, lost=True)
    return JobOutcome(run_id=point.run_id, failure=failure)
