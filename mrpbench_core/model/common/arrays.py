"""Read-only NumPy fields for attrs classes."""

from typing import Any

import attrs
import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

Float = NDArray[np.float64]
Int = NDArray[np.int64]
Int32 = NDArray[np.int32]
Int16 = NDArray[np.int16]
Byte = NDArray[np.uint8]
Bool = NDArray[np.bool_]

_FROZEN, _FLAGS = 0x5, 0x405
"""Flags of an array that owns its values in C order, `C_CONTIGUOUS | OWNDATA` of NumPy, and the same with `WRITEABLE`.
"""
ARRAY = "array"
"""Key of the metadata of a field declared by `array`: its dtype, and its columns or None."""


def frozen_array(values: ArrayLike, dtype: DTypeLike, columns: int | None = None) -> NDArray[Any]:
    """Return a read-only copy of `values` as `dtype`; `columns` shapes an empty list as (0, columns).

    An array that is already such a copy is returned as it is.

    Raises:
        ValueError: the number of columns differs, or `dtype` is an integer type and some value does not fit it.
    """
    source, wanted = np.asarray(values), np.dtype(dtype)
    array = _frozen(source) if source.dtype == wanted else _converted(source, wanted)
    if columns is not None and array.size == 0:
        array = array.reshape(0, columns)
    elif columns is not None and array.shape[1:] != (columns,):  # reshaping would hide swapped rows and columns
        raise ValueError(f"expected an array of {columns} columns, got the shape {array.shape}")
    return read_only(array)


def _frozen(source: NDArray[Any]) -> NDArray[Any]:
    """Return a read-only copy, or `source` if it is one already."""
    return source if source.flags.num & _FLAGS == _FROZEN else read_only(source.copy())


def read_only(array: NDArray[Any]) -> NDArray[Any]:
    """Return the same array, which cannot be written to any more."""
    array.setflags(False)  # type: ignore[call-arg]  # `write` by its name takes twice the time, in every control period
    return array


def _converted(source: NDArray[Any], wanted: np.dtype[Any]) -> NDArray[Any]:
    with np.errstate(invalid="ignore"):
        array = np.array(source, dtype=wanted, order="C")
    if wanted.kind in "iu" and source.dtype.kind in "iuf" and (array != source).any():
        # NumPy would truncate or wrap silently.
        raise ValueError(f"expected whole numbers that fit in {wanted}, got {source[array != source][0]}")
    return array


def array(dtype: DTypeLike, columns: int | None = None, **arguments: Any) -> Any:
    """Declare an attrs field that holds a read-only array of `dtype` (with `columns` columns if two-dimensional)."""
    wanted = np.dtype(dtype)
    shape = None if columns is None else (columns,)

    def convert(values: ArrayLike) -> NDArray[Any]:
        if type(values) is np.ndarray and values.dtype is wanted and (shape is None or values.shape[1:] == shape):
            # The usual case in every control period, therefore without another call.
            return values if values.flags.num & _FLAGS == _FROZEN else read_only(values.copy())
        return frozen_array(values, wanted, columns)

    return attrs.field(
        converter=convert,
        metadata={ARRAY: (wanted, columns)},
        eq=attrs.cmp_using(eq=equal_arrays),
        **arguments,
    )


def equal_arrays(left: NDArray[Any], right: NDArray[Any]) -> bool:
    """Tell whether two arrays have the same shape and values, NaN equal to NaN."""
    if left.shape != right.shape or left.dtype != right.dtype:
        return False
    return bool(np.array_equal(left, right, equal_nan=left.dtype.kind == "f"))
