"""Write JSON lines: one object per line; a crash loses at most the line that is being written."""

import json
import os
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Self


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
        self._descriptor = os.open(
            self.path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | (os.O_EXCL if exclusive else 0), 0o644
        )
        content = b"" if exclusive else self.path.read_bytes()
        os.ftruncate(self._descriptor, content.rfind(b"\n") + 1)
        os.lseek(self._descriptor, 0, os.SEEK_END)

    def write(self, *values: Mapping[str, Any]) -> None:
        """Append objects."""
        content = "".join(f"{line(value)}\n" for value in values).encode()
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
