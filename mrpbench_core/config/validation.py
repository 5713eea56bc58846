"""Call the validators of single fields, so that all invalid values are reported, not only the first."""

import contextlib
from typing import Any

import attrs

from mrpbench_core.files.errors import InputError


def stand_in_of(cls: type[Any]) -> Any:
    """Return an instance with defaults only, for validators that run before the real instance exists."""
    instance = object.__new__(cls)
    for field in attrs.fields(cls):
        with contextlib.suppress(Exception):  # a factory is code of a plugin; it is called again for the real instance
            if (default := default_of(field, instance)) is not attrs.NOTHING:
                object.__setattr__(instance, field.name, default)
    return instance


def default_of(field: Any, owner: Any) -> Any:
    """Return the default of a field of `owner`, or `attrs.NOTHING`."""
    default = field.default
    if isinstance(default, attrs.Factory):  # type: ignore[arg-type]
        return default.factory(owner) if default.takes_self else default.factory()
    return default


def fault_of(instance: Any, field: Any, value: Any) -> tuple[str, str | None] | None:
    """Return the validator's message about an invalid value with a hint, or None."""
    if field.validator is None or field.converter is not None:
        return None  # the converted value is validated with the whole instance
    try:
        field.validator(instance, field, value)
    except AttributeError:
        return None  # it reads a field that is itself invalid
    except InputError as error:
        return error.message, error.hint
    except Exception as error:  # noqa: BLE001 - a plugin's own code
        return words_of(error), None
    return None


def words_of(error: Exception) -> str:
    """Return the message of a validator; those of attrs have further arguments."""
    text = error.args[0] if error.args and isinstance(error.args[0], str) else str(error)
    return " ".join(text.split()) or type(error).__name__
