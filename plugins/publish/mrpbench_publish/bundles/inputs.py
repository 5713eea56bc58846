"""The files that a study needs, as they are laid out in a bundle: relative names stay as they are."""

import fnmatch
import os
import re
import shutil
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import Any

import attrs

from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.store.run_files import digest
from mrpbench_publish.bundles.expected import Expected
from mrpbench_publish.bundles.opened import Opened
from mrpbench_publish.files.layout import INPUT_FOLDER

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
    left_out: Mapping[str, str]
    """SHA-256 of the files that are not in the bundle, by their names relative to the folder of the configuration."""


def collect_inputs(expected: Iterable[Expected], folder: Path, patterns: Sequence[str] = ()) -> Inputs:
    """Return the files of studies whose configurations are in `folder`, but for those whose names match patterns.

    Raises:
        InputErrors, InputError: some are not there, or a pattern matches none.
    """
    names = sorted({name for each in expected for name in each.files})
    depth = max((_height(name) for name in names), default=0)
    base = "/".join([_LEVEL] * depth)
    files = {f"{INPUT_FOLDER}/{os.path.normpath(PurePosixPath(base, name))}": folder / name for name in names}
    missing = [InputError("no such file", file=file) for file in files.values() if not file.is_file()]
    if missing:
        raise InputErrors(*missing)
    for pattern in patterns:
        if not fnmatch.filter(names, pattern):
            raise InputError(f"--leave-out {pattern} matches no input", hint="inputs: " + (", ".join(names) or "none"))
    left_out = {name for pattern in patterns for name in fnmatch.filter(names, pattern)}
    included = {place: file for (place, file), name in zip(files.items(), names, strict=True) if name not in left_out}
    return Inputs(
        files=included,
        names=frozenset(names),
        folder=base or ".",
        programs=frozenset(name for name, file in included.items() if os.access(file, os.X_OK)),
        left_out={name: digest(folder / name) for name in sorted(left_out)},
    )


def take_inputs(bundle: Opened, folder: Path | None) -> list[str]:
    """Copy the inputs that a bundle leaves out from `folder` into it, and return the names of those that are not there.

    Raises:
        InputError: a file of `folder` is not the one that was left out.
    """
    missing = []
    for name, sha256 in bundle.left_out.items():
        if folder is None or bundle.leaves_inputs(name) or not (folder / name).is_file():
            missing.append(name)
            continue
        if digest(folder / name) != sha256:
            raise InputError("is not the file that the bundle leaves out: its SHA-256 differs", file=folder / name)
        (bundle.folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(folder / name, bundle.folder / name)
    return missing


def full_names(value: Any, folder: Path) -> dict[str, str]:
    """Return the files that plain data give by their full names, with their names relative to `folder`."""
    if isinstance(value, Mapping):
        value = list(value.values())
    if isinstance(value, list | tuple):
        return {full: name for inner in value for full, name in full_names(inner, folder).items()}
    if not isinstance(value, str):
        return {}
    names = [value] if value.startswith("/") else _FULL_NAME.findall(value)
    return {full: Path(os.path.relpath(full, folder)).as_posix() for full in names if Path(full).is_file()}


def _height(name: str) -> int:
    """How many folders above its own a relative name goes."""
    parts = PurePosixPath(os.path.normpath(name)).parts
    return sum(part == ".." for part in parts)
