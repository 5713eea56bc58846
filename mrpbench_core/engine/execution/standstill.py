"""Tells when an execution with a lasting fault is over."""

from collections.abc import Hashable

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float


class Standstill:
    """Notices that nothing goes on.

    Args:
        patience: simulated seconds without any progress, of which those do not count in which a robot stops because of
            `delays`.
        robots: their number.
    """

    def __init__(self, patience: float, robots: int) -> None:
        self._patience = patience
        self._last: Hashable = None
        self._now = 0.0
        self._free: Float = np.zeros(robots)
        """Seconds f8[n] since the last progress in which each robot did not stop."""

    def update(self, now: float, progress: Hashable, may_end: bool, stopped: Bool) -> bool:
        """Tell whether the execution is over: `progress` did not change, and `may_end` held, for long enough.

        `stopped` bool[n]: the robots that stop, though not for good.
        """
        self._free = self._free + np.where(stopped, 0.0, now - self._now)
        self._now = now
        if progress != self._last or not may_end:
            self._last, self._free = progress, np.zeros_like(self._free)
        return bool((self._free >= self._patience - 1e-9).all())
