"""JSON lines: one object per line; a crash loses at most the line that is being written."""

import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, NoReturn, Self

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import read_bytes


def read(path: Path | str) -> list[dict[str, Any]]:
    """Return the objects of a file; an unterminated last line, cut off by a crash, is skipped."""
    return [value for _, value in numbered(path)]


def numbered(path: Path | str) -> Iterator[tuple[int, dict[str, Any]]]:
    """Yield line number (from 1) and object of every finished line.

    Raises:
        InputError: the file cannot be read, or a finished line is not one JSON object of finite numbers.
    """
    lines = read_bytes(path).split(b"\n")
    for number, line in enumerate(lines[:-1], start=1):
        if line.strip():
            yield number, _parse(line, path, number)


def line(value: Mapping[str, Any]) -> str:
    """Return `value` as one line without its end.

    Raises:
        ValueError: a number is not finite, which JSON cannot express.
        TypeError: a value or key has a type that JSON does not have.
    """
    return json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))


class Writer:
    """Appends objects to a file; each is on disk when `write` returns.

    A line that a crash truncated is removed when the file is opened again, so that later lines stay readable.
    """

    def __init__(self, path: Path | str, *, exclusive: bool = False) -> None:
        """Open `path`; with `exclusive`, it must not exist yet (FileExistsError)."""
        self.path = Path(path)
        self._descriptor = os.open(self.path, os.O_RDWR | os.O_CREAT | (os.O_EXCL if exclusive else 0), 0o644)
        content = b"" if exclusive else self.path.read_bytes()
        os.ftruncate(self._descriptor, content.rfind(b"\n") + 1)
        os.lseek(self._descriptor, 0, os.SEEK_END)

    def write(self, value: Mapping[str, Any]) -> None:
        """Append one object."""
        content = (line(value) + "\n").encode()
        while content:
            content = content[os.write(self._descriptor, content) :]
        os.fsync(self._descriptor)

    def close(self) -> None:
        """Close the file; may be called twice."""
        if self._descriptor >= 0:
            os.close(self._descriptor)
            self._descriptor = -1

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def _parse(content: bytes, path: Path | str, number: int) -> dict[str, Any]:
    try:
        value = json.loads(content.decode(), parse_constant=_refuse_constant)
    except UnicodeDecodeError:
        raise InputError("is not UTF-8 text", file=path, line=number) from None
    except json.JSONDecodeError as error:
        raise InputError(f"is not JSON: {error.msg}", file=path, line=number, column=error.colno) from None
    except (ValueError, RecursionError) as error:
        raise InputError(f"is not JSON: {error}", file=path, line=number) from None
    if not isinstance(value, dict):
        raise InputError("is not a JSON object", file=path, line=number)
    return value


def _refuse_constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is not a JSON number")
