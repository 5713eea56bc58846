"""Where mrpbench works: runs need calls of Linux, reading and reporting needs POSIX."""

import sys

from mrpbench_core.files.errors import InputError


def require_posix() -> None:
    """Refuse Windows, which lacks the locks of results folders.

    Raises:
        InputError: this is Windows.
    """
    if sys.platform == "win32":
        raise InputError("mrpbench does not work on Windows", hint="use the Windows Subsystem for Linux (WSL)")


def require_linux() -> None:
    """Refuse systems on which the engine cannot end a run with all its processes.

    Raises:
        InputError: this is not Linux.
    """
    if sys.platform != "linux":
        raise InputError("runs need Linux", hint="results of other machines can be read and reported here")
