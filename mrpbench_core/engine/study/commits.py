"""Stores finished runs: the files of a run are on disk before its record, and earlier attempts are kept until then.

A disk takes milliseconds to confirm, so a thread of its own stores records: as many at once as came in the meantime.
"""

import logging
from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.engine.processes.job import JobOutcome
from mrpbench_core.engine.record import RunError, RunRecord
from mrpbench_core.engine.study.record import complete_record
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.jsonl import Writer
from mrpbench_core.files.output import sync_file_system
from mrpbench_core.files.printing import printable
from mrpbench_core.files.removal import remove_tree
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.store.folder import ResultsFolder, new_invocation
from mrpbench_core.store.run_files import seal
from mrpbench_core.store.shards import check_storable

LOG = logging.getLogger(__name__)


@attrs.frozen(kw_only=True)
class EndedRun:
    """A run that ended with a record or a failure."""

    point: StudyRun
    attempt: int
    outcome: JobOutcome


@attrs.define(kw_only=True)
class Commits:
    """Finished runs on their way to disk."""

    folder: ResultsFolder
    shard: Writer
    invocation: str
    """SHA-256 and name of the document of the invocation."""
    workers: int
    going: "Future[list[tuple[EndedRun, dict[str, Any]]]] | None" = attrs.field(default=None, init=False)
    """Done when records are on disk, which `stored` returns."""
    _waiting: list[EndedRun] = attrs.field(factory=list, init=False)
    _others: dict[Path, int] = attrs.field(init=False)
    """Size of each other file of records."""
    _disk: ThreadPoolExecutor = attrs.field(factory=lambda: ThreadPoolExecutor(1), init=False)

    def __attrs_post_init__(self) -> None:
        self._others = self._sizes()

    def add(self, ended: Sequence[EndedRun]) -> None:
        """Begin to store runs, or do so when the earlier ones are stored."""
        self._waiting += ended
        if self.going is None and self._waiting:
            batch, self._waiting = self._waiting, []
            self.going = self._disk.submit(self._store, batch)

    def stored(self) -> list[tuple[EndedRun, dict[str, Any]]]:
        """Wait for the records that are being stored, return them, and begin to store those that wait.

        Raises:
            InputError: they cannot be written.
        """
        assert self.going is not None
        going, self.going = self.going, None
        entries = going.result()
        self.add(())
        return entries

    def close(self) -> None:
        """Store what is left.

        Raises:
            InputError: it cannot be written.
        """
        try:
            while self.going is not None:
                self.stored()
            if not self.shard.is_intact(content=True):
                self._warn(self.shard.path)
            for path, size in self._sizes().items():
                if path != self.shard.path and self._others.get(path) != size:
                    self._warn(path)
        finally:
            self._disk.shutdown()
            self.shard.close()

    def _sizes(self) -> dict[Path, int]:
        """The size of each file of records."""
        return {path: path.lstat().st_size for path in self.folder.shards()}

    def _warn(self, path: Path) -> None:
        """Say that something else has written to a file of records, which the lock of the folder forbids."""
        LOG.warning(
            "%s: was changed while runs were executed, by one of their plugins or another program; its records cannot"
            " be relied on (delete the folder, and find the plugin)",
            path,
        )

    def _replace_shard(self) -> None:
        """Go on in another file: what is written to this one might be lost."""
        self._warn(self.shard.path)
        self.shard.close()
        self.shard.path.parent.mkdir(exist_ok=True)
        self._others = self._sizes()
        self.shard = Writer(self.folder.shard(new_invocation()), exclusive=True)

    def _store(self, batch: Sequence[EndedRun]) -> list[tuple[EndedRun, dict[str, Any]]]:
        try:
            records = [self._complete(ended) for ended in batch]
            if any(len(record["provenance"]["files"]) > 1 for record in records):
                sync_file_system(self.folder.path)
            if not self.shard.is_intact():
                self._replace_shard()
            self.shard.write(*records)
            for ended in batch:
                self.folder.forget_before(ended.point.run_id, ended.attempt)
        except OSError as error:
            file = error.filename or self.shard.path
            raise InputError(f"cannot be written: {error.strerror}", file=file) from error
        return list(zip(batch, records, strict=True))

    def _complete(self, ended: EndedRun) -> dict[str, Any]:
        point, attempt, outcome = ended.point, ended.attempt, ended.outcome
        if outcome.record is None and (outcome.failure is None or outcome.failure.stage != Stage.METRICS):
            self.folder.forget(point.run_id, attempt)  # nothing was judged
        record = complete_record(point, attempt, outcome, self.workers, self.invocation)
        if outcome.record is None:
            paths = self.folder.run(point.run_id, attempt)
            remove_tree(paths.exports, ignore_errors=True)  # their sums may be what took too long
            record.run.files = seal(paths)
        document = record.document()
        if (fault := check_storable(document)) is not None:
            record.run = _not_stored(record.run, fault)
            return record.document()
        return document


def _not_stored(run: RunRecord, fault: str) -> RunRecord:
    """The record of a run whose own record cannot be stored."""
    error = RunError(stage=Stage.WORKER, message=f"the record of the run cannot be stored: {printable(fault)}")
    return RunRecord(run_id=run.run_id, status=RunStatus.CRASHED, error=error, files=run.files)
