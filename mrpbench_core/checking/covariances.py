"""Checks covariances of poses."""

from typing import Any

import numpy as np

from mrpbench_core.checking.recording import LARGEST

ROUNDING = 1e-6
"""How far a covariance may be from a symmetric, positive semi-definite matrix, in parts of its largest entry."""


def check_covariances(covariances: Any, robots: int) -> str | None:
    """Return what keeps something from being covariances f8[robots,3,3], as `a covariance that …`, or None."""
    if not isinstance(covariances, np.ndarray) or covariances.dtype != np.float64:
        return f"a covariance that is {type(covariances).__name__} instead of an array of 64-bit floats"
    if covariances.shape != (robots, 3, 3):
        return f"a covariance of shape {covariances.shape}"
    largest = np.abs(covariances).max(axis=(1, 2), initial=0.0)
    if not (largest <= LARGEST).all():
        return "a covariance that is not finite or too large"
    slack = ROUNDING * largest
    if (np.abs(covariances - covariances.transpose(0, 2, 1)).max(axis=(1, 2), initial=0.0) > slack).any():
        return "a covariance that is not symmetric"
    if (np.linalg.eigvalsh(covariances).min(axis=1, initial=np.inf) < -slack).any():
        return "a covariance that is negative in some direction"
    return None
