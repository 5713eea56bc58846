"""True movements and turns of robots between samples."""

import numpy as np

from mrpbench_core.model.common.arrays import Float


def steps(truth: Float) -> Float:
    """Straight distances f8[T-1,n] in metres between samples."""
    change = np.diff(truth[..., :2], axis=0)
    return np.hypot(change[..., 0], change[..., 1])


def turns(truth: Float) -> Float:
    """Radians f8[T-1,n] by which robots turn between samples, unsigned, in 0..pi."""
    turned: Float = np.abs((np.diff(truth[..., 2], axis=0) + np.pi) % (2 * np.pi) - np.pi)
    return turned
