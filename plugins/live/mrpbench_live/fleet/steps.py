"""The steps of a load: rates that rise until an outside party does not keep up, and what is counted in each."""

import contextlib
import json
import time

import numpy as np
import psutil

from mrpbench_core.api import Event, InputError
from mrpbench_live.fleet.paths import FleetPaths, FleetState

BACKLOG, DEVIATIONS = 0.05, 2.0
"""A step is not kept up if more transports pile up than this share of those offered, and than so many standard
deviations of a Poisson process."""
STUCK_S = 60.0
"""Simulated seconds without a move in want of a longer base, after which a robot counts as stuck."""
USAGE_S = 1.0
"""Wall seconds between two looks at the processor time and the memory of the outside party."""


class LoadSteps:
    """Raises a rate, and counts.

    Args:
        growth: factor of the rate from step to step.
        window: simulated seconds of each step.
        pid: of the outside party, whose processor time and memory are measured; 0: they are not.

    Raises:
        InputError: there is no such process.
    """

    def __init__(self, growth: float, window: float, pid: int) -> None:
        self._growth, self._window = growth, window
        self.factor = 1.0
        """Rate now, as a multiple of that of the first step."""
        self.ended = False
        self._process = None
        if pid:
            try:
                self._process = psutil.Process(pid)
            except psutil.Error as error:
                raise InputError(f"tasks.pid: there is no process {pid}") from error
        self._number, self._begin, self._now = 0, 0.0, 0.0
        self._open_before = 0
        self._stood: np.ndarray | None = None
        self._usage_at = 0.0
        self._clear()

    def _clear(self) -> None:
        self._offered = 0
        self._orders: list[float] = []
        self._served: list[float] = []
        self._starved_s = 0.0
        self._stuck: set[int] = set()
        self._memory = 0
        self._cpu_before, self._wall_before = self._cpu(), time.monotonic()

    def ordered(self, seconds: float) -> None:
        """Count a transport that got its first order so long after its release."""
        self._orders.append(seconds)

    def done(self, seconds: float) -> None:
        """Count a transport that was done so long after its release."""
        self._served.append(seconds)

    def update(self, state: FleetState, paths: FleetPaths, offered: int, left: int) -> list[Event]:
        """Go on; return what a step has come to, when it ends.

        Args:
            state: of the fleet.
            paths: of all robots.
            offered: transports that are released now.
            left: transports that are not done.
        """
        if self.ended:
            return []
        self._offered += offered
        step, self._now = state.now - self._now, state.now
        if self._stood is None:
            self._stood = np.zeros(len(paths))
        starved = ~state.driving & (paths.length > paths.passed) & (paths.allowed <= paths.passed)
        self._starved_s += step * int(starved.sum())
        self._stood = np.where(starved, self._stood + step, 0.0)
        self._stuck |= set(np.flatnonzero(self._stood >= STUCK_S).tolist())
        self._measure()
        if state.now < self._begin + self._window - 1e-9:
            return []
        found = self._found(len(paths), left)
        behind = left - self._open_before
        limit = max(BACKLOG * self._offered, DEVIATIONS * np.sqrt(max(1, self._offered)))
        found["kept_up"] = bool(behind <= limit)
        self.ended = not found["kept_up"]
        self._begin, self._open_before = state.now, left
        self._number, self.factor = self._number + 1, self.factor * self._growth
        self._clear()
        return [Event(stamp=state.now, kind="load_step", detail=json.dumps(found))]

    def _found(self, robots: int, left: int) -> dict[str, object]:
        seconds, wall = self._now - self._begin, max(1e-9, time.monotonic() - self._wall_before)
        cpu = self._cpu()
        return {
            "step": self._number,
            "factor": round(self.factor, 6),
            "begin": self._begin,
            "end": self._now,
            "offered": self._offered,
            "done": len(self._served),
            "open": left,
            "offered_per_hour": round(3600 * self._offered / seconds, 3),
            "done_per_hour": round(3600 * len(self._served) / seconds, 3),
            "order_s": _percentiles(self._orders),
            "done_s": _percentiles(self._served),
            "starved": round(self._starved_s / (robots * seconds), 4),
            "stuck": len(self._stuck),
            "cpu": None if cpu is None or self._cpu_before is None else round((cpu - self._cpu_before) / wall, 3),
            "memory": self._memory or None,
        }

    def _measure(self) -> None:
        if self._process is not None and time.monotonic() >= self._usage_at:
            self._usage_at = time.monotonic() + USAGE_S
            total = 0
            for process in self._family():
                with contextlib.suppress(psutil.Error):
                    total += process.memory_info().rss
            self._memory = max(self._memory, total)

    def _cpu(self) -> float | None:
        """Processor seconds of the outside party and its children so far."""
        if self._process is None:
            return None
        total = 0.0
        for process in self._family():
            with contextlib.suppress(psutil.Error):
                times = process.cpu_times()
                total += times.user + times.system
        return total

    def _family(self) -> list[psutil.Process]:
        assert self._process is not None
        with contextlib.suppress(psutil.Error):
            return [self._process, *self._process.children(recursive=True)]
        return []


def _percentiles(values: list[float]) -> list[float] | None:
    """The 50th, 95th and 99th percentile."""
    return [round(float(value), 3) for value in np.percentile(values, (50, 95, 99))] if values else None
