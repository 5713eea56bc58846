"""Files by content: what identifies a run is what a file says, not where it lies."""

import functools
import hashlib
from pathlib import Path

from mrpbench_core.files.text import read_bytes


def content_hash(path: Path) -> str:
    """SHA-256 of a file; read again only when the file has changed.

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
