"""Write JSON lines: one object per line; a crash loses at most the line that is being written."""

import json
import os
from collections.abc import Mapping
from hashlib import file_digest, sha256
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


def _identity(status: os.stat_result) -> tuple[int, int, int]:
    return status.st_dev, status.st_ino, status.st_size


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
        lines = content[: content.rfind(b"\n") + 1]
        os.ftruncate(self._descriptor, len(lines))
        os.lseek(self._descriptor, 0, os.SEEK_END)
        self._written = sha256(lines)
        self._left = _identity(os.fstat(self._descriptor))

    def write(self, *values: Mapping[str, Any]) -> None:
        """Append objects."""
        content = "".join(f"{line(value)}\n" for value in values).encode()
        try:
            while content:
                size = os.write(self._descriptor, content)
                self._written.update(content[:size])
                content = content[size:]
            os.fsync(self._descriptor)
        finally:
            self._left = _identity(os.fstat(self._descriptor))

    def is_intact(self, *, content: bool = False) -> bool:
        """Tell whether nothing else has replaced the file or changed its size, or also its content, since `write`."""
        try:
            identity = _identity(self.path.lstat())
            if content and identity == self._left:
                with self.path.open("rb") as stream:
                    return file_digest(stream, "sha256").digest() == self._written.digest()
        except OSError:
            return False
        return identity == self._left

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
