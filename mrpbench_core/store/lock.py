"""A lock that lets only one invocation work in a results folder."""

import fcntl
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from mrpbench_core.files.errors import InputError


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold the folder's lock.

    The kernel drops a lock when its holder ends, however it ends, so that none can go stale. The file stays: removing
    it would let two invocations lock two different files of that name.

    Raises:
        InputError: another process holds it, or there can be none: a symbolic link, a folder or a FIFO is in its place,
            or the disk is read-only.
    """
    file = folder / ".lock"
    try:
        descriptor = os.open(file, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK, 0o644)
    except OSError as error:
        raise InputError(f"cannot be locked: {error.strerror}", file=file) from None
    try:
        if not stat.S_ISREG(os.fstat(descriptor).st_mode):
            raise InputError("is not a file, so the folder cannot be locked", file=file, hint="remove it")
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            holder = os.read(descriptor, 100).decode(errors="replace").strip() or "unknown"
            raise InputError(
                f"another invocation is working in this folder ({holder})",
                file=folder,
                hint="wait for it, or give this one its own --out; result folders are merged by copying",
            ) from None
        except OSError as error:
            raise InputError(f"this file system cannot lock the folder: {error.strerror}", file=folder) from error
        os.ftruncate(descriptor, 0)
        os.write(descriptor, f"process {os.getpid()} on {os.uname().nodename}\n".encode())
        yield
    finally:
        os.close(descriptor)
