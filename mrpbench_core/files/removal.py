"""Remove folders in which plugins may have left anything."""

import errno
import os
import shutil
import subprocess
from contextlib import nullcontext, suppress
from pathlib import Path


def remove_tree(folder: Path | str, *, ignore_errors: bool = False) -> None:
    """Remove a folder with all that is in it, however deep.

    Raises:
        OSError: something cannot be removed, and that is not ignored.
    """
    with suppress(OSError) if ignore_errors else nullcontext():
        try:
            shutil.rmtree(folder, ignore_errors)
        except RecursionError:  # it calls itself for each level
            done = subprocess.run(["rm", "-rf", "--", os.fspath(folder)], check=False, stderr=subprocess.DEVNULL)
            if done.returncode:
                raise OSError(errno.ENOTEMPTY, "it cannot be removed", os.fspath(folder)) from None
