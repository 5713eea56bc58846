"""Covariances of estimates and odometry: the mean squared errors of each robot so far, from the ground truth.

Recordings have no covariances of localizers. These are those of a localizer that knows how well it has done.
"""

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.poses import wrapped
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_exporters_rosbag2.frames import parent

PLANAR, FORWARD = (0, 1, 5), (0, 5)
"""Rows of a 6 x 6 covariance for x, y, yaw, and for speed forward and turn rate."""


@attrs.frozen(kw_only=True)
class BlockCovariances:
    """6 x 6 covariances, row-major, f8[k,n,36] at the samples of a block; 0 where there is no ground truth."""

    estimate: Float
    odometry: Float
    twist: Float


class Covariances:
    """Those of a whole fleet, block by block."""

    def __init__(self) -> None:
        self._estimate, self._odometry, self._twist = _Mean(PLANAR), _Mean(PLANAR), _Mean(FORWARD)
        self._origin: Float | None = None
        self._block: Chunk | None = None

    def of(self, block: Chunk) -> BlockCovariances:
        """Covariances at the samples of `block`, which follows the block of the call before or is the same."""
        if block is not self._block:
            self._block, self._covariances = block, self._next(block)
        return self._covariances

    def _next(self, block: Chunk) -> BlockCovariances:
        truth, driven = block.get("truth"), block.get("odometry")
        if driven is not None and truth is not None and self._origin is None:
            self._origin = parent(truth[0], driven[0, :, :3])
        nothing = np.zeros((len(block.get("time", ())), 1, 36))
        odometry = estimate = twist = nothing
        if truth is not None and "estimate" in block:
            estimate = self._estimate.after(_difference(block["estimate"], truth))
        if truth is not None and driven is not None:
            assert self._origin is not None
            odometry = self._odometry.after(_difference(driven[..., :3], _relative(truth, self._origin)))
        if driven is not None and "truth_twist" in block:
            twist = self._twist.after(driven[..., 3:] - block["truth_twist"])
        return BlockCovariances(estimate=estimate, odometry=odometry, twist=twist)


class _Mean:
    """Means of products of errors. Sums run sample by sample, so that the borders of blocks leave no trace."""

    def __init__(self, axes: tuple[int, ...]) -> None:
        self._axes, self._count = np.ix_(axes, axes), 0
        self._sum: Float | None = None

    def after(self, error: Float) -> Float:
        """6 x 6 covariances f8[k,n,36] after each of the errors f8[k,n,c]."""
        products = error[..., :, None] * error[..., None, :]
        before = np.zeros_like(products[:1]) if self._sum is None else self._sum
        total = np.cumsum(np.concatenate([before, products]), axis=0)[1:]
        count = self._count + np.arange(1, len(error) + 1)
        self._sum, self._count = total[-1:], int(count[-1])
        full = np.zeros((*error.shape[:2], 6, 6))
        full[..., self._axes[0], self._axes[1]] = total / count[:, None, None, None]
        return full.reshape(*error.shape[:2], 36)


def _difference(left: Float, right: Float) -> Float:
    """Poses minus poses f8[...,3], with the yaw in (-pi, pi]."""
    difference = left - right
    difference[..., 2] = wrapped(difference[..., 2])
    return difference


def _relative(pose: Float, frame: Float) -> Float:
    """Poses f8[k,n,3] in frames f8[n,3]."""
    cos, sin = np.cos(frame[:, 2]), np.sin(frame[:, 2])
    dx, dy = pose[..., 0] - frame[:, 0], pose[..., 1] - frame[:, 1]
    return np.stack([cos * dx + sin * dy, cos * dy - sin * dx, pose[..., 2] - frame[:, 2]], axis=-1)
