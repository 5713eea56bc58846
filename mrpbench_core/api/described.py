"""Options that a library describes, e.g. `mrpbench_native`: the fields of a component follow from the descriptions."""

import inspect
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Literal, Protocol, TypeVar

import attrs

from mrpbench_core.api.component import option

C = TypeVar("C")
_TYPES: dict[str, type[Any]] = {"bool": bool, "int": int, "float": float, "str": str}


class DescribedOption(Protocol):
    """The description of one option."""

    @property
    def name(self) -> str:
        """The word that sets it."""

    @property
    def type(self) -> Literal["bool", "int", "float", "str"]:
        """Its type; `str` with `choices` for a choice."""

    @property
    def optional(self) -> bool:
        """It may be None."""

    @property
    def default(self) -> bool | int | float | str | None:
        """Its value unless it is set."""

    @property
    def least(self) -> float | None:
        """Of numbers, None if unbounded."""

    @property
    def above(self) -> bool:
        """`least` itself is excluded."""

    @property
    def most(self) -> float | None:
        """Of numbers, None if unbounded."""

    @property
    def usual(self) -> tuple[float, float] | None:
        """Of numbers, from where to where a search looks for better values; the metadata of the field hold it."""

    @property
    def unit(self) -> str:
        """Of numbers, an empty text if none."""

    @property
    def choices(self) -> Sequence[str]:
        """The words it may be; empty for other types."""

    @property
    def help(self) -> str:
        """One sentence, without a full stop."""

    @property
    def paper(self) -> str:
        """Short citation, or an empty text."""


D = TypeVar("D", bound=DescribedOption)
Declare = Callable[[D], tuple[Any, Any]]
"""Returns the type and the attrs field of an option."""


def option_type(described: DescribedOption) -> Any:
    """Return the Python type of the values of an option, without None."""
    return Literal[tuple(described.choices)] if described.choices else _TYPES[described.type]


def validator_of(described: DescribedOption) -> Any:
    """Return an attrs validator for the values of an option, without None, or None if all are allowed."""
    if described.choices:
        return attrs.validators.in_(tuple(described.choices))
    kind = _TYPES[described.type]
    bounds: list[Any] = []
    if described.least is not None:
        least = kind(described.least)
        bounds.append(attrs.validators.gt(least) if described.above else attrs.validators.ge(least))
    if described.most is not None:
        bounds.append(attrs.validators.le(kind(described.most)))
    return attrs.validators.and_(*bounds) if len(bounds) > 1 else bounds[0] if bounds else None


def as_option(described: DescribedOption) -> tuple[Any, Any]:
    """Return the type and the field of an option of a component."""
    kind, validator = option_type(described), validator_of(described)
    if described.optional:
        kind, validator = kind | None, validator and attrs.validators.optional(validator)
    paper = f" ({described.paper})" if described.paper else ""
    return kind, option(
        described.default, help=f"{described.help}{paper}", unit=described.unit or None, validator=validator
    )


def described(rows: Iterable[D], declare: Declare[D] = as_option) -> Callable[[type[C]], type[C]]:
    """Give a class a field for each option, before its own; `@attrs.frozen(...)` goes above this decorator."""

    def decorate(cls: type[C]) -> type[C]:
        annotations = {}
        for row in rows:
            annotations[row.name], field = declare(row)
            field.metadata["usual"] = row.usual
            setattr(cls, row.name, field)
        cls.__annotations__ = annotations | inspect.get_annotations(cls)
        return cls

    return decorate
