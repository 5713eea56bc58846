"""Limits of a job, by the clock of its supervisor."""

import math
import time

import pytest

from mrpbench_core.engine.processes.limits import LimitMonitor
from mrpbench_core.model.runs.status import RunStatus, Stage


@pytest.mark.parametrize(("said", "seconds"), [(-5, 1.0), (0.96, 0.04), (1.3, 0.0), (math.inf, 0.0), (math.nan, 1.0)])
def test_a_job_cannot_give_itself_more_time_than_its_stage_has(monkeypatch, said, seconds):
    began = now = 1000.0
    monkeypatch.setattr(time, "monotonic", lambda: now)
    monitor = LimitMonitor(wall_s=60.0, memory_bytes=1)
    now += 1.0
    monitor.enter(Stage.PLANNING, began + said, 2.0, None)
    assert monitor.failure(RunStatus.CRASHED, "it ended").seconds == pytest.approx(seconds)
    now += 2.0 * 1.1 + 1.0
    overrun = monitor.overrun()
    assert overrun is not None
    assert overrun.status == RunStatus.PLAN_TIMEOUT
