"""Encode model objects as JSON and decode them; arrays are stored separately as `.npy`."""

from collections.abc import Callable
from enum import Enum
from typing import Any, TypeVar, cast, get_origin

import attrs
import cattrs
import numpy as np
from numpy.typing import NDArray

Kept = TypeVar("Kept")


def encode(value: Any, keep: Callable[[NDArray[Any]], str]) -> Any:
    """Return an attrs object as JSON data; `keep` stores an array and returns its name.

    Fields with the metadata `recorded: False` are left out; they need a default.
    """
    if isinstance(value, np.ndarray):
        return {"array": keep(value)}
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, np.generic):
        return value.item()
    if attrs.has(type(value)):
        recorded = (field for field in attrs.fields(type(value)) if field.metadata.get("recorded", True))
        return {field.name: encode(getattr(value, field.name), keep) for field in recorded}
    if isinstance(value, dict):
        return {str(key): encode(item, keep) for key, item in value.items()}
    if isinstance(value, frozenset):
        return sorted(encode(item, keep) for item in value)
    if isinstance(value, tuple | list):
        return [encode(item, keep) for item in value]
    return value


def decode(data: Any, kind: type[Kept], fetch: Callable[[str], NDArray[Any]]) -> Kept:
    """Return the object of class `kind` that `encode` turned into `data`; `fetch` loads an array by name."""
    converter = cattrs.Converter()
    converter.register_structure_hook_func(
        lambda wanted: cast(Any, get_origin(wanted)) is np.ndarray,
        lambda entry, _: fetch(entry["array"]),
    )
    converter.register_structure_hook(float, lambda number, _: float(number))
    return converter.structure(data, kind)
