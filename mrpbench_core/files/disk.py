"""A full disk is no fault of what was being written: the same again succeeds once there is room."""

import errno

REFUSED = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG})
"""No space, a user's quota, a limit of file sizes."""
SQLITE_REFUSED = frozenset({10, 13})
"""SQLite's primary result codes IOERR and FULL (sqlite.org/rescode.html): it says FULL for ENOSPC alone."""


def is_full(error: BaseException) -> bool:
    """Tell whether `error` says that a file system took no more, also in SQLite's words."""
    if isinstance(error, OSError):
        return error.errno in REFUSED
    return getattr(error, "sqlite_errorcode", 0) & 0xFF in SQLITE_REFUSED
