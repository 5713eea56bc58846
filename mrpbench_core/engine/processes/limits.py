"""Decides when a run must be ended from outside, and with which status."""

import time

from mrpbench_core.engine.processes.job import Failure, Job
from mrpbench_core.model.runs.status import RunStatus, Stage

GRACE_S = 1.0
"""Wall seconds that a stage may overrun its own limit before it is killed, plus a tenth of the limit.

A planner that looks at its clock returns well within it.
"""


class LimitMonitor:
    """Follows one run through its stages and reports when it exceeds a limit."""

    def __init__(self, job: Job) -> None:
        self._job = job
        self._began = self._stage_began = time.monotonic()
        self._limit: float | None = None
        self.stage = Stage.START
        self._scenario_id: str | None = None

    def enter(self, stage: Stage, limit_s: float | None, scenario_id: str | None) -> None:
        """Note that a stage begins."""
        self.stage = stage
        self._stage_began = time.monotonic()
        self._limit = limit_s
        self._scenario_id = scenario_id or self._scenario_id

    def patience(self) -> float:
        """Seconds until the next limit."""
        now = time.monotonic()
        left = self._began + self._job.wall_s - now
        if self._limit is not None:
            left = min(left, self._stage_began + self._grace(self._limit) - now)
        return max(0.0, left)

    def overrun(self) -> Failure | None:
        """The failure of a run that exceeded a time limit, or None."""
        now = time.monotonic()
        if now - self._began >= self._job.wall_s:
            return self.failure(RunStatus.WALL_TIMEOUT, f"the run took longer than limits.wall, {self._job.wall_s:g} s")
        if self._limit is not None and now - self._stage_began >= self._grace(self._limit):
            status = (
                RunStatus.PLAN_TIMEOUT if self.stage in (Stage.PLANNING, Stage.REPLANNING) else RunStatus.WALL_TIMEOUT
            )
            return self.failure(status, f"did not return within {self._limit:g} s and was ended")
        return None

    def overweight(self, memory: int) -> Failure | None:
        """The failure of a run that exceeds its memory limit, or None."""
        if memory <= self._job.memory_bytes:
            return None
        held, allowed = memory / 2**20, self._job.memory_bytes / 2**20
        return self.failure(RunStatus.OUT_OF_MEMORY, f"held {held:.0f} MiB, limits.memory allows {allowed:.0f} MiB")

    def failure(self, status: RunStatus, message: str) -> Failure:
        """A failure in the current stage."""
        seconds = time.monotonic() - self._stage_began
        return Failure(status=status, stage=self.stage, message=message, seconds=seconds, scenario_id=self._scenario_id)

    @staticmethod
    def _grace(limit_s: float) -> float:
        return limit_s * 1.1 + GRACE_S
