"""Options that carry Nav2's names and defaults, and that a Nav2 parameter file may set."""

from collections.abc import Callable
from typing import Any, Literal, get_args, get_origin

import attrs

from mrpbench_core.files.nav2 import Nav2Block


def parameter(default: Any, *, help: str, unit: str | None = None, validator: Callable[..., Any] | None = None) -> Any:
    """Declare an option, typed `... | None`, that is None unless a configuration names it.

    Its value is then the one in the Nav2 parameter file, if there is one that has it, or else `default`; see `settle`.
    """
    shown = (
        "" if default is None else f" (default {default:g})" if isinstance(default, float) else f" (default {default})"
    )
    return attrs.field(
        default=None,
        validator=None if validator is None else attrs.validators.optional(validator),
        metadata={"help": help + shown, "unit": unit, "nav2": default},
    )


def settle(
    options: Any, block: Nav2Block | None = None, prefix: str = "", of: type[Any] | None = None
) -> dict[str, Any]:
    """The values of all that was declared with `parameter` in an attrs instance, by name.

    Args:
        options: the instance.
        block: parameters of a Nav2 file.
        prefix: put before each name in the file, e.g. `inflation_layer.`.
        of: only what this class, which `options` derives from, declares.

    Raises:
        InputError: a value in the file is of a wrong kind or refused by the option's validator.
    """
    values = {}
    for field in attrs.fields(of or type(options)):
        if "nav2" not in field.metadata:
            continue
        value = field.metadata["nav2"]
        if block is not None:
            name = prefix + field.name
            value = block.take(name, _kind(field.type), value)
            _validate(options, field, value, block, name)
        given = getattr(options, field.name)
        values[field.name] = value if given is None else given
    return values


def _kind(declared: Any) -> type:
    """The type of values that an option declared as `... | None` takes in a file."""
    kind = next(kind for kind in get_args(declared) if kind is not type(None))
    origin = get_origin(kind)
    return str if origin is Literal else origin or kind


def _validate(options: Any, field: Any, value: Any, block: Nav2Block, name: str) -> None:
    if field.validator is None or value is None:
        return
    try:
        field.validator(options, field, value)
    except ValueError as error:
        raise block.error(str(error.args[0]), name) from None
