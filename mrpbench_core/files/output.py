"""Write whole files: a reader sees the old content or the new one, never a part."""

import os
import stat
from contextlib import suppress
from pathlib import Path

from mrpbench_core.files.errors import InputError


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
    partial.unlink(missing_ok=True)
    try:
        with os.fdopen(os.open(partial, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, 0o644), "wb") as stream:
            stream.write(content)
            if sync:
                stream.flush()
                os.fsync(stream.fileno())
        partial.replace(file)
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
