"""Poses in the plane, vectorised: x, y in metres and yaw in radians in the last axis."""

import numpy as np

from mrpbench_core.model.common.arrays import Float


def wrapped(angle: Float) -> Float:
    """Return the same angles within [-pi, pi)."""
    result: Float = np.remainder(angle + np.pi, 2 * np.pi) - np.pi
    return result


def composed(frame: Float, pose: Float) -> Float:
    """Transform `pose` f8[...,3], given in `frame` f8[...,3], to the parent of `frame`."""
    cosine, sine = np.cos(frame[..., 2]), np.sin(frame[..., 2])
    x, y = pose[..., 0], pose[..., 1]
    return np.stack(
        [
            frame[..., 0] + cosine * x - sine * y,
            frame[..., 1] + sine * x + cosine * y,
            wrapped(frame[..., 2] + pose[..., 2]),
        ],
        axis=-1,
    )


def relative(frame: Float, pose: Float) -> Float:
    """Transform `pose` f8[...,3] to `frame` f8[...,3], both given in the same frame; the inverse of `composed`."""
    cosine, sine = np.cos(frame[..., 2]), np.sin(frame[..., 2])
    x, y = pose[..., 0] - frame[..., 0], pose[..., 1] - frame[..., 1]
    return np.stack([cosine * x + sine * y, cosine * y - sine * x, wrapped(pose[..., 2] - frame[..., 2])], axis=-1)
