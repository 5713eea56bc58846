"""Write whole files: a reader sees the old content or the new one, never a part."""

import ctypes
import os
import stat
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

from mrpbench_core.files.errors import InputError

_LIBC = ctypes.CDLL(None, use_errno=True)


def create_file(file: Path) -> BinaryIO:
    """Create a file for reading and writing; what has its name is removed, so that no symbolic link is followed.

    Raises:
        OSError: it cannot be created.
    """
    file.unlink(missing_ok=True)
    return os.fdopen(os.open(file, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, 0o644), "w+b")


def sync_folder(folder: Path) -> None:
    """Return when the names in a folder are on disk.

    Raises:
        OSError: they cannot be written.
    """
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def sync_file_system(folder: Path) -> None:
    """Return when everything that was written to the file system of a folder is on disk (`syncfs(2)`).

    One call takes as long as that for a single file, however many files there are.

    Raises:
        OSError: it cannot be written.
    """
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        if _LIBC.syncfs(descriptor):
            raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()), str(folder))
    finally:
        os.close(descriptor)


def replace_file(file: Path, content: bytes, *, sync: bool = False) -> None:
    """Write a file under a temporary name, and rename it; neither name is followed if it is a symbolic link.

    Args:
        file: its folder exists.
        content: of the file.
        sync: return when the content is on disk.

    Raises:
        OSError: it cannot be written; the old file is as it was.
    """
    partial = file.with_name(f".{file.name}.{os.getpid()}.partial")
    try:
        with create_file(partial) as stream:
            stream.write(content)
            if sync:
                stream.flush()
                os.fsync(stream.fileno())
        partial.replace(file)
        if sync:
            sync_folder(file.parent)
    except BaseException:
        with suppress(OSError):
            partial.unlink(missing_ok=True)
        raise


def write_page_file(file: Path, text: str) -> None:
    """Write a page where there is none, or a page.

    Raises:
        InputError: it cannot be written, or something else is there: a symbolic link, a folder, a FIFO.
    """
    try:
        if not stat.S_ISREG(_mode(file)):
            raise InputError("is not a file, so no page is written there", file=file, hint="remove or rename it")
        replace_file(file, text.encode(errors="replace"))
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror or error}", file=file) from None


def _mode(file: Path) -> int:
    try:
        return file.lstat().st_mode
    except FileNotFoundError:
        return stat.S_IFREG
