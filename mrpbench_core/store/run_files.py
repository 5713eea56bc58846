"""The files of a run on disk, and their SHA-256 in its record."""

import os
from collections.abc import Iterator, Mapping
from contextlib import suppress
from hashlib import file_digest
from pathlib import Path
from typing import Any

from mrpbench_core.files.errors import InputError
from mrpbench_core.store.paths import RunPaths


def seal(paths: RunPaths, *, recording: bool = True) -> list[str]:
    """Name the exports of a run, and its recording unless it is not kept.

    Returns:
        SHA-256 and name in the results folder of each file, as `sha256sum` writes and checks them.

    Raises:
        OSError: a file cannot be read.
    """
    files = [paths.recording] if recording and paths.recording.is_file() else []
    lines = [f"{digest(file)}  recordings/{file.name}" for file in files]
    exported = _files(paths.exports)
    return lines + [f"{digest(file)}  exports/{file.relative_to(paths.exports.parent)}" for file in exported]


def digest(file: Path) -> str:
    """Return the SHA-256 of a file."""
    with file.open("rb") as stream:
        return file_digest(stream, "sha256").hexdigest()


def names_files(record: Mapping[str, Any]) -> bool:
    """Tell whether a record names its files; without it, they have the names of the first attempt."""
    return isinstance((record.get("provenance") or {}).get("files"), list)


def check_recording(record: Mapping[str, Any], file: Path) -> None:
    """Check that a recording is the one that a record names; records of older versions name none.

    Raises:
        InputError: it is another one, or was changed.
    """
    expected = [line for line in _named(record) if line.endswith(f"  recordings/{file.name}")]
    if expected and file.is_file() and not expected[-1].startswith(digest(file)):
        raise InputError(
            "differs from the recording of the run: its SHA-256 is not the one in the record",
            file=file,
            hint="restore it, or repeat the run with --rerun all",
        )


def _named(record: Mapping[str, Any]) -> Iterator[str]:
    if names_files(record):
        yield from (line for line in record["provenance"]["files"] if isinstance(line, str))


def _files(folder: Path) -> list[Path]:
    """All files from a folder on, without symbolic links and whatever else a plugin left there.

    A line of a record cannot hold each name that a file may have: those that cannot be printed are left out, and so are
    those of paths that are too long.
    """
    files, waiting = [], [folder] if folder.is_dir() else []
    while waiting:  # `os.walk` calls itself for each level
        here = waiting.pop()
        with suppress(OSError), os.scandir(here) as entries:
            for entry in filter(lambda entry: entry.name.isprintable(), entries):
                if entry.is_dir(follow_symlinks=False):
                    waiting.append(here / entry.name)
                elif entry.is_file(follow_symlinks=False):
                    files.append(here / entry.name)
    return sorted(files)
