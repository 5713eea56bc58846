"""Tells how far an execution is, at most twice a second of wall time, so that it costs no time."""

import time
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

INTERVAL = 0.5
"""Wall seconds between two messages, at least."""


class ExecutionProgress:
    """Called in every control period; see `LoopInputs.progress`."""

    def __init__(self, tell: Callable[..., Any], limit_s: float) -> None:
        """`tell` receives the facts; `limit_s` is the simulated time after which the execution ends."""
        self._tell, self._limit_s = tell, limit_s
        self._due = time.monotonic() + INTERVAL

    def __call__(self, now: float, arrived: NDArray[np.bool_]) -> None:
        """Tell simulated seconds and the number of robots that have arrived, if it is time."""
        clock = time.monotonic()
        if clock >= self._due:
            self._due = clock + INTERVAL
            facts = {"arrived": int(np.count_nonzero(arrived)), "robots": len(arrived)}
            self._tell(simulated_s=now, limit_s=self._limit_s, **facts)
