"""The `matrix` of a study: which options vary, and how they combine into single configurations.

    matrix:
      planner: [astar, {plugin: ecbs, w: 1.2}]     # a key replaces the whole block
      scenario.robots: [5, 9]                      # a dotted key patches one option
      seed: 0..53                                  # both ends included
      "noise.lidar, noise.odometry": [[0, 0], [0.01, 0.02]]    # several names are zipped
      exclude: [{planner: astar, scenario.robots: 9}]          # removes the points that match an entry
      include: [{planner: cbs, seed: 0..3}]                    # adds points to the product

Points come in reading order: the last axis varies fastest, and included points come last. `exclude` compares the values
as written, without defaults.
"""

import itertools
import math
import re
from collections.abc import Iterator, Sequence
from typing import Any

import attrs

from mrpbench_core.config.items import Item, look_up, main_key, patch, steps_of
from mrpbench_core.config.settings import NOT_IDENTIFYING, RunConfig
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.files.suggestions import suggest

POINT_LIMIT = 1_000_000
_RANGE = re.compile(r"(-?[0-9]{1,18})\.\.(-?[0-9]{1,18})")


@attrs.frozen
class Axis:
    """Values of one key, or of several that vary together."""

    names: tuple[str, ...]
    rows: Sequence[tuple[Item, ...]]


@attrs.frozen
class Point:
    """One configuration of a study, not yet structured."""

    root: Item
    axes: dict[str, Any]
    """Plain value of each key that varies."""
    fault: InputError | None = None
    """The reason why the configuration cannot be combined."""

    @property
    def label(self) -> str:
        """A short description of the point."""
        return ", ".join(f"{name}={_brief(value)}" for name, value in self.axes.items()) or "the only run"


@attrs.frozen
class Matrix:
    """A parsed `matrix` block."""

    axes: tuple[Axis, ...] = ()
    include: tuple[tuple[Axis, ...], ...] = ()
    exclude: tuple[Item, ...] = ()

    def replaced(self, overrides: Sequence[Axis]) -> "Matrix":
        """Return this matrix without the axes (or columns of zipped axes) that overrides replace."""
        overridden = {name for axis in overrides for name in axis.names}
        axes = (_without(axis, overridden) for axis in self.axes)
        include = (tuple(axis for axis in entry if not overridden & set(axis.names)) for entry in self.include)
        return Matrix(tuple(axis for axis in axes if axis.names), tuple(include), self.exclude)

    def points(self, root: Item, overrides: Sequence[Axis] = ()) -> Iterator[Point]:
        """Yield every point of the matrix over the configuration `root`, with `overrides` as further axes.

        Raises:
            InputErrors: there are too many.
        """
        matrix = self.replaced(overrides)
        blocks = [matrix.axes] if self.axes or not self.include else []
        blocks += matrix.include
        size = sum(math.prod(len(axis.rows) for axis in (*block, *overrides)) for block in blocks)
        if size > POINT_LIMIT:
            raise InputErrors(
                root.location.error("matrix", f"describes {size} runs; at most {POINT_LIMIT} are allowed")
            )
        varying = _varying([(*block, *overrides) for block in blocks])
        for block in blocks:
            for point in _product(root, (*block, *overrides), varying):
                if not any(matches(point.root, entry) for entry in self.exclude):
                    yield point


def parse_matrix(item: Item) -> Matrix:
    """Read a `matrix` block.

    Raises:
        InputErrors: all that is wrong with it.
    """
    if not isinstance(item.value, dict):
        raise InputErrors(item.location.error("matrix", "expected a block of keys and lists of their values"))
    axes: list[Axis] = []
    include: list[tuple[Axis, ...]] = []
    exclude: list[Item] = []
    errors: list[InputError] = []
    for name, inner in item.value.items():
        try:
            if name == "include":
                include = [_included(entry) for entry in _entries(inner, name)]
            elif name == "exclude":
                exclude = _entries(inner, name)
            else:
                axes.append(_axis(name, inner, {known for axis in axes for known in axis.names}))
        except InputErrors as several:
            errors += several.errors
    if errors:
        raise InputErrors(*errors)
    return Matrix(tuple(axes), tuple(include), tuple(exclude))


def integers(text: Any) -> range | None:
    """Return the integers of a range `a..b`, both included, or None if the text is not a range."""
    match = _RANGE.fullmatch(text) if isinstance(text, str) else None
    return range(int(match[1]), int(match[2]) + 1) if match else None


def rows_of(item: Item, name: str) -> Sequence[tuple[Item, ...]] | None:
    """Return the values that a range gives to one key, or None if `item` is not a range.

    Raises:
        InputErrors: the range is empty or too long.
    """
    numbers = integers(item.value)
    if numbers is None:
        return None
    if not numbers:
        raise InputErrors(item.location.error(name, f"the range {item.value} is empty"))
    if len(numbers) > POINT_LIMIT:
        raise InputErrors(item.location.error(name, f"the range {item.value} has more than {POINT_LIMIT} values"))
    return [(attrs.evolve(item, value=number),) for number in numbers]


