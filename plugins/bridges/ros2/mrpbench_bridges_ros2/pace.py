"""Synchronises simulated time with the wall clock."""

import time


class Pace:
    """Synchronizes simulated time with the wall clock. A simulation that is too slow runs as fast as possible."""

    def __init__(self, factor: float | None) -> None:
        """`factor` times real time; None = freely."""
        self._factor = factor
        self._began: float | None = None

    def left(self, now: float) -> float:
        """Seconds of wall time until `now` (simulated) is due; the clock starts with the first call."""
        if self._factor is None:
            return 0.0
        wall = time.monotonic()
        if self._began is None:
            self._began = wall - now / self._factor
        return max(0.0, self._began + now / self._factor - wall)
