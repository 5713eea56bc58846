"""The files that a study needs, as they are laid out in a bundle: relative names stay as they are."""

import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path, PurePosixPath
from typing import Any

import attrs

from mrpbench_core.engine.bundles.expected import Expected
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.store.bundle.layout import INPUT_FOLDER

_FULL_NAME = re.compile(r"""(?<![\w.])/[^\s,{}\[\]"']+""")
_LEVEL = "_"
"""Name of the folders above that of the configuration."""


@attrs.frozen(kw_only=True)
class Inputs:
    """Files of a study in a bundle."""

    files: Mapping[str, Path]
    """Place of each file by its name in the bundle."""
    names: frozenset[str]
    """Names relative to the folder of the configuration."""
    folder: str
    """The folder of the configuration, relative to that of the inputs."""
    programs: frozenset[str]
    """Names in the bundle of those that are executable."""


def collect_inputs(expected: Iterable[Expected], folder: Path) -> Inputs:
    """Return the files of studies whose configurations are in `folder`.

    Raises:
        InputErrors: some are not there.
    """
    names = sorted({name for each in expected for name in each.files})
    depth = max((_height(name) for name in names), default=0)
    base = "/".join([_LEVEL] * depth)
    files = {f"{INPUT_FOLDER}/{os.path.normpath(PurePosixPath(base, name))}": folder / name for name in names}
    missing = [InputError("no such file", file=file) for file in files.values() if not file.is_file()]
    if missing:
        raise InputErrors(*missing)
    programs = frozenset(name for name, file in files.items() if os.access(file, os.X_OK))
    return Inputs(files=files, names=frozenset(names), folder=base or ".", programs=programs)


def full_names(value: Any, folder: Path) -> dict[str, str]:
    """Return the files that plain data give by their full names, with their names relative to `folder`."""
    if isinstance(value, Mapping):
        value = list(value.values())
    if isinstance(value, list | tuple):
        return {full: name for inner in value for full, name in full_names(inner, folder).items()}
    if not isinstance(value, str):
        return {}
    found = [value] if value.startswith("/") else _FULL_NAME.findall(value)
    return {full: Path(os.path.relpath(full, folder)).as_posix() for full in found if Path(full).is_file()}


def _height(name: str) -> int:
    """How many folders above its own a relative name goes."""
    parts = PurePosixPath(os.path.normpath(name)).parts
    return sum(part == ".." for part in parts)
