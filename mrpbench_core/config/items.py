"""Configuration values that remember where they were written, also after the matrix has put them together anew.

Items are immutable and shared: a patch copies only what lies on its path, so that a block that a thousand runs have in
common is one object, checked once.
"""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.yaml import Document, Steps

COMMAND_LINE = Path("command line")


@attrs.frozen
class Location:
    """A place in a file, or on the command line, or (no file) in a Python call."""

    file: Path | None = None
    line: int | None = None
    column: int | None = None

    def error(self, key: str, message: str, hint: str | None = None) -> InputError:
        """An error here; `key` is the dotted path of what is wrong."""
        text = f"{key}: {message}" if key else message
        return InputError(text, file=self.file, line=self.line, column=self.column, hint=hint)


@attrs.frozen(eq=False)
class Item:
    """A scalar, a dict of items or a list of items."""

    value: Any
    location: Location
    """Of the value."""
    key: Location
    """Of its key; the same as `location` for values without one."""

    @property
    def data(self) -> Any:
        """The plain value."""
        if isinstance(self.value, dict):
            return {key: inner.data for key, inner in self.value.items()}
        if isinstance(self.value, list):
            return [inner.data for inner in self.value]
        return self.value


def from_document(document: Document) -> Item:
    """Items with the marks of a file."""

    def build(data: Any, steps: Steps) -> Item:
        location = Location(document.file, *document.mark(steps))
        value: Any = data
        if isinstance(data, dict):
            value = {key: build(inner, (*steps, key)) for key, inner in data.items()}
        elif isinstance(data, list):
            value = [build(inner, (*steps, index)) for index, inner in enumerate(data)]
        return Item(value, location, Location(document.file, *document.mark(steps, key=True)))

    return build(document.data, ())


def from_data(data: Any, location: Location) -> Item:
    """Items that all stand in one place."""
    value = os.fspath(data) if isinstance(data, os.PathLike) else data
    if isinstance(data, Mapping):
        value = {str(key): from_data(inner, location) for key, inner in data.items()}
    elif isinstance(data, list | tuple):
        value = [from_data(inner, location) for inner in data]
    return Item(value, location, location)


def steps_of(key: str) -> tuple[str, ...]:
    """The steps of a dotted path, e.g. `planner.w` or `fleet.0.robot`."""
    return tuple(key.strip().split("."))


def patch(root: Item, key: str, new: Item) -> Item:
    """`root` with `new` at the dotted path `key`.

    A bare word on the path becomes its block (`eecbs` is `{plugin: eecbs}`), and blocks that are missing are made.

    Raises:
        InputError: located at `new`; the path leads into a number or past the end of a list.
    """
    return _patch(root, steps_of(key), 0, new)


def look_up(root: Item, key: str) -> Item | None:
    """The item at a dotted path, or None."""
    item = root
    steps = steps_of(key)
    for depth, step in enumerate(steps):
        item = _as_block(item, steps[:depth])
        if isinstance(item.value, dict) and step in item.value:
            item = item.value[step]
        elif isinstance(item.value, list) and _is_index(step) and int(step) < len(item.value):
            item = item.value[int(step)]
        else:
            return None
    return item


def main_key(steps: tuple[str, ...]) -> str:
    """The key that a bare word stands for in the block at `steps`."""
    return "robot" if steps[:1] == ("fleet",) else "plugin"


def _as_block(item: Item, steps: tuple[str, ...]) -> Item:
    if steps and isinstance(item.value, str):
        return Item({main_key(steps): item}, item.location, item.key)
    return item


def _patch(item: Item, steps: tuple[str, ...], depth: int, new: Item) -> Item:
    if depth == len(steps):
        return new
    key, step = ".".join(steps), steps[depth]
    item = _as_block(item, steps[:depth])
    if isinstance(item.value, dict):
        inner = item.value.get(step) or Item({}, new.location, new.key)
        return attrs.evolve(item, value={**item.value, step: _patch(inner, steps, depth + 1, new)})
    if isinstance(item.value, list):
        if not _is_index(step):
            raise new.key.error(
                key, f"{'.'.join(steps[:depth])} is a list", f"number its entries: {_numbered(steps, depth)}"
            )
        if int(step) >= len(item.value):
            raise new.key.error(key, f"{'.'.join(steps[:depth])} has only {len(item.value)} entries, counted from 0")
        entries = list(item.value)
        entries[int(step)] = _patch(entries[int(step)], steps, depth + 1, new)
        return attrs.evolve(item, value=entries)
    raise new.key.error(key, f"{'.'.join(steps[:depth]) or 'the file'} is not a block but {item.value!r}")


def _is_index(step: str) -> bool:
    return step.isdecimal() and len(step) < 9


def _numbered(steps: tuple[str, ...], depth: int) -> str:
    return ".".join((*steps[:depth], "0", *steps[depth:]))
