"""Configurations of runs from plain data, in processes that did not read the study."""

import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from itertools import chain
from pathlib import Path
from typing import Any

from mrpbench_core.config.content import content_hash
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.config.structure import Structure, structure
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.model.common.plain import plain_bytes


def unpack(parcel: Mapping[str, Any], *, verify: bool = True) -> RunConfig:
    """Return the configuration of a `RunData.parcel`, in any process that sees the same files.

    Raises:
        InputErrors: a plugin or file is missing, or (with `verify`) a file has changed.
    """
    return structure(parcel["config"], Path(parcel["folder"]), parcel["sources"], verify=verify)


class Unpacking:
    """Unpacks one parcel after another; settings that are as in the one before are not structured again."""

    def __init__(self) -> None:
        self._origin: tuple[str, Mapping[str, str]] = "", {}
        self._structure: Structure
        self._last: dict[str, tuple[bytes, list[tuple[Path, str]], Any]] = {}
        """Plain data, files and value of each setting."""

    def __call__(self, parcel: Mapping[str, Any]) -> RunConfig:
        """Return the configuration of a parcel; see `unpack`."""
        with suppress(InputErrors, InputError, ValueError, TypeError):  # then `unpack` says what is wrong
            return RunConfig(**self.settings(parcel, parcel["config"]))
        return unpack(parcel)

    def settings(self, parcel: Mapping[str, Any], names: Iterable[str]) -> dict[str, Any]:
        """Return some settings of `RunConfig` by name, without the plugins of the others.

        Raises:
            InputErrors: what is wrong with one of them.
        """
        if self._origin != (parcel["folder"], parcel["sources"]):
            self._origin, self._last = (parcel["folder"], parcel["sources"]), {}
            self._structure = Structure(Path(parcel["folder"]), parcel["sources"])
        return {name: self._setting(name, parcel["config"][name]) for name in names}

    def _setting(self, name: str, plain: Any) -> Any:
        data = plain_bytes(plain)
        before, files, value = self._last.get(name, (b"", [], None))
        if data != before or any(content_hash(file) != sha256 for file, sha256 in files):
            value = self._structure.settings({name: plain})[name]
            self._last[name] = data, _located(Path(self._origin[0]), plain), value
        return value


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
