"""Recognise a full disk, after which the same operation succeeds once there is space."""

import errno

REFUSED = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG})
"""No space, quota exceeded, file size limit exceeded."""
SQLITE_REFUSED = frozenset({10, 13})
"""Primary result codes IOERR and FULL of SQLite (sqlite.org/rescode.html), which uses FULL for ENOSPC only."""


def is_full(error: BaseException) -> bool:
    """Tell whether `error` means that a file system is full; errors of SQLite are recognised too."""
    if isinstance(error, OSError):
        return error.errno in REFUSED
    return getattr(error, "sqlite_errorcode", 0) & 0xFF in SQLITE_REFUSED
