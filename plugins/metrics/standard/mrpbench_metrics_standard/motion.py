"""How far robots truly move and turn between samples."""

import numpy as np

from mrpbench_core.model.arrays import Float


def steps(truth: Float) -> Float:
    """Metres f8[T-1,n] between samples, straight."""
    change = np.diff(truth[..., :2], axis=0)
    return np.hypot(change[..., 0], change[..., 1])


def turns(truth: Float) -> Float:
    """Radians f8[T-1,n] turned between samples, without sign, the shorter way round: 0..pi."""
    turned: Float = np.abs((np.diff(truth[..., 2], axis=0) + np.pi) % (2 * np.pi) - np.pi)
    return turned
