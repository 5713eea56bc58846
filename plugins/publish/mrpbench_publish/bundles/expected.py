"""The runs that an invocation describes, and the files that they need, found in a worker process."""

import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.config.canonical import relative, sources
from mrpbench_core.config.settings import FleetEntry
from mrpbench_core.config.study import RunPoint, load_study
from mrpbench_core.engine.loading.runs import StudyRuns, pack_study, unpack_study
from mrpbench_core.engine.processes.call import CallFailedError, call
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins.local import refuse_local

READING_S = 3600.0
"""Wall seconds that reading a configuration may take."""


@attrs.frozen(kw_only=True)
class Invocation:
    """What an invocation was asked to do."""

    study: Mapping[str, Any]
    overrides: tuple[str, ...] = ()
    name: str = "study"
    """Name of the study, which a configuration may leave to its file."""

    def document(self) -> dict[str, Any]:
        """Return the configuration, with its name."""
        return {**self.study, "name": self.name}


@attrs.frozen(kw_only=True)
class Expected:
    """The runs of an invocation."""

    study: StudyRuns
    files: tuple[str, ...]
    """Files that the runs need, relative to the folder of the configuration: named by it, read by components, and
    sources of local plugins."""


def expect(slots: str, invocation: Invocation, folder: Path, *, trusted: bool) -> Expected:
    """Read the configuration of an invocation in a worker of `slots`.

    Args:
        slots: see `slots_of_this_process`.
        invocation: what to read.
        folder: of the configuration.
        trusted: import local plugins; otherwise their runs are errors of the study.

    Raises:
        InputErrors, InputError: no run can be made of it.
    """
    try:
        packed = call(
            slots,
            packed_runs,
            invocation.document(),
            list(invocation.overrides),
            str(folder),
            trusted,
            limit_s=READING_S,
        )
    except CallFailedError as failure:
        raise InputError(f"the configuration cannot be read: {failure}") from failure
    return Expected(study=unpack_study(packed["study"]), files=tuple(packed["files"]))


def packed_runs(document: Mapping[str, Any], overrides: Sequence[str], folder: str, trusted: bool) -> dict[str, Any]:
    """Return the study of a configuration and the names of its files, as plain data."""
    if not trusted:
        refuse_local()
    os.chdir(folder)
    study = load_study(document, overrides)
    files = dict.fromkeys(name for point in study.runs for name in _files(point, Path(folder)))
    return {"study": pack_study(study), "files": list(files)}


def _files(point: RunPoint, folder: Path) -> Iterator[str]:
    yield from named_files(point.canonical)
    yield from sources(point.components, folder)
    readers: tuple[Component | FleetEntry, ...] = (*point.components, *point.config.fleet)
    for reader in readers:
        yield from (relative(file, folder) for file in reader.reads() if file.is_file())


def named_files(canonical: Any) -> Iterator[str]:
    """Yield the names of the files in a canonical configuration."""
    if isinstance(canonical, Mapping):
        if set(canonical) == {"path", "sha256"}:
            yield str(canonical["path"])
        else:
            for inner in canonical.values():
                yield from named_files(inner)
    elif isinstance(canonical, list | tuple):
        for inner in canonical:
            yield from named_files(inner)


def relocated(value: Any, names: Mapping[str, str]) -> Any:
    """Return plain data in which each text that is a full name of a file is replaced by its relative name."""
    if isinstance(value, Mapping):
        return {key: relocated(inner, names) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [relocated(inner, names) for inner in value]
    return names.get(value, value) if isinstance(value, str) else value
