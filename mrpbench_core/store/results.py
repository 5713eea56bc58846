"""The records of a results folder: for each run, the one of its highest attempt."""

import logging
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.jsonl import line
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording
from mrpbench_core.store.run_files import check_recording, names_files
from mrpbench_core.store.shards import read_at, read_shard

_ATTEMPT = re.compile(r"(?P<run_id>.+)-(?P<attempt>[1-9]\d{0,9})")
_LOG = logging.getLogger(__name__)


@attrs.frozen
class Entry:
    """The place of a run's record, and the facts that decide whether the run is repeated."""

    attempt: int
    status: str
    origin: str
    """Versions and source hashes of the run's code, as one text."""
    shard: Path
    offset: int
    names_files: bool
    """False for records of older versions, whose files have the names of the first attempt."""


class Results:
    """Records of finished runs, in the order in which they were stored.

    Records are read from disk as they are asked for: a folder of 10^5 runs costs tens of megabytes, not gigabytes.
    """

    def __init__(self, folder: ResultsFolder, only: Iterable[str] | None = None) -> None:
        self.folder = folder
        self.damaged: list[InputError] = []
        """Lines that are not records, each with advice. Their runs count as not done."""
        self._entries: dict[str, Entry] = {}
        wanted = None if only is None else frozenset(only)
        origins: dict[str, str] = {}  # equal texts become one object
        for shard in folder.shards():
            for offset, record in read_shard(shard, self.damaged):
                run_id = record["run_id"]
                known = self._entries.get(run_id)
                attempt = record.get("attempt", 1)
                if (wanted is not None and run_id not in wanted) or (known is not None and known.attempt >= attempt):
                    continue
                text = origin(record.get("provenance") or {})
                text = origins.setdefault(text, text)
                self._entries[run_id] = Entry(attempt, record["status"], text, shard, offset, names_files(record))

    def __len__(self) -> int:
        return len(self._entries)

    def __contains__(self, run_id: object) -> bool:
        return run_id in self._entries

    def __iter__(self) -> Iterator[dict[str, Any]]:
        places = {(entry.shard, entry.offset) for entry in self._entries.values()}
        for shard in dict.fromkeys(sorted(entry.shard for entry in self._entries.values())):
            for offset, record in read_shard(shard):
                if (shard, offset) in places:
                    yield record

    def __getitem__(self, run_id: str) -> dict[str, Any]:
        """The record of a run by its id or a unique prefix of its id.

        Raises:
            KeyError: no run, or several runs.
        """
        entry = self._entries.get(run_id)
        if entry is None:
            found = [known for known in self._entries if known.startswith(run_id)]
            if len(found) != 1:
                which = f"begin with {run_id!r}" if run_id else "are here, one must be named"
                raise KeyError(f"{len(found) or 'no'} runs {which}")
            entry = self._entries[found[0]]
        return read_at(entry.shard, entry.offset)

    def entry(self, run_id: str) -> Entry | None:
        """Facts about a run's record without reading it, or None."""
        return self._entries.get(run_id)

    def paths(self, run_id: str) -> RunPaths:
        """The files of a run that has a record."""
        entry = self._entries[run_id]
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
                found = _ATTEMPT.fullmatch(file.name.removesuffix(".zip"))
                if found is None or found[0] in self._entries:
                    continue
                entry = self._entries.get(found["run_id"])
                if entry is not None and entry.names_files and entry.attempt != int(found["attempt"]):
                    self.folder.forget(found["run_id"], int(found["attempt"]))
        for run_id, entry in self._entries.items():
            if entry.names_files and entry.attempt > 1:
                self.folder.forget(run_id, 1)

    def statuses(self) -> dict[str, int]:
        """The number of runs by status."""
        counts: dict[str, int] = {}
        for entry in self._entries.values():
            counts[entry.status] = counts.get(entry.status, 0) + 1
        return counts

    def to_rows(self) -> list[dict[str, Any]]:
        """One flat dict per run, for `pandas.DataFrame`: options, metrics and timing become dotted keys."""
        return [flatten(record) for record in self]


def origin(provenance: dict[str, Any]) -> str:
    """The part of a record's provenance that can change its numbers, as text to compare."""
    return line({key: provenance.get(key) for key in ("components", "versions")})


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
        InputError: it is no results folder.
    """
    results = ResultsFolder(Path(folder))
    if not (results.path / "runs").is_dir():
        raise InputError("is no results folder", file=folder, hint="give the folder that `mrpbench run` wrote")
    found = Results(results)
    for error in found.damaged:
        _LOG.warning("%s", error)
    return found
