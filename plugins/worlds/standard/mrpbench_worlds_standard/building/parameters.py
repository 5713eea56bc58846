"""Typed parameters of a building file: `name: [type, value]` with type 1 text, 2 int, 3 double, 4 bool."""

from collections.abc import Mapping
from typing import Any

from mrpbench_worlds_standard.building.node import Node
from mrpbench_worlds_standard.building.notes import Notes

Kind = type[str] | type[int] | type[float] | type[bool]

_TYPES: dict[int, Kind] = {1: str, 2: int, 3: float, 4: bool}
_WORDS = {str: "text [1, …]", int: "an int [2, …]", float: "a double [3, …]", bool: "a bool [4, …]"}


def read_parameters(node: Node, known: Mapping[str, Kind], owner: str, notes: Notes) -> dict[str, Any]:
    """Return the values by name. Unknown parameters and types are noted; a parameter of unknown type is left out.

    Args:
        node: the mapping.
        known: the parameters of this kind of thing and their types.
        owner: the kind of thing that has the parameters, for notes: `lane`, `vertex`, ...
        notes: receives the notes.

    Raises:
        InputError: a parameter is not a pair, or its value is not of its type.
    """
    values = {}
    for name, pair in node.fields().items():
        items = pair.items()
        if len(items) != 2:
            raise pair.error(f"{owner} parameter {name!r} should be [type, value]")
        stated = items[0].integer()
        if stated not in _TYPES:
            notes.add(f"{owner} parameter {name!r} has the unknown type {stated} and is ignored")
            continue
        if name not in known:
            notes.add(f"{owner} parameter {name!r} is not known and has no effect")
        values[name] = _convert(items[1], known.get(name, _TYPES[stated]), f"{owner} parameter {name!r}")
    return values


def _convert(node: Node, kind: Kind, what: str) -> Any:
    value = node.value
    if kind is str and not isinstance(value, dict | list):
        return node.text()
    if kind is bool and value in (True, False):  # 0 and 1 too: files of early editors
        return bool(value)
    if kind is int and isinstance(value, int) and not isinstance(value, bool):
        return value
    if kind is float and isinstance(value, int | float) and not isinstance(value, bool):
        return node.number()
    raise node.error(f"{what} should be {_WORDS[kind]}, not {value!r}")
