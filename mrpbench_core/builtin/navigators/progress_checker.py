"""Whether robots make progress, as Nav2's `SimpleProgressChecker` sees it: turning on the spot is no progress."""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float


class ProgressChecker:
    """Checks robots under way.

    Args:
        robots: number of robots.
        radius: a robot makes progress when it has moved this far, metres.
        allowance: simulated seconds within which it has to.
    """

    def __init__(self, robots: int, radius: float, allowance: float) -> None:
        self._squared, self._allowance = radius * radius, allowance
        self._place: Float = np.full((robots, 2), np.inf)  # far from everywhere: the first pose is progress
        self._since: Float = np.zeros(robots)

    def check(self, now: float, pose: Float, under_way: Bool) -> Bool:
        """Tell bool[n] which robots under way are stuck; their time begins anew."""
        offset = pose[:, :2] - self._place
        moved = (offset * offset).sum(axis=1) > self._squared
        fresh = moved | ~under_way
        stuck: Bool = ~fresh & (now - self._since > self._allowance)
        renewed = fresh | stuck
        self._place[renewed] = pose[renewed, :2]
        self._since[renewed] = now
        return stuck
