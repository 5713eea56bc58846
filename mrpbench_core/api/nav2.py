"""Options with the names and defaults of Nav2, which a Nav2 parameter file may set."""

from collections.abc import Callable
from typing import Any, Literal, get_args, get_origin

import attrs

from mrpbench_core.api.component import bounded
from mrpbench_core.api.described import DescribedOption, kind_of, validator_of
from mrpbench_core.files.nav2 import Nav2Block


def parameter(default: Any, *, help: str, unit: str | None = None, validator: Callable[..., Any] | None = None) -> Any:
    """Declare an option, typed `... | None`, that is None unless the configuration sets it.

    If it is None, `settle` takes the value from the Nav2 parameter file, or else `default`.
    """
    shown = (
        "" if default is None else f" (default {default:g})" if isinstance(default, float) else f" (default {default})"
    )
    return attrs.field(
        default=None,
        validator=attrs.validators.optional(bounded(unit, validator)),
        metadata={"help": help + shown, "unit": unit, "nav2": default},
    )


def as_parameter(described: DescribedOption, *, unset: bool = False) -> tuple[Any, Any]:
    """Return the type and the field of an option that a library describes; with `unset` it has no default."""
    field = parameter(
        None if unset else described.default,
        help=described.help,
        unit=described.unit or None,
        validator=validator_of(described),
    )
    return kind_of(described) | None, field


def settle(
    options: Any, block: Nav2Block | None = None, prefix: str = "", of: type[Any] | None = None
) -> dict[str, Any]:
    """Return the values of all options declared with `parameter` in an attrs instance, by name.

    Args:
        options: the instance.
        block: parameters of a Nav2 file.
        prefix: put before each name in the file, e.g. `inflation_layer.`.
        of: base class of `options` whose options are returned; by default all.

    Raises:
        InputError: a value in the file has the wrong type, or the validator of the option refuses it.
    """
    values = {}
    for field in attrs.fields(of or type(options)):
        if "nav2" not in field.metadata:
            continue
        value = field.metadata["nav2"]
        if block is not None:
            name = prefix + field.name
            value = block.take(name, _kind(field.type), value)
            check_parameter(field, value, block, name)
        given = getattr(options, field.name)
        values[field.name] = value if given is None else given
    return values


def _kind(declared: Any) -> type:
    """Return the type that an option declared as `... | None` has in a file."""
    kind = next(kind for kind in get_args(declared) if kind is not type(None))
    origin = get_origin(kind)
    return str if origin is Literal else origin or kind


def check_parameter(field: Any, value: Any, block: Nav2Block, name: str) -> None:
    """Raise an InputError if the validator of an attrs field refuses the value of the parameter `name`."""
    if field.validator is None or value is None:
        return
    try:
        field.validator(None, field, value)
    except ValueError as error:
        raise block.error(str(error.args[0]), name) from None
