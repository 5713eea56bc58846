"""Asks the validators of single fields, so that every bad value is reported and not only the first."""

import contextlib
from typing import Any

import attrs

from mrpbench_core.files.errors import InputError


def stand_in_of(cls: type[Any]) -> Any:
    """An instance with its defaults only, which validators may look at before the real one can be made."""
    instance = object.__new__(cls)
    for field in attrs.fields(cls):
        with contextlib.suppress(Exception):  # a factory is a plugin's own code; it is called again for the real one
            if (default := default_of(field, instance)) is not attrs.NOTHING:
                object.__setattr__(instance, field.name, default)
    return instance


def default_of(field: Any, owner: Any) -> Any:
    """The default of a field of `owner`, or `attrs.NOTHING`."""
    default = field.default
    if isinstance(default, attrs.Factory):  # type: ignore[arg-type]
        return default.factory(owner) if default.takes_self else default.factory()
    return default


def fault_of(instance: Any, field: Any, value: Any) -> tuple[str, str | None] | None:
    """What the field's validator says against a value, and a hint."""
    if field.validator is None or field.converter is not None:
        return None  # what a converter makes of the value is validated with the whole
    try:
        field.validator(instance, field, value)
    except AttributeError:
        return None  # it looks at a field that is itself wrong
    except InputError as error:
        return error.message, error.hint
    except Exception as error:  # noqa: BLE001 - a plugin's own code
        return words_of(error), None
    return None


def words_of(error: Exception) -> str:
    """What a validator says; attrs' own carry further arguments beside the sentence."""
    text = error.args[0] if error.args and isinstance(error.args[0], str) else str(error)
    return " ".join(text.split()) or type(error).__name__
