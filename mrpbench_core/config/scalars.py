"""Strict scalars: text is never converted into numbers, and numbers only into the text that spells them in a file."""

import enum
import math
from typing import Any, get_args

from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.model.common.units import quantity, sizes, whole_quantity


class Unfit(ValueError):  # noqa: N818 - a value that does not fit its type, on its way to a located error
    """A value is not of its type."""

    def __init__(self, message: str, hint: str | None = None) -> None:
        self.hint = hint
        super().__init__(message)


def scalar(value: Any, kind: Any, unit: str | None, text: str | None = None) -> Any:
    """Return `value` as the scalar type `kind` (bool, int, float or str).

    Args:
        value: the value.
        kind: the type.
        unit: the unit of a number.
        text: how a file spells the value. Names keep that spelling, with and without quotes: `1.10`, `007`.

    Raises:
        Unfit: it has another type.
    """
    if kind is float:
        return _number(value, unit)
    if kind is int and unit is not None and isinstance(value, str):
        return _with_unit(whole_quantity, value, unit)
    if type(value) is kind:
        return value
    if kind is str and text is not None:
        return text
    raise Unfit(f"expected {describe(kind, unit)}, got {show(value)}")


def literal(value: Any, kind: Any) -> Any:
    """Return `value`, one of the values of a `Literal`."""
    choices = get_args(kind)
    if any(value == choice and type(value) is type(choice) for choice in choices):
        return value
    raise _not_among(value, [str(choice) for choice in choices])


def member(value: Any, kind: type[enum.Enum]) -> enum.Enum:
    """Return the member of an enumeration whose value is `value`."""
    for choice in kind:
        if choice.value == value and not isinstance(value, bool):
            return choice
    raise _not_among(value, [str(choice.value) for choice in kind])


def describe(kind: Any, unit: str | None = None) -> str:
    """Return the description of a type in an error."""
    of = f" of {unit} such as '1 {list(sizes(unit))[-1]}'" if unit else ""
    names = {bool: "true or false", int: "a whole number" + of, float: "a number" + of, str: "text"}
    return names[kind] if kind in names else str(getattr(kind, "__name__", kind))


def show(value: Any) -> str:
    """Return the description of a value in an error."""
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict | list):
        return "a block" if isinstance(value, dict) else "a list"
    return repr(value)


def _number(value: Any, unit: str | None) -> float:
    if isinstance(value, str) and value in (
        ".inf",
        "-.inf",
    ):  # canonical configurations write infinity so, because JSON has none
        return math.inf if value == ".inf" else -math.inf
    if isinstance(value, str) and unit is not None:
        return float(_with_unit(quantity, value, unit))
    if not isinstance(value, int | float) or isinstance(value, bool) or value != value:
        raise Unfit(f"expected {describe(float, unit)}, got {show(value)}")
    try:
        return float(value)
    except OverflowError:
        raise Unfit(f"{value} is too large") from None


def _with_unit(read: Any, text: str, unit: str) -> Any:
    try:
        return read(text, unit)
    except ValueError as error:
        raise Unfit(str(error)) from None


def _not_among(value: Any, choices: list[str]) -> Unfit:
    return Unfit(f"{show(value)} is not one of {', '.join(choices)}", did_you_mean(str(value), choices))
