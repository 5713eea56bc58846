"""Configuration values with the locations at which they were written.

Items are immutable and shared. A patch copies only the containers on its path, so a block that a thousand runs share is
one object and is checked once.
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
    """A location in a file, on the command line, or (no file) in a Python call."""

    file: Path | None = None
    line: int | None = None
    column: int | None = None

    def error(self, key: str, message: str, hint: str | None = None) -> InputError:
        """Return an error with this location; `key` is the dotted path of the wrong value."""
        text = f"{key}: {message}" if key else message
        return InputError(text, file=self.file, line=self.line, column=self.column, hint=hint)


@attrs.frozen(eq=False)
class Item:
    """A scalar, a dict of items or a list of items."""

    value: Any
    location: Location
    """Location of the value."""
    key: Location
    """Location of its key; the same as `location` for values without a key."""
    text: str | None = None
    """A scalar as its file spells it, which is its value where text is expected: `1.10`, `007`."""

    @property
    def data(self) -> Any:
        """The plain value."""
        if isinstance(self.value, dict):
            return {key: inner.data for key, inner in self.value.items()}
        if isinstance(self.value, list):
            return [inner.data for inner in self.value]
        return self.value


def from_document(document: Document, place: Location | None = None) -> Item:
    """Return the items of a file with their locations, or all with the location `place`."""

    def build(data: Any, steps: Steps) -> Item:
        location = place or Location(document.file, *document.mark(steps))
        value: Any = data
        if isinstance(data, dict):
            value = {key: build(inner, (*steps, key)) for key, inner in data.items()}
        elif isinstance(data, list):
            value = [build(inner, (*steps, index)) for index, inner in enumerate(data)]
        key = place or Location(document.file, *document.mark(steps, key=True))
        return Item(value, location, key, document.text(steps))

    return build(document.data, ())


def from_data(data: Any, location: Location) -> Item:
    """Return items that all have one location."""
    value = os.fspath(data) if isinstance(data, os.PathLike) else data
    if isinstance(data, Mapping):
        value = {str(key): from_data(inner, location) for key, inner in data.items()}
    elif isinstance(data, list | tuple):
        value = [from_data(inner, location) for inner in data]
    return Item(value, location, location)


def steps_of(key: str) -> tuple[str, ...]:
    """Return the steps of a dotted path, e.g. `planner.w` or `fleet.0.robot`."""
    return tuple(key.strip().split("."))


def patch(root: Item, key: str, new: Item) -> Item:
    """Return `root` with `new` at the dotted path `key`.

    A bare word on the path becomes its block (`eecbs` is `{plugin: eecbs}`), and missing blocks are added.

    Raises:
        InputError: the path leads into a number or past the end of a list; the location is that of `new`.
    """
    return _patch(root, steps_of(key), 0, new)


def look_up(root: Item, key: str) -> Item | None:
    """Return the item at a dotted path, or None."""
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
    """Return the key of a bare word in the block at `steps`."""
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
            first = ".".join((*steps[:depth], "0", *steps[depth:]))
            raise new.key.error(key, f"{'.'.join(steps[:depth])} is a list", f"give the index of an entry: {first}")
        if int(step) >= len(item.value):
            raise new.key.error(key, f"{'.'.join(steps[:depth])} has only {len(item.value)} entries, counted from 0")
        entries = list(item.value)
        entries[int(step)] = _patch(entries[int(step)], steps, depth + 1, new)
        return attrs.evolve(item, value=entries)
    raise new.key.error(key, f"{'.'.join(steps[:depth]) or 'the file'} is {item.value!r}, not a block")


def _is_index(step: str) -> bool:
    return step.isdecimal() and len(step) < 9
