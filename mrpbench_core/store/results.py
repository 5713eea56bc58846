"""The records of a results folder: for each run, the one of its highest attempt."""

import logging
import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from mrpbench_core.files import yaml
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.printing import printable
from mrpbench_core.files.text import counted
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.preview import preview
from mrpbench_core.store.record_index import Entry, RecordIndex
from mrpbench_core.store.recording import Recording
from mrpbench_core.store.run_files import check_recording, names_files
from mrpbench_core.store.shards import read_at, read_shard

if TYPE_CHECKING:
    from pandas import DataFrame  # type: ignore[import-untyped]

_ATTEMPT = re.compile(r"(?P<run_id>.+)-(?P<attempt>[1-9]\d{0,9})")
SHOWN = 10
"""Runs in the text of results."""
_LOG = logging.getLogger(__name__)


class Results:
    """Records of finished runs, in the order in which they were stored.

    Records are read from disk as they are asked for: a folder of 10^6 runs costs 200 MB, not gigabytes.
    """

    def __init__(self, folder: ResultsFolder, only: Iterable[str] | None = None, *, warn: bool = False) -> None:
        """Open a folder; its files are read when they are first needed.

        Args:
            folder: of the results.
            only: ids of the runs that count; None = all.
            warn: log each damaged line.
        """
        self.folder = folder
        self._only = None if only is None else frozenset(only)
        self._warn = warn
        self._damaged: list[InputError] = []
        self._records: RecordIndex | None = None

    def scan(self, visit: Callable[[dict[str, Any]], object] | None = None) -> bool:
        """Find all records, and call `visit` with each one.

        Returns:
            Whether the records that were visited are those of this object: each run once. If not, iterate.
        """
        if self._records is not None:
            return visit is None
        self._records, once = RecordIndex(), True
        for shard in self.folder.shards():
            for offset, record in read_shard(shard, self._damaged):
                run_id, attempt = record["run_id"], record.get("attempt", 1)
                if (self._only is not None and run_id not in self._only) or self._records.attempt(run_id) >= attempt:
                    continue
                code = origin(record.get("provenance") or {})
                entry = Entry(attempt, record["status"], code, shard, offset, names_files(record))
                once = self._records.put(run_id, entry) and once
                if visit is not None:
                    visit(record)
        for error in self._damaged if self._warn else ():
            _LOG.warning("%s", error)
        return once

    @property
    def damaged(self) -> list[InputError]:
        """Lines that are not records, each with advice. Their runs count as not done."""
        self.scan()
        return self._damaged

    @cached_property
    def invocations(self) -> list[Any]:
        """The documents of all invocations, oldest first, without unreadable ones, as in a half-copied folder."""
        documents = []
        for file in sorted((self.folder.path / "invocations").glob("*.yaml")):
            with suppress(InputError):
                documents.append(yaml.load(file).data if file.is_file() else None)
        return documents

    @property
    def _index(self) -> RecordIndex:
        self.scan()
        assert self._records is not None
        return self._records

    def __len__(self) -> int:
        return len(self._index.rows)

    def __contains__(self, run_id: object) -> bool:
        return run_id in self._index.rows

    def __iter__(self) -> Iterator[dict[str, Any]]:
        for shard in self._index.shards():
            for offset, record in read_shard(shard):
                if self._index.is_at(record["run_id"], shard, offset):
                    yield record

    def __getitem__(self, run_id: str) -> dict[str, Any]:
        """The record of a run by its id or a unique prefix of its id.

        Raises:
            KeyError: no run, or several runs.
        """
        entry = self._index.get(run_id)
        if entry is None:
            matching = [known for known in self._index.rows if known.startswith(run_id)]
            if len(matching) != 1:
                which = f"begin with {run_id!r}" if run_id else "are here, one must be named"
                raise KeyError(f"{len(matching) or 'no'} runs {which}")
            entry = self._index.get(matching[0])
            assert entry is not None
        return read_at(entry.shard, entry.offset)

    def is_last(self, run_id: str, shard: Path, offset: int) -> bool:
        """Tell whether the record at this place is the one of its run that counts."""
        return self._index.is_at(run_id, shard, offset)

    def entry(self, run_id: str) -> Entry | None:
        """Facts about a run's record without reading it, or None."""
        return self._index.get(run_id)

    def paths(self, run_id: str) -> RunPaths:
        """The files of a run that has a record."""
        entry = self._index.get(run_id)
        assert entry is not None
        return self.folder.run(run_id, entry.attempt if entry.names_files else 1)

    def recording(self, run_id: str) -> Recording:
        """Open the recording of a run that has a record.

        Raises:
            InputError: there is none, it is damaged, or it is another one than the record names.
        """
        file = self.paths(run_id).recording
        check_recording(self[run_id], file)
        return Recording(file)

    def remove_superseded(self) -> None:
        """Remove files of other attempts than the recorded ones, which a killed invocation left; only under the lock.

        Raises:
            OSError: one cannot be removed.
        """
        for part in ("recordings", "exports"):
            for file in (self.folder.path / part).iterdir():
                match = _ATTEMPT.fullmatch(file.name.removesuffix(".zip"))
                if match is None or match[0] in self:
                    continue
                entry = self._index.get(match["run_id"])
                if entry is not None and entry.names_files and entry.attempt != int(match["attempt"]):
                    self.folder.forget(match["run_id"], int(match["attempt"]))
        for run_id in self._index.rows:
            if self._index.attempt(run_id) > 1 and self.paths(run_id) != self.folder.run(run_id):
                self.folder.forget(run_id, 1)

    def statuses(self) -> dict[str, int]:
        """The number of runs by status."""
        return dict(self._index.statuses())

    def __repr__(self) -> str:
        counts = ", ".join(f"{count} {status}" for status, count in self.statuses().items())
        title = f"{self.folder.path}: {counted(len(self), 'run')}" + (f" ({counts})" if counts else "")
        ids = list(self._index.rows)
        shown = ids if len(ids) <= SHOWN else [*ids[: SHOWN // 2], *ids[-SHOWN // 2 :]]
        records = [self[run_id] for run_id in shown]
        metrics = dict.fromkeys(name for record in records for name in record.get("metrics") or ())
        table = preview(list(map(flatten, records)), list(metrics)) if records else []
        if len(ids) > SHOWN:
            table.insert(1 + SHOWN // 2, "…")
        return "\n".join([printable(title), *table])

    def to_pandas(self) -> "DataFrame":
        """One row for each run, with the columns of `to_rows` except the provenance; null is NaN or None.

        Raises:
            InputError: pandas is not installed.
        """
        try:
            from pandas import DataFrame
        except ImportError:
            raise InputError("`to_pandas` needs pandas", hint="`pip install pandas`") from None
        parts = ({key: value for key, value in record.items() if key != "provenance"} for record in self)
        return DataFrame([flatten(part) for part in parts])

    def to_rows(self) -> list[dict[str, Any]]:
        """One flat dict per run: `config.planner.plugin`, `planning.sum_of_costs`, `timing.planning_s`, …"""
        return [flatten(record) for record in self]


def origin(provenance: dict[str, Any]) -> str:
    """The part of a record's provenance that can change its numbers, as text to compare."""
    return msgspec.json.encode([provenance.get("components"), provenance.get("versions")]).decode()


def flatten(record: dict[str, Any]) -> dict[str, Any]:
    """Dotted keys instead of nested objects; `metrics` keeps its own keys, lists stay as they are."""
    flat: dict[str, Any] = {}

    def walk(prefix: str, value: Any) -> None:
        if isinstance(value, dict) and (value or not prefix):
            for key, item in value.items():
                walk(f"{prefix}.{key}" if prefix else key, item)
        else:
            flat[prefix] = value

    walk("", {key: value for key, value in record.items() if key != "metrics"})
    return flat | (record.get("metrics") or {})


def load(folder: Path | str) -> Results:
    """The results in a folder.

    Raises:
        InputError: it is not a results folder.
    """
    results = ResultsFolder(Path(folder))
    if not (results.path / "runs").is_dir():
        raise InputError("is not a results folder", file=folder, hint="give the folder that `mrpbench run` wrote")
    return Results(results, warn=True)
