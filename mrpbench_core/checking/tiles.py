"""Finds the boxes, among many, that may overlap a given box."""

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int


class Tiles:
    """Boxes from `low` to `high` f8[k,2], indexed by the tile that contains their lower left corner."""

    def __init__(self, low: Float, high: Float) -> None:
        self._widest = (high - low).max(axis=0, initial=0.0)
        self._size = max(float(self._widest.max()), 1.0)
        tile = np.floor(low / self._size).astype(np.int64)
        self._first = tile.min(axis=0, initial=0)
        self._last = tile.max(axis=0, initial=0)
        key = self._key(*tile.T)
        self._order = np.argsort(key, kind="stable")
        self._sorted = key[self._order]

    def _key(self, column: Int, row: Int) -> Int:
        key: Int = (column - self._first[0]) * (self._last[1] - self._first[1] + 1) + row - self._first[1]
        return key

    def __call__(self, least: Float, most: Float) -> Int:
        """Indices of all boxes that overlap the box from `least` to `most`, and of some others."""
        # slightly lower: if rounding makes a box wider than `widest`, its tile is the one before
        first = np.maximum(np.floor((least - self._widest) / self._size - 1e-9).astype(np.int64), self._first)
        last = np.minimum(np.floor(most / self._size).astype(np.int64), self._last)
        if (first > last).any():
            return self._order[:0]
        columns = np.arange(first[0], last[0] + 1)
        begin = np.searchsorted(self._sorted, self._key(columns, first[1]))
        end = np.searchsorted(self._sorted, self._key(columns, last[1]), side="right")
        return np.concatenate([self._order[a:b] for a, b in zip(begin, end, strict=True)])
