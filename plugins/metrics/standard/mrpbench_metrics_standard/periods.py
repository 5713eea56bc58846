"""Uninterrupted periods in which a condition holds."""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Int


def periods(holds: Bool) -> tuple[Int, Int, Int]:
    """Column, first row and last row + 1 of each longest run of True in the columns of bool[T,n]."""
    padded = np.zeros((holds.shape[1], holds.shape[0] + 2), np.int8)
    padded[:, 1:-1] = holds.T
    change = np.diff(padded, axis=1)
    column, first = np.nonzero(change == 1)
    _, after = np.nonzero(change == -1)
    return column, first, after
