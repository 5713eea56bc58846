"""`key=value` on the command line: dotted paths as in a matrix, which override the file."""

from collections.abc import Sequence

import attrs

from mrpbench_core.config.items import COMMAND_LINE, Item, Location, from_document
from mrpbench_core.config.matrix import Axis, Matrix, check_name, rows_of
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.files.yaml import loads

LISTS = {"fleet", "metrics", "export"}
"""Settings whose value is itself a list."""


def parse_overrides(texts: Sequence[str], matrix: Matrix) -> tuple[Axis, ...]:
    """Return each override as an axis, which has one value unless it is a range or a list of values.

    A list contains values to vary if the file has an axis of that name or the key takes no list, as in
    `planner=[cbs, ecbs]`; otherwise the list is the value.

    Raises:
        InputErrors: all errors in them, with the location `command line`.
    """
    varied = {name for axis in matrix.axes for name in axis.names}
    axes: list[Axis] = []
    errors: list[InputError] = []
    for text in texts:
        try:
            axis = _parse(text, varied)
            if any(axis.names == other.names for other in axes):
                raise InputErrors(Location(COMMAND_LINE).error(axis.names[0], "given twice"))
            axes.append(axis)
        except InputErrors as several:
            errors += several.errors
    if errors:
        raise InputErrors(*errors)
    return tuple(axes)


def _parse(text: str, varied: set[str]) -> Axis:
    location = Location(COMMAND_LINE)
    name, equals, written = text.partition("=")
    name = name.strip()
    if not equals or not name:
        raise InputErrors(location.error("", f"expected key=value, got {text!r}"))
    try:
        item = from_document(loads(written), location) if written.strip() else Item("", location, location)
    except InputError as error:
        raise InputErrors(location.error(name, error.message, error.hint)) from None
    if name.partition(".")[0] == "matrix":
        raise InputErrors(location.error(name, "cannot be overridden", "override the keys that it varies"))
    rows = rows_of(item, name)
    if rows is None and isinstance(item.value, list) and item.value and (name in varied or _takes_no_list(name)):
        rows = [(value,) for value in item.value]
    if rows is None:
        rows = [(item,)]
    if len(rows) > 1:
        check_name(item, name)
    return Axis((name,), rows)


def _takes_no_list(name: str) -> bool:
    return name in attrs.fields_dict(RunConfig) and name not in LISTS
