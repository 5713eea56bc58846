"""Finds robots that stand although their way is released, and the robots that may block them."""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32

AROUND = 1.0
"""Seconds before and after a sample in which a robot that stands does not move."""
MOVED, TURNED = 0.02, 0.05
"""Metres and radians below which a robot does not move."""
NEAR = 0.5
"""Metres between the discs of two robots up to which one may block the other."""


def standing(time: Float, pose: Float) -> Bool:
    """Tell which robots bool[T,n] stand at each sample; poses f8[T,n,3]."""
    before = np.searchsorted(time, time - AROUND - 1e-9)
    after = np.minimum(np.searchsorted(time, time + AROUND + 1e-9), len(time) - 1)
    still = np.ones(pose.shape[:2], bool)
    for one, other in ((before, np.arange(len(time))), (np.arange(len(time)), after)):
        change = pose[other] - pose[one]
        still &= np.hypot(change[..., 0], change[..., 1]) < MOVED
        still &= np.abs((change[..., 2] + np.pi) % (2 * np.pi) - np.pi) < TURNED
    return still


def nearest(blocked: Bool, pose: Float, level: Int, radius: Float) -> Int32:
    """Return the robot i4[T,n] that is nearest to each blocked robot, -1 if none on its level is near.

    Args:
        blocked: bool[T,n].
        pose: f8[T,n,3] metres and radians.
        level: i[T,n].
        radius: f8[n] metres, of the robots' discs.
    """
    nearest = np.full(blocked.shape, -1, np.int32)
    for sample in np.flatnonzero(blocked.any(axis=1)).tolist():
        robots = np.flatnonzero(blocked[sample])
        place, floor = pose[sample, :, :2], level[sample]
        gap = np.linalg.norm(place[robots, None] - place, axis=2) - radius[robots, None] - radius
        gap[(floor[robots, None] != floor) | (robots[:, None] == np.arange(len(floor)))] = np.inf
        other = gap.argmin(axis=1)
        nearest[sample, robots] = np.where(gap[np.arange(len(robots)), other] <= NEAR, other, -1)
    return nearest
