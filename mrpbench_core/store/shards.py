"""Reads files of records line by line: they may be larger than memory."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mrpbench_core.files.errors import InputError

_ADVICE = "left out, its run counts as not done: `mrpbench run` does it again; delete the line to hear no more of it"


def read_shard(path: Path, damaged: list[InputError] | None = None) -> Iterator[tuple[int, dict[str, Any]]]:
    """Yield the byte offset and content of each record; an unterminated last line is one that a crash cut off.

    A finished line that is no record (a disk's fault, an editor's) must not cost the others: it is passed over.

    Args:
        path: the file.
        damaged: receives what is wrong with each such line.
    """
    with path.open("rb") as stream:
        offset = 0
        for number, line in enumerate(stream, start=1):
            if line.endswith(b"\n") and line.strip():
                try:
                    record = _record(line, path, number)
                except InputError as error:
                    if damaged is not None:
                        damaged.append(error)
                else:
                    yield offset, record
            offset += len(line)


def read_at(path: Path, offset: int) -> dict[str, Any]:
    """The record that begins at a byte offset."""
    with path.open("rb") as stream:
        stream.seek(offset)
        return _record(stream.readline(), path, None)


def _record(line: bytes, path: Path, number: int | None) -> dict[str, Any]:
    try:
        record = json.loads(line)
    except (ValueError, RecursionError) as error:
        raise InputError(f"is not a record: {error}", file=path, line=number, hint=_ADVICE) from None
    if not isinstance(record, dict) or not isinstance(record.get("run_id"), str) or "status" not in record:
        raise InputError("is not a record: no run_id or status", file=path, line=number, hint=_ADVICE)
    return record
