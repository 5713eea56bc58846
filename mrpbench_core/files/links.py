"""Symbolic links of paths that a user gives."""

import os
from pathlib import Path


def followed(path: Path | str) -> Path:
    """Return an absolute path without links. A loop of links remains; `Path.resolve` raises a RuntimeError for it."""
    return Path(os.path.realpath(path))
