"""Packs integer arrays for a browser: small, and fast to read.

Differences along the last axis, zigzag, bytes of equal weight side by side, deflate. `page/data.js` reads it back.
"""

import base64
import zlib
from math import prod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mrpbench_core.model.common.arrays import Float, Int32

LARGEST = 2**30
"""Quantised values stay below this, so that their differences do not overflow 32 bits."""
_TYPES = (("Uint8Array", 0, 2**8), ("Int16Array", -(2**15), 2**15), ("Int32Array", -(2**31), 2**31))


class Packing:
    """Named arrays that are packed into one text."""

    def __init__(self) -> None:
        self.layout: dict[str, dict[str, Any]] = {}
        """Layout of each array, with which the page reads it."""
        self._parts: list[bytes] = []
        self._size = 0

    def __contains__(self, name: object) -> bool:
        return name in self.layout

    def add(self, name: str, values: ArrayLike, scale: float = 1.0, offset: float = 0.0) -> None:
        """Append integers of 32 bits; their real values are `offset + scale * value`."""
        array = np.ascontiguousarray(values, dtype=np.int32)
        order, codes = _shortest(array.reshape(prod(array.shape[:-1]), -1) if array.size else array.reshape(1, 0))
        width = next(width for width in (1, 2, 4) if width == 4 or codes.max(initial=0) < 256**width)
        planes = codes.astype("<u4").reshape(-1).view(np.uint8).reshape(-1, 4)[:, :width].T.tobytes()
        low, high = int(array.min(initial=0)), int(array.max(initial=0))
        kind = next(kind for kind, least, bound in _TYPES if least <= low and high < bound)
        self.layout[name] = {"at": self._size, "shape": list(array.shape), "order": order, "width": width, "type": kind}
        self.layout[name] |= {"scale": scale, "offset": offset}
        self._parts.append(planes)
        self._size += len(planes)

    def add_metres(self, name: str, values: ArrayLike, quantum: float = 0.001) -> None:
        """Append lengths or angles, rounded to `quantum` (coarser where 32 bits would not hold them)."""
        self.add(name, *quantise(np.asarray(values, float), quantum))

    def text(self) -> str:
        """All arrays, deflated, as base64."""
        return base64.b64encode(zlib.compress(b"".join(self._parts), 7)).decode()


def quantise(values: Float, quantum: float) -> tuple[Int32, float, float]:
    """Return integers, scale and offset, which give the values back within half a scale."""
    if not values.size:
        return values.astype(np.int32), quantum, 0.0
    low, high = float(values.min()), float(values.max())
    offset = round(low / quantum) * quantum if max(-low, high) / quantum >= LARGEST else 0.0
    scale = max(quantum, (high - low) / LARGEST)
    return np.rint((values - offset) / scale).astype(np.int32), scale, offset


def _shortest(rows: Int32) -> tuple[int, NDArray[np.uint32]]:
    """Return the order of differences (0, 1 or 2) that gives the smallest numbers, and these numbers, zigzag coded."""
    best: tuple[float, int, NDArray[np.uint32]] | None = None
    with np.errstate(over="ignore"):  # what wraps here unwraps in the page
        for order in range(3):
            codes = ((rows << 1) ^ (rows >> 31)).view(np.uint32)
            cost = float(np.log2(codes.astype(float) + 1).sum())
            if best is None or cost < best[0]:
                best = cost, order, codes
            rows = np.diff(rows, axis=1, prepend=np.int32(0))
    assert best is not None
    return best[1], best[2]
