"""Intervals: which of them overlap, and the runs of True in rows."""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int


def overlapping(low: Float, high: Float) -> tuple[Int, Int]:
    """Return the pairs i8[k] of closed intervals f8[n] that overlap, each once, that with the lower end first."""
    order = np.argsort(low, kind="stable")
    count = np.searchsorted(low[order], high[order], side="right") - np.arange(1, len(order) + 1)
    first = np.repeat(np.arange(len(order)), count)
    second = first + np.arange(1, len(first) + 1) - np.repeat(np.cumsum(count) - count, count)
    return order[first], order[second]


def runs(holds: Bool) -> tuple[Int, Int, Int]:
    """Return row, first column and last column + 1 of each maximal run of True in the rows of bool[n,k]."""
    padded = np.zeros((holds.shape[0], holds.shape[1] + 2), np.int8)
    padded[:, 1:-1] = holds
    change = np.diff(padded, axis=1)
    row, first = np.nonzero(change == 1)
    _, after = np.nonzero(change == -1)
    return row, first, after
