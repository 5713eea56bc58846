"""Hash files: the content of a file identifies a run, not its name."""

import functools
import hashlib
from pathlib import Path

from mrpbench_core.files.text import read_bytes


def content_hash(path: Path) -> str:
    """Return the SHA-256 of a file, which is read again only after a change.

    Raises:
        InputError: it cannot be read.
    """
    try:
        status = path.stat()
    except (OSError, ValueError):
        return _hash(path, None)
    return _hash(path, (status.st_mtime_ns, status.st_size, status.st_ino))


@functools.lru_cache(maxsize=1024)
def _hash(path: Path, _: tuple[int, int, int] | None) -> str:
    return hashlib.sha256(read_bytes(path)).hexdigest()
