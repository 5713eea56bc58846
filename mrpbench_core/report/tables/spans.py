"""Writes integers as ranges, for lists of seeds and repeats."""

import numpy as np

from mrpbench_core.model.common.arrays import Int


def spans(numbers: Int) -> str:
    """Write integers as ranges: `0..53, 60`."""
    values = np.unique(numbers)
    parts = np.split(values, np.flatnonzero(np.diff(values) != 1) + 1)
    return ", ".join(f"{part[0]}" if len(part) == 1 else f"{part[0]}..{part[-1]}" for part in parts if len(part))
