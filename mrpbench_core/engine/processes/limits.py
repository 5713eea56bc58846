"""Decides when a job must be ended from outside, and with which status."""

import time

from mrpbench_core.engine.processes.job import Failure
from mrpbench_core.model.runs.status import RunStatus, Stage

GRACE_S = 1.0
"""Wall seconds that a stage may overrun its own limit before it is killed, plus a tenth of the limit.

A planner that looks at its clock returns well within it.
"""


IMPORT_S = 60.0
"""Wall seconds that the import of one plugin may take."""


class LimitMonitor:
    """Follows one job through its stages and reports when it exceeds a limit.

    Args:
        wall_s: wall seconds that the job may take.
        memory_bytes: resident memory that all its processes may hold together.
    """

    def __init__(self, wall_s: float, memory_bytes: int) -> None:
        self._wall_s = wall_s
        self._memory_bytes = memory_bytes
        self._began = self._stage_began = time.monotonic()
        self._limit: float | None = None
        self.stage = Stage.START
        self._scenario_id: str | None = None
        self._importing: str | None = None
        self._import_began = self._began

    def enter(self, stage: Stage, at: float, limit_s: float | None, scenario_id: str | None) -> None:
        """Note that a stage began `at` monotonic seconds, as the job says: not before the last one, nor in future."""
        self.stage = stage
        self._stage_began = min(max(self._stage_began, at), time.monotonic())
        self._limit = limit_s
        self._scenario_id = scenario_id or self._scenario_id

    def importing(self, plugin: str | None) -> None:
        """Note that the import of a plugin begins or, with None, ends."""
        self._importing = plugin
        self._import_began = time.monotonic()

    def patience(self) -> float:
        """Seconds until the next limit."""
        now = time.monotonic()
        left = self._began + self._wall_s - now
        if self._limit is not None:
            left = min(left, self._stage_began + self._grace(self._limit) - now)
        if self._importing is not None:
            left = min(left, self._import_began + IMPORT_S - now)
        return max(0.0, left)

    def overrun(self) -> Failure | None:
        """The failure of a job that exceeded a time limit, or None."""
        now = time.monotonic()
        if now - self._began >= self._wall_s:
            return self.failure(RunStatus.WALL_TIMEOUT, f"the run took longer than limits.wall, {self._wall_s:g} s")
        if self._limit is not None and now - self._stage_began >= self._grace(self._limit):
            status = (
                RunStatus.PLAN_TIMEOUT if self.stage in (Stage.PLANNING, Stage.REPLANNING) else RunStatus.WALL_TIMEOUT
            )
            return self.failure(status, f"did not return within {self._limit:g} s and was ended")
        if self._importing is not None and now - self._import_began >= IMPORT_S:
            return self.failure(RunStatus.CRASHED, f"its import did not end within {IMPORT_S:g} s")
        return None

    def overweight(self, memory: int) -> Failure | None:
        """The failure of a job that exceeds its memory limit, or None."""
        if memory <= self._memory_bytes:
            return None
        return self.failure(RunStatus.OUT_OF_MEMORY, f"the run held {memory / 2**20:.0f} MiB; {self.allowance}")

    @property
    def allowance(self) -> str:
        """What the run may hold, and the option that says so."""
        return f"the option limits.memory allows {self._memory_bytes / 2**20:.0f} MiB"

    def failure(self, status: RunStatus, message: str, lost: bool = False) -> Failure:
        """A failure in the current stage."""
        if self._importing is not None:
            message = f"while {self._importing} was imported: {message}"
        return Failure(
            status=status,
            stage=self.stage,
            message=message,
            seconds=time.monotonic() - self._stage_began,
            scenario_id=self._scenario_id,
            lost=lost,
        )

    @staticmethod
    def _grace(limit_s: float) -> float:
        return limit_s * 1.1 + GRACE_S
