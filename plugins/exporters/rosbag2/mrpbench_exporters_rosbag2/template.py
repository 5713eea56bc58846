"""Makes many messages of one layout at a time by patching the bytes of a template.

Building a message object and serialising it costs ten times as much as copying its bytes and filling in the numbers.
A template is serialised once with *holes*: arrays of unlikely numbers in place of what will vary. Where those numbers
stand in the bytes is where the values go, so nothing here knows how CDR aligns fields.
"""

import re
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from rosbags.typesys.store import Typestore

from mrpbench_core.model.common.arrays import Int
from mrpbench_exporters_rosbag2.messages import SECOND, TYPES, serialize

STAMP = 1_234_567_890_987_654_321
"""The stamp that templates are made with, nanoseconds."""


def hole(count: int, dtype: str = "<f8") -> NDArray[Any]:
    """`count` numbers that nothing else in a message will equal, a hole of another width included."""
    if np.dtype(dtype).kind == "f":
        return (np.arange(1, count + 1) * 7.123456789e-5 + 31.4159 * count).astype(dtype)
    odd = 0x9E3779B97F4A7C15 // np.dtype(dtype).itemsize | 1
    return (np.arange(1, count + 1, dtype="u8") * odd + count).astype(dtype)


class Template:
    """One message type with fixed strings and array lengths."""

    def __init__(
        self, type_name: str, message: Any, holes: Mapping[str, NDArray[Any]], types: Typestore = TYPES
    ) -> None:
        """Serialise `message`, made with `STAMP` and with the numbers of `holes` where values will go."""
        data = serialize(type_name, message, types)
        self.data = np.frombuffer(data, np.uint8)
        self.places = {
            name: (numbers, [match.start() for match in re.finditer(re.escape(numbers.tobytes()), data)])
            for name, numbers in {"stamp": _split(np.array([STAMP])), **holes}.items()
        }

    def fill(self, stamps: Int, **values: ArrayLike) -> list[bytes]:
        """Return one message for each of `stamps` i8[k] (nanoseconds).

        `values` name holes: shape [k, width], or [k, times, width] for a hole that occurs several times.
        """
        count = len(stamps)
        rows = np.tile(self.data, (count, 1))
        for name, value in {"stamp": _split(stamps), **values}.items():
            numbers, offsets = self.places[name]
            data = np.ascontiguousarray(value, numbers.dtype).reshape(count, -1, len(numbers)).view(np.uint8)
            for index, offset in enumerate(offsets):
                rows[:, offset : offset + numbers.nbytes] = data[:, index % data.shape[1]]
        size, flat = len(self.data), rows.tobytes()
        return [flat[start : start + size] for start in range(0, len(flat), size)]


def _split(stamps: Int) -> NDArray[Any]:
    """Seconds and nanoseconds i4[k,2], side by side as in `builtin_interfaces/Time`."""
    parts: NDArray[Any] = np.stack(np.divmod(stamps, SECOND), axis=-1).astype("<i4").reshape(-1)
    return parts
