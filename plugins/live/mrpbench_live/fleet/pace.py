"""Keeps simulated time at a multiple of the wall clock, and says when it falls behind."""

import time

LATE_S, CAUGHT_UP_S = 0.2, 0.05
"""Wall seconds behind the clock from which on a run is late, and below which it has caught up."""


class Pace:
    """The clock of a run; it begins with the first call of `due`.

    Args:
        factor: simulated seconds per second of wall time.
    """

    def __init__(self, factor: float) -> None:
        self._factor = factor
        self._began: float | None = None
        self._late = False
        self.worst = 0.0
        """Wall seconds by which the run was behind the clock at most."""

    def due(self, now: float) -> float:
        """Return the time of `time.monotonic` at which `now` (simulated seconds) is due."""
        if self._began is None:
            self._began = time.monotonic() - now / self._factor
        return self._began + now / self._factor

    def change(self, now: float) -> str | None:
        """Say that the run has fallen behind the clock, or has caught up, since the last call; None: neither."""
        behind = time.monotonic() - self.due(now)
        self.worst = max(self.worst, behind)
        if not self._late and behind > LATE_S:
            self._late = True
            return f"{behind:.2f} s behind the clock at pace {self._factor:g}"
        if self._late and behind < CAUGHT_UP_S:
            self._late = False
            return f"caught up with the clock after {self.worst:.2f} s behind it"
        return None
