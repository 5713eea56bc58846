"""Whether robots make progress: to Nav2's `SimpleProgressChecker` turning on the spot is no progress, to its
`PoseProgressChecker` it is.
"""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float


class ProgressChecker:
    """Checks robots under way.

    Args:
        robots: number of robots.
        radius: a robot makes progress when it has moved this far, metres.
        allowance: simulated seconds within which it has to.
        angle: a robot makes progress, too, when it has turned this far, radians; inf = turning is no progress.
    """

    def __init__(self, robots: int, radius: float, allowance: float, angle: float = np.inf) -> None:
        self._squared, self._allowance, self._angle = radius * radius, allowance, angle
        self._place: Float = np.full((robots, 2), np.inf)  # far from everywhere: the first pose is progress
        self._yaw: Float = np.zeros(robots)
        self._since: Float = np.zeros(robots)
        self._now = 0.0

    def check(self, now: float, pose: Float, under_way: Bool, speed: Float) -> Bool:
        """Tell bool[n] which robots under way are stuck; their time begins anew.

        Where `speed` f8[n] m/s is so low that a robot needs more than half of the time allowed to move far enough, its
        time passes more slowly.
        """
        offset = pose[:, :2] - self._place
        moved = (offset * offset).sum(axis=1) > self._squared
        if np.isfinite(self._angle):
            moved |= np.abs(np.remainder(pose[:, 2] - self._yaw + np.pi, 2 * np.pi) - np.pi) > self._angle
        share = np.minimum(1.0, speed * self._allowance / (2 * np.sqrt(self._squared)))
        self._since += (now - self._now) * (1 - share)
        self._now = now
        fresh = moved | ~under_way
        stuck: Bool = ~fresh & (now - self._since > self._allowance)
        renewed = fresh | stuck
        self._place[renewed], self._yaw[renewed] = pose[renewed, :2], pose[renewed, 2]
        self._since[renewed] = now
        return stuck
