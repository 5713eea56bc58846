"""The standard output and error of a process that executes plugins: the log of its run."""

import contextlib
import ctypes
import faulthandler
import os
import sys
from pathlib import Path

_LIBC = ctypes.CDLL(None)
LARGEST = 16 * 2**20
"""Bytes of a log that are kept."""


def redirect(log: Path | str) -> None:
    """Append everything that this process prints, in Python or in native code, to a file; also why it crashes."""
    flush()
    append_to(log)
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(line_buffering=True, errors="backslashreplace")  # type: ignore[union-attr]
    faulthandler.enable()


def append_to(log: Path | str) -> None:
    """Redirect this process, or one that it has forked, to another file; nothing is in buffers."""
    target = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
    os.dup2(target, 1)
    os.dup2(target, 2)
    os.close(target)


def flush() -> None:
    """Empty Python's and the C library's buffers."""
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(Exception):  # a plugin closed it, or put something else in its place
            stream.flush()
    _LIBC.fflush(None)


def cut(log: Path) -> None:
    """Shorten a log that is too large; processes that write to it continue at its end."""
    with contextlib.suppress(OSError):
        if log.stat().st_size > LARGEST:
            note = f"\n(cut after {LARGEST >> 20} MiB)\n".encode()
            os.truncate(log, LARGEST - len(note))
            with log.open("ab") as file:
                file.write(note)


def remove_empty(log: Path) -> None:
    """Remove a log in which nothing was printed."""
    with contextlib.suppress(OSError):
        if not log.stat().st_size:
            log.unlink()
