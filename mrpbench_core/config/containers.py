"""Structure what holds other values: unions, lists, tuples and mappings.

Each function takes `read`, which structures one inner value.
"""

import types
import typing
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Literal, NamedTuple

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.config.items import Item
from mrpbench_core.config.references import is_yaml_file
from mrpbench_core.config.scalars import Unfit, describe, show
from mrpbench_core.files.errors import InputError, InputErrors


class Expected(NamedTuple):
    """The type that a configuration must have at some key."""

    kind: Any
    """A type, as an annotation writes it."""
    unit: str | None = None
    """SI unit of a number."""
    default: str | None = None
    """Plugin of a block that names none."""


Read = Callable[[Item, Expected, str], Any]
"""Structures an item of the expected type at a dotted key; raises InputErrors or Unfit."""


def union(read: Read, item: Item, expected: Expected, key: str) -> Any:
    """Return the item as the first member of a union that it fits; `none` and nothing are None where allowed."""
    arguments = typing.get_args(expected.kind)
    members = [member for member in arguments if member is not types.NoneType]
    optional = len(members) < len(arguments)
    if optional and (item.value is None or (item.value == "none" and not _takes_text(members))):
        return None
    if isinstance(item.value, str) and str in members and Path in members:
        members.remove(str if is_yaml_file(item.value) else Path)
    if len(members) == 1:
        return read(item, expected._replace(kind=members[0]), key)
    members.sort(key=lambda member: (member is not type(item.value), member is str))  # every scalar fits text
    failures = []
    for choice in members:
        try:
            return read(item, expected._replace(kind=choice), key)
        except InputErrors as errors:
            failures.append((choice, errors))
    fitting = [errors for choice, errors in failures if _holds(choice, type(item.value))]
    if len(fitting) == 1:
        raise fitting[0]
    choices = " or ".join(_describe_choice(choice, expected.unit) for choice in members)
    raise Unfit(f"expected {choices}, got {show(item.value)}")


def sequence(read: Read, item: Item, expected: Expected, key: str) -> Any:
    """Return a list as a tuple or frozenset; a single block needs no list around it."""
    origin, arguments = typing.get_origin(expected.kind), typing.get_args(expected.kind)
    many = origin is not tuple or arguments[-1:] == (...,)
    entries = item.value
    if many and not isinstance(entries, list) and is_block(arguments[0]) and isinstance(entries, str | dict):
        entries = [item]
    if not isinstance(entries, list):
        raise Unfit(f"expected a list, got {show(item.value)}")
    if not many and len(entries) != len(arguments):
        raise Unfit(f"expected {len(arguments)} entries, got {len(entries)}")
    kinds = [arguments[0]] * len(entries) if many else list(arguments)
    parts = [
        (entry, Expected(kind, expected.unit), key if entry is item else f"{key}.{index}")
        for index, (entry, kind) in enumerate(zip(entries, kinds, strict=True))
    ]
    values = _collect(read, parts)
    return tuple(values) if origin is tuple else frozenset(values)


def mapping(read: Read, item: Item, expected: Expected, key: str) -> dict[str, Any]:
    """Return a block as a dict."""
    _, inner = typing.get_args(expected.kind) or (str, Any)
    if not isinstance(item.value, dict):
        raise Unfit(f"expected a block, got {show(item.value)}")
    parts = [(entry, Expected(inner, expected.unit), f"{key}.{name}") for name, entry in item.value.items()]
    return dict(zip(item.value, _collect(read, parts), strict=True))


def is_block(kind: Any) -> bool:
    """Tell whether values of a type are written as blocks."""
    return isinstance(kind, type) and (issubclass(kind, Component) or attrs.has(kind))


def _collect(read: Read, parts: Sequence[tuple[Item, Expected, str]]) -> list[Any]:
    """Structure each part; raise the errors of all parts together."""
    values: list[Any] = []
    errors: list[InputError] = []
    for part in parts:
        try:
            values.append(read(*part))
        except InputErrors as several:
            errors += several.errors
    if errors:
        raise InputErrors(*errors)
    return values


def _takes_text(members: list[Any]) -> bool:
    return any(member is str or "none" in typing.get_args(member) for member in members)


def _holds(kind: Any, container: type) -> bool:
    """Tell whether values of `kind` are written as a dict or list."""
    if container is dict:
        return is_block(kind)
    return container is list and typing.get_origin(kind) in (tuple, frozenset)


def _describe_choice(kind: Any, unit: str | None) -> str:
    if typing.get_origin(kind) is Literal:
        return " or ".join(str(choice) for choice in typing.get_args(kind))
    if typing.get_origin(kind) is tuple:
        return "a list"
    return "a block" if is_block(kind) else describe(kind, unit)
