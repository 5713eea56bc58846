"""Executes a plan in its own durations, without physics, under each draw of the delays."""

import numpy as np

from mrpbench_core.engine.drive.outputs import Outputs
from mrpbench_core.engine.drive.planned import PlannedExecution
from mrpbench_core.engine.execution.control_loop import ExecutionResult
from mrpbench_core.engine.execution.schedule import Schedule
from mrpbench_core.engine.execution.schedule_loop import ScheduleLoop


class ScheduledExecution(PlannedExecution):
    """Records the first draw, and the times of all."""

    def _run(self, outputs: Outputs) -> ExecutionResult:
        config, recorder = self._inputs.config, outputs.recorder()
        assert config.dispatcher is not None
        limit, faults, draws = config.limits.execution, self._faults, self._draws()
        schedule = Schedule(self.context, config.dispatcher)
        loop = ScheduleLoop(schedule, draws.stream(), limit, recorder, faults)
        result = self._finished(loop, recorder)
        times = [(loop.arrival, loop.waiting), *draws.execute(schedule, faults, limit)]
        if len(times) > 1:
            arrival, waiting = (np.concatenate(column) for column in zip(*times, strict=True))
            number = np.arange(len(arrival), dtype=np.int32)
            outputs.write({"draw": number, "draw_arrival": arrival, "draw_waiting": waiting})
        return result
