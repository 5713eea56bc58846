"""Converts values that plugins return into values that JSON supports."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np


def jsonable(value: Any) -> Any:
    """Convert NumPy scalars and arrays to Python's, and numbers that are not finite or fit no 64 bits to None."""
    if isinstance(value, np.generic | np.ndarray):
        return jsonable(value.tolist())
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    if isinstance(value, int):
        return value if -(2**63) <= value < 2**63 else None
    if value is None:
        return None
    if isinstance(value, Mapping):
        return {_storable(str(key)): jsonable(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [jsonable(item) for item in value]
    return _storable(str(value))


def _storable(text: str) -> str:
    """Escape unpaired surrogates, which no file can hold."""
    return text.encode(errors="backslashreplace").decode()
