"""Read files, with one line of error if that fails."""

import os
import re
from pathlib import Path

from mrpbench_core.files.errors import InputError

SIZE_LIMIT = 256 * 2**20
"""Bytes. Larger than any map or record file, and small enough that `/dev/zero` gives an error."""

_BLOCK = 2**20
_NOT_TEXT = re.compile("[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def read_bytes(path: Path | str) -> bytes:
    """Return the content of a file.

    Raises:
        InputError: it is missing, a folder, unreadable or larger than `SIZE_LIMIT`.
    """
    try:
        with open(path, "rb", opener=_open) as stream:
            blocks, size = [], 0
            while size <= SIZE_LIMIT and (block := stream.read(_BLOCK)):
                blocks.append(block)
                size += len(block)
    except FileNotFoundError:
        raise InputError("no such file", file=path) from None
    except IsADirectoryError:
        raise InputError("is a folder, not a file", file=path) from None
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise InputError(f"cannot be read: {getattr(error, 'strerror', None) or error}", file=path) from None
    if size > SIZE_LIMIT:
        raise InputError(f"is larger than {SIZE_LIMIT // 2**20} MiB", file=path)
    return b"".join(blocks)


def _open(path: str, flags: int) -> int:
    """Open a file, and a named pipe without a writer as if it were empty: `open` would wait for a writer."""
    descriptor = os.open(path, flags | os.O_NONBLOCK)
    os.set_blocking(descriptor, True)
    return descriptor


def read_text(path: Path | str) -> str:
    """Return the content of a UTF-8 file, without a byte order mark.

    Raises:
        InputError: it cannot be read, or is not UTF-8 (with line and column).
    """
    content = read_bytes(path)
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line, column = position(content[: error.start].decode("utf-8", "replace"), None)
        raise InputError("is not UTF-8 text", file=path, line=line, column=column) from None


def refuse_control_characters(text: str, file: Path | str | None) -> None:
    """Raise an InputError at the first character that YAML does not allow."""
    if match := _NOT_TEXT.search(text):
        line, column = position(text, match.start())
        raise InputError(
            f"character U+{ord(match[0]):04X} is not allowed in a text file", file=file, line=line, column=column
        )


def position(text: str, end: int | None) -> tuple[int, int]:
    """Return line and column, from 1, of the character at `end` (None = after the text)."""
    before = text[:end]
    return before.count("\n") + 1, len(before) - before.rfind("\n")


def counted(number: int, noun: str) -> str:
    """Return number and noun, e.g. `1 run`, `2 runs`."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
