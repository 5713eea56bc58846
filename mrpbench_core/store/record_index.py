"""The places of records, and the facts that decide whether a run is repeated, as columns: 200 bytes for each run."""

from array import array
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Generic, TypeVar

import attrs

Value = TypeVar("Value")


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


class _Repeated(Generic[Value]):
    """A column with few different values."""

    def __init__(self) -> None:
        self._numbers: dict[Value, int] = {}
        self._values: list[Value] = []
        self._rows = array("i")

    def __getitem__(self, row: int) -> Value:
        return self._values[self._rows[row]]

    def __iter__(self) -> Iterator[Value]:
        return (self._values[number] for number in self._rows)

    def put(self, row: int, value: Value) -> None:
        """Set a row, or append one."""
        number = self._numbers.setdefault(value, len(self._values))
        if number == len(self._values):
            self._values.append(value)
        if row == len(self._rows):
            self._rows.append(number)
        else:
            self._rows[row] = number


class RecordIndex:
    """The entry of each run."""

    def __init__(self) -> None:
        self.rows: dict[str, int] = {}
        """Row of each run, by its id."""
        self._attempt, self._offset, self._names_files = array("i"), array("q"), array("b")
        self._status, self._origin = _Repeated[str](), _Repeated[str]()
        self._shard = _Repeated[Path]()

    def get(self, run_id: str) -> Entry | None:
        """The entry of a run, if it has a record."""
        row = self.rows.get(run_id)
        if row is None:
            return None
        return Entry(
            self._attempt[row],
            self._status[row],
            self._origin[row],
            self._shard[row],
            self._offset[row],
            bool(self._names_files[row]),
        )

    def attempt(self, run_id: str) -> int:
        """The recorded attempt of a run; -1 if it has no record."""
        row = self.rows.get(run_id)
        return -1 if row is None else self._attempt[row]

    def put(self, run_id: str, entry: Entry) -> bool:
        """Set the entry of a run; tell whether it had none."""
        row = self.rows.setdefault(run_id, len(self.rows))
        is_new = row == len(self._attempt)
        if is_new:
            self._attempt.append(0)
            self._offset.append(0)
            self._names_files.append(0)
        self._attempt[row], self._offset[row], self._names_files[row] = entry.attempt, entry.offset, entry.names_files
        self._status.put(row, entry.status)
        self._origin.put(row, entry.origin)
        self._shard.put(row, entry.shard)
        return is_new

    def is_at(self, run_id: str, shard: Path, offset: int) -> bool:
        """Tell whether the record at this place is the one of its run."""
        row = self.rows.get(run_id)
        return row is not None and self._offset[row] == offset and self._shard[row] == shard

    def shards(self) -> list[Path]:
        """The files that hold records, oldest first."""
        return sorted(set(self._shard))

    def statuses(self) -> Counter[str]:
        """The number of runs by status."""
        return Counter(self._status)
