"""Configurations of runs from plain data, in processes that did not read the study."""

import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from itertools import chain
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.config.content import content_hash
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.config.structure import Structure, structure
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.model.common.plain import plain_bytes

Unpack = Callable[[Mapping[str, Any]], RunConfig]
"""Returns the configuration of a `RunData.parcel`; see `unpack`."""


def unpack(parcel: Mapping[str, Any], *, verify: bool = True) -> RunConfig:
    """Return the configuration of a `RunData.parcel`, in any process that sees the same files.

    Raises:
        InputErrors: a plugin or file is missing, or (with `verify`) a file has changed.
    """
    return structure(parcel["config"], Path(parcel["folder"]), parcel["sources"], verify=verify)


class Settings:
    """Structures settings of one run after another; what is as in the run before is not structured again."""

    def __init__(self, folder: Path, sources: Mapping[str, str]) -> None:
        """See `References` for the arguments."""
        self._folder, self._structure = folder, Structure(folder, sources)
        self._last: dict[str, tuple[bytes, list[tuple[Path, str]], Any]] = {}
        """Plain data, files and value of each setting."""

    def remember(self, plain: Mapping[str, Any], config: RunConfig) -> None:
        """Take the settings of a run that is structured already."""
        for name, value in plain.items():
            self._last[name] = plain_bytes(value), _located(self._folder, value), getattr(config, name)

    def __call__(self, plain: Mapping[str, Any]) -> dict[str, Any]:
        """Return settings of `RunConfig` by name, from plain data.

        Raises:
            InputErrors: what is wrong with one of them.
        """
        return {name: self._setting(name, value) for name, value in plain.items()}

    def _setting(self, name: str, plain: Any) -> Any:
        data = plain_bytes(plain)
        before, files, value = self._last.get(name, (b"", [], None))
        if data != before or any(content_hash(file) != sha256 for file, sha256 in files):
            value = self._structure.settings({name: plain})[name]
            self._last[name] = data, _located(self._folder, plain), value
        return value


class Unpacking:
    """Unpacks parcels that have most settings in common."""

    def __init__(self, first: Mapping[str, Any]) -> None:
        """Unpack the first parcel.

        Raises:
            InputErrors: see `unpack`.
        """
        self._origin = first["folder"], first["sources"], first["config"].keys()
        self.config = unpack(first)
        self._settings = Settings(Path(first["folder"]), first["sources"])
        self._settings.remember(first["config"], self.config)

    def __call__(self, parcel: Mapping[str, Any]) -> RunConfig:
        """Return the configuration of a parcel; see `unpack`. Only the settings that differ are structured."""
        if (parcel["folder"], parcel["sources"], parcel["config"].keys()) == self._origin:
            with suppress(InputErrors, InputError, ValueError, TypeError):  # then `unpack` says what is wrong
                return attrs.evolve(self.config, **self._settings(parcel["config"]))
        return unpack(parcel)


def _located(folder: Path, value: Any) -> list[tuple[Path, str]]:
    """The files in a configuration whose names begin at a folder, with the hashes of their content."""
    return [(Path(os.path.normpath(folder / name)), sha256) for name, sha256 in _files(value)]


def _files(value: Any) -> Iterator[tuple[str, str]]:
    """The names of the files in a configuration, with the hashes of their content."""
    if isinstance(value, Mapping):
        if set(value) == {"path", "sha256"}:
            yield value["path"], value["sha256"]
        else:
            yield from chain.from_iterable(map(_files, value.values()))
    elif isinstance(value, list):
        yield from chain.from_iterable(map(_files, value))