def check_name(item: Item, name: str) -> None:
    """Refuse to vary a key that does not exist or does not distinguish runs.

    Raises:
        InputErrors: the error has the location of the key.
    """
    first = steps_of(name)[0]
    if first not in attrs.fields_dict(RunConfig):
        raise InputErrors(item.key.error(name, "unknown key", suggest(first, attrs.fields_dict(RunConfig))))
    if any(name == fixed or name.startswith(fixed + ".") for fixed in NOT_IDENTIFYING):
        raise InputErrors(item.key.error(name, "cannot vary: it does not change what a run does"))


def matches(root: Item, entry: Item) -> bool:
    """Tell whether a configuration has all the values of an `exclude` entry."""
    return all(_has(root, name, wanted) for name, wanted in entry.value.items())


def _axis(name: str, item: Item, taken: set[str]) -> Axis:
    names = tuple(part.strip() for part in name.split(","))
    for part in names:
        check_name(item, part)
        if part in taken or names.count(part) > 1:
            raise InputErrors(item.key.error(part, "varies twice"))
    if len(names) == 1 and (rows := rows_of(item, name)) is not None:
        return Axis(names, rows)
    if not isinstance(item.value, list) or not item.value:
        raise InputErrors(item.location.error(name, "expected a list of values, or a range a..b of integers"))
    if len(names) == 1:
        return Axis(names, [(_keyed(value, item),) for value in item.value])
    for row in item.value:
        if not isinstance(row.value, list) or len(row.value) != len(names):
            raise InputErrors(row.location.error(name, f"expected a list of {len(names)} values, one for each name"))
    return Axis(names, [tuple(_keyed(value, item) for value in row.value) for row in item.value])


def _entries(item: Item, name: str) -> list[Item]:
    entries = item.value if isinstance(item.value, list) else [item]
    errors = []
    for entry in entries:
        if not isinstance(entry.value, dict) or not entry.value:
            errors.append(entry.location.error(f"matrix.{name}", "expected a list of blocks of keys and values"))
            continue
        for key, inner in entry.value.items():
            try:
                check_name(inner, key)
            except InputErrors as several:
                errors += several.errors
    if errors:
        raise InputErrors(*errors)
    return list(entries)


def _included(entry: Item) -> tuple[Axis, ...]:
    return tuple(Axis((name,), rows_of(inner, name) or [(inner,)]) for name, inner in entry.value.items())


def _keyed(value: Item, axis: Item) -> Item:
    """Return a value of an axis whose key has the location of the axis."""
    return attrs.evolve(value, key=axis.key)


def _without(axis: Axis, overridden: set[str]) -> Axis:
    remaining = [index for index, name in enumerate(axis.names) if name not in overridden]
    if len(remaining) == len(axis.names):
        return axis
    return Axis(tuple(axis.names[i] for i in remaining), [tuple(row[i] for i in remaining) for row in axis.rows])


def _varying(blocks: Sequence[tuple[Axis, ...]]) -> set[str]:
    """Return the names that distinguish points: those with several values or not in all blocks."""
    rows: dict[str, int] = {}
    for block in blocks:
        for axis in block:
            for name in axis.names:
                rows[name] = rows.get(name, 0) + len(axis.rows)
    return {name for name, count in rows.items() if count > 1 or len(blocks) > 1}


def _product(root: Item, axes: Sequence[Axis], varying: set[str]) -> Iterator[Point]:
    names = [name for axis in axes for name in axis.names]
    # A whole block is set before its options are patched, in any reading order.
    order = sorted(range(len(names)), key=lambda index: len(steps_of(names[index])))
    for rows in itertools.product(*(axis.rows for axis in axes)):
        values = [item for row in rows for item in row]
        patched, fault = root, None
        try:
            for index in order:
                patched = patch(patched, names[index], values[index])
        except InputError as error:
            fault = error
        label = {name: item.data for name, item in zip(names, values, strict=True) if name in varying}
        yield Point(patched, label, fault)


def _has(root: Item, name: str, wanted: Item) -> bool:
    node = look_up(root, name)
    if node is None:
        return False
    numbers = integers(wanted.value)
    if numbers is not None:
        return type(node.value) is int and node.value in numbers
    main = main_key(steps_of(name))
    one, other = _block(node.data, main), _block(wanted.data, main)
    return bool(one == other and isinstance(one, bool) == isinstance(other, bool))


def _block(data: Any, main: str) -> Any:
    """Return a bare word as its block; any key will do, because only equality counts."""
    return {main: data} if isinstance(data, str) else data


def _brief(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_brief(inner)}" for key, inner in value.items()) + "}"
    return str(value)
