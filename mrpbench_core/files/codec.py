"""Encode model objects as JSON and decode them; arrays are stored separately as `.npy`."""

from collections.abc import Callable, Sequence
from contextvars import ContextVar
from enum import Enum
from functools import cache
from typing import Any, TypeVar, cast, get_origin

import attrs
import cattrs
import numpy as np
from cattrs.gen import make_dict_structure_fn, override
from numpy.typing import NDArray

Kept = TypeVar("Kept")
_FETCH: ContextVar[Callable[[str], NDArray[Any]]] = ContextVar("fetch")


def encode(value: Any, keep: Callable[[NDArray[Any]], str]) -> Any:
    """Return an attrs object as JSON data; `keep` stores an array and returns its name.

    Fields with the metadata `recorded: False` are left out; they need a default. The metadata `recorded_as` names a
    field in the data, where it has another name.
    """
    if isinstance(value, np.ndarray):
        return {"array": keep(value)}
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, Sequence) and not isinstance(value, str | bytes):  # of whatever class
        return [encode(item, keep) for item in value]
    if attrs.has(type(value)):
        recorded = (field for field in attrs.fields(type(value)) if field.metadata.get("recorded", True))
        return {_name(field): encode(getattr(value, field.name), keep) for field in recorded}
    if isinstance(value, dict):
        return {str(key): encode(item, keep) for key, item in value.items()}
    if isinstance(value, frozenset):
        return sorted(encode(item, keep) for item in value)
    return value


def decode(data: Any, kind: type[Kept], fetch: Callable[[str], NDArray[Any]]) -> Kept:
    """Return the object of class `kind` that `encode` turned into `data`; `fetch` loads an array by name.

    Raises:
        ValueError: something in `data` is missing, or has another type or range; whatever `fetch` raises passes.
    """
    token = _FETCH.set(fetch)
    try:
        return _converter().structure(data, kind)
    except (cattrs.BaseValidationError, cattrs.StructureHandlerNotFoundError) as error:
        raise ValueError("; ".join(cattrs.transform_error(error)[:3])) from None
    finally:
        _FETCH.reset(token)


@cache
def _converter() -> cattrs.Converter:
    """The only converter, because it takes longer to prepare than to use."""
    converter = cattrs.Converter()
    converter.register_structure_hook_factory(
        lambda wanted: attrs.has(wanted) and any(_name(field) != field.name for field in attrs.fields(wanted)),
        lambda wanted: make_dict_structure_fn(wanted, converter, **_renamed(wanted)),
    )
    converter.register_structure_hook_func(
        lambda wanted: cast(Any, get_origin(wanted)) is np.ndarray,
        lambda entry, _: _FETCH.get()(entry["array"]),
    )
    converter.register_structure_hook(float, lambda number, _: float(_plain(number, int | float)))
    # The hooks of cattrs for these would convert whatever is there.
    converter.register_structure_hook_func(lambda wanted: wanted in (bool, int, str), _plain)
    return converter


def _renamed(kind: type[Any]) -> dict[str, Any]:
    return {field.name: override(rename=_name(field)) for field in attrs.fields(kind)}


def _name(field: "attrs.Attribute[Any]") -> str:
    """The name of a field in the data."""
    return str(field.metadata.get("recorded_as", field.name))


def _plain(value: Any, kind: Any) -> Any:
    if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool):
        raise ValueError(f"{value!r:.40} is not {getattr(kind, '__name__', 'number')}")
    if isinstance(value, int) and not -(2**63) <= value < 2**63:
        raise ValueError("the integer has more than 64 bits")
    return value
