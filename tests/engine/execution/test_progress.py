"""Messages about the progress of an execution are few, and say how far it is."""

import numpy as np

from mrpbench_core.engine.execution import progress
from mrpbench_core.engine.execution.progress import INTERVAL, ExecutionProgress


def test_it_is_told_at_most_once_in_an_interval_of_wall_time(monkeypatch):
    clock, told = [100.0], []
    monkeypatch.setattr(progress.time, "monotonic", lambda: clock[0])
    tell = ExecutionProgress(lambda **facts: told.append(facts), limit_s=600.0)
    for step in range(1000):
        clock[0] = 100.0 + step * INTERVAL / 100
        tell(step / 20, np.array([True, step > 300, False]))
    assert len(told) == 9
    assert told[0] == {"simulated_s": 5.0, "limit_s": 600.0, "arrived": 1, "robots": 3}
    assert told[-1] == {"simulated_s": 45.0, "limit_s": 600.0, "arrived": 2, "robots": 3}
