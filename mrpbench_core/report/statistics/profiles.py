"""Curves over all units, in which those without a result count.

Performance profiles: E. D. Dolan, J. J. Moré, "Benchmarking optimization software with performance profiles",
Mathematical Programming 91, 2002.
"""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.model.arrays import Float


def cactus(times: Float) -> tuple[Float, Float]:
    """Times in ascending order, and how many units were done within each; NaN = never done."""
    done = np.sort(times[np.isfinite(times)])
    return done, np.arange(1, len(done) + 1, dtype=float)


def profiles(values: Sequence[Float]) -> list[tuple[Float, Float]]:
    """For each treatment: ratios to the best in ascending order, and the share of units within each.

    Args:
        values: of each treatment, its values, none below 0, for the same units; smaller is better, NaN = none. Units
            without a value of any treatment count as undone by all.
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
