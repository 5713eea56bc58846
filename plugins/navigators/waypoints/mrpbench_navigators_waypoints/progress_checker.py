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
        self._squared, self._allowance = radius * radius, allowance
        self._angle, self._turns = angle, np.isfinite(angle)
        self._slow = 2.001 * radius / allowance
        """m/s below which a robot may need more than half of that time."""
        self._place: Float = np.full((robots, 2), np.inf)  # far from everywhere: the first pose is progress
        self._yaw: Float = np.zeros(robots)
        self._since: Float = np.zeros(robots)
        self._earliest = 0.0
        """No robot under way has made its last progress before this simulated second."""
        self._now, self._pose = 0.0, np.zeros((robots, 3))
        """Simulated second and poses of the control period before."""
        self._under_way: Bool = np.ones(robots, bool)
        self._nobody: Bool = np.zeros(robots, bool)

    def check(self, now: float, pose: Float, under_way: Bool, speed: Float) -> Bool:
        """Tell bool[n] which robots under way are stuck; their time begins anew.

        Where `speed` f8[n] m/s is so low that a robot needs more than half of the time allowed to move far enough, its
        time passes more slowly.
        """
        if under_way is not self._under_way:
            self._begin(under_way)
        offset = pose[:, :2] - self._place
        offset *= offset
        moved: Bool = offset[:, 0] + offset[:, 1] > self._squared
        if self._turns:
            moved |= np.abs(np.remainder(pose[:, 2] - self._yaw + np.pi, 2 * np.pi) - np.pi) > self._angle
        moved &= under_way
        if np.count_nonzero(speed < self._slow):
            share = np.minimum(1.0, speed * self._allowance / (2 * np.sqrt(self._squared)))
            self._since += (now - self._now) * (1 - share)
        self._now, self._pose = now, pose
        if now - self._earliest <= self._allowance:
            self._renew(moved, pose, now)
            return self._nobody
        stuck: Bool = under_way & ~moved & (now - self._since > self._allowance)
        self._earliest = float(self._since.min(where=under_way, initial=now))
        self._renew(moved | stuck, pose, now)
        return stuck

    def _begin(self, under_way: Bool) -> None:
        """Let the time of robots that are under way only now begin in the control period before."""
        self._renew(under_way & ~self._under_way, self._pose, self._now)
        self._under_way = under_way

    def _renew(self, some: Bool, pose: Float, now: float) -> None:
        if np.count_nonzero(some):
            self._place[some], self._yaw[some] = pose[some, :2], pose[some, 2]
            self._since[some] = now
