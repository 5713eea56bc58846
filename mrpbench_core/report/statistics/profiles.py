"""Curves over all units, including those without a result.

Performance profiles: E. D. Dolan, J. J. Moré, "Benchmarking optimization software with performance profiles",
Mathematical Programming 91, 2002.
"""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.model.common.arrays import Float


def cactus(times: Float) -> tuple[Float, Float]:
    """Return the times in ascending order, and the number of units done within each; NaN means never done."""
    done = np.sort(times[np.isfinite(times)])
    return done, np.arange(1, len(done) + 1, dtype=float)


def profiles(values: Sequence[Float]) -> list[tuple[Float, Float]]:
    """Return for each treatment the ratios to the best in ascending order, and the share of units within each.

    Args:
        values: for each treatment its values for the same units, not below 0; smaller is better, NaN means none. Units
            without a value of any treatment count as never done.
    """
    table = np.array(values, float).reshape(len(values), -1)
    best = np.fmin.reduce(table, axis=0, initial=np.inf)
    shares = np.arange(1, table.shape[1] + 1) / max(1, table.shape[1])
    curves = []
    for row in table:
        done = np.isfinite(row)
        ratios = np.ones(done.sum())  # also where the best is 0, as where no robot needs to move
        with np.errstate(divide="ignore"):
            np.divide(row[done], best[done], out=ratios, where=row[done] > best[done])
        ratios.sort()
        curves.append((ratios, shares[: len(ratios)]))
    return curves
