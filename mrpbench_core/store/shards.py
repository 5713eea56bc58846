"""Reads files of records line by line: they may be larger than memory, and any line may be damaged."""

import functools
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, BinaryIO

import msgspec

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.jsonl import line
from mrpbench_core.model.runs.status import RunStatus

LINE_LIMIT = 16 * 2**20
"""Bytes of a record."""
DEPTH_LIMIT = 8
"""Nested arrays and objects in a value of a record."""

_ADVICE = "left out, and its run counts as not done: `mrpbench run` repeats it; delete the line to stop this message"


class _Limits(msgspec.Struct):
    planning: float | None = None


class _Config(msgspec.Struct):
    limits: _Limits | None = None


class _Error(msgspec.Struct):
    stage: str | None = None
    message: str | None = None


class _Analysis(msgspec.Struct):
    planned: bool = True


class _Plan(msgspec.Struct):
    setting: str | None = None
    problem: str | None = None
    assigns: bool = False
    cost: float | None = None
    lower_bound: float | None = None
    factor: float | None = None
    unsolvable: bool = False


class _Record(msgspec.Struct):
    """The types of the keys that the framework reads; a record may have others."""

    run_id: Annotated[str, msgspec.Meta(pattern=r"^[0-9A-Za-z_-]+\Z", max_length=64)]  # part of file names
    status: RunStatus
    config: _Config
    scenario_id: str | None = None
    attempt: Annotated[int, msgspec.Meta(ge=0, le=2**31 - 1)] = 1
    seed: Annotated[int, msgspec.Meta(ge=0)] | None = None
    repeat: Annotated[int, msgspec.Meta(ge=0)] | None = None
    reassigned: Annotated[int, msgspec.Meta(ge=0)] | None = None
    metrics: dict[str, Any] | None = None
    timing: dict[str, Any] | None = None
    provenance: dict[str, Any] | None = None
    error: _Error | None = None
    unmeasured: dict[str, str] | None = None
    unexported: dict[str, str] | None = None
    analysis: _Analysis | None = None
    plan: _Plan | None = None
    true_poses: str | None = None


@functools.cache
def _decoder() -> msgspec.json.Decoder[dict[str, Any]]:
    """Decodes objects whose integers have 64 bits and whose depth is limited; 15 ms to build."""
    scalar: Any = bool | Annotated[int, msgspec.Meta(ge=-(2**63), le=2**63 - 1)] | float | str | None
    value: Any = scalar
    for _ in range(DEPTH_LIMIT):
        value = scalar | list[value] | dict[str, value]
    return msgspec.json.Decoder(dict[str, value])


def read_shard(path: Path, damaged: list[InputError] | None = None) -> Iterator[tuple[int, dict[str, Any]]]:
    """Yield the byte offset and content of each record; an unterminated last line is one that a crash cut off.

    A finished line that is not a record (a disk's fault, an editor's) must not cost the others: it is passed over.

    Args:
        path: the file.
        damaged: receives what is wrong with each such line, or with the file.
    """
    try:
        if not path.is_file():
            raise OSError(None, "it is not a file")  # a FIFO would be read without end
        with path.open("rb") as stream:
            offset, number = 0, 0
            while text := stream.readline(LINE_LIMIT):
                number += 1
                try:
                    if not text.endswith(b"\n"):
                        if not _skip_line(stream):
                            return
                        raise _fault(f"it is longer than {LINE_LIMIT // 2**20} MiB", path, number)
                    if text.strip():
                        yield offset, _record(text, path, number)
                except InputError as error:
                    if damaged is not None:
                        damaged.append(error)
                offset = offset + len(text) if text.endswith(b"\n") else stream.tell()
    except OSError as error:
        if damaged is not None:
            damaged.append(InputError(f"cannot be read: {error.strerror or error}", file=path))


def read_at(path: Path, offset: int) -> dict[str, Any]:
    """The record that begins at a byte offset.

    Raises:
        InputError: it was damaged since its offset was found.
    """
    with path.open("rb") as stream:
        stream.seek(offset)
        return _record(stream.readline(LINE_LIMIT), path, None)


def check_storable(record: Mapping[str, Any]) -> str | None:
    """Return why a record could not be read again, or None."""
    try:
        text = f"{line(record)}\n".encode()
        if len(text) > LINE_LIMIT:
            return f"it is longer than {LINE_LIMIT // 2**20} MiB"
        msgspec.convert(_decoder().decode(text), _Record)
    except (msgspec.MsgspecError, TypeError, ValueError, RecursionError) as error:
        return str(error)
    return None


def _skip_line(stream: BinaryIO) -> bool:
    """Read to the end of a line, in parts; tell whether it is finished."""
    while part := stream.readline(LINE_LIMIT):
        if part.endswith(b"\n"):
            return True
    return False


def _record(text: bytes, path: Path, number: int | None) -> dict[str, Any]:
    try:
        record: dict[str, Any] = _decoder().decode(text)
        msgspec.convert(record, _Record)
    except (msgspec.MsgspecError, UnicodeDecodeError) as error:
        raise _fault(str(error), path, number) from None
    return record


def _fault(reason: str, path: Path, number: int | None) -> InputError:
    return InputError(f"is not a record: {reason}", file=path, line=number, hint=_ADVICE)
