"""Executes a plan under further draws of its delays."""

from collections.abc import Iterator

from mrpbench_core.config.delays import Delays
from mrpbench_core.engine.execution.delays import DelayStream
from mrpbench_core.engine.execution.faults import FaultState
from mrpbench_core.engine.execution.schedule import Schedule
from mrpbench_core.engine.execution.schedule_loop import ScheduleLoop
from mrpbench_core.engine.execution.worst_case import Adversary
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.model.common.arrays import Float

_AT_ONCE = 1 << 14
"""Robots of all executions at once; with more of them, an execution takes no less time (`benchmarks/draws.py`)."""


class DelayDraws:
    """The draws of the delays of a run; the same adversary attacks in all of them.

    Args:
        settings: of the delays.
        robots: their number.
        seeds: of the run.
        adversary: as it is before an execution.
    """

    def __init__(self, settings: Delays, robots: int, seeds: Seeds, adversary: Adversary | None) -> None:
        self._settings, self._robots, self._seeds, self._adversary = settings, robots, seeds, adversary

    def stream(self, *draws: int) -> DelayStream:
        """The delays of some draws, by default of the first one."""
        return DelayStream(self._settings, self._robots, self._seeds, draws or (0,), self._adversary)

    def execute(self, schedule: Schedule, faults: FaultState, limit_s: float) -> Iterator[tuple[Float, Float]]:
        """Execute the draws after the first one, as many at once as the dispatcher allows.

        Args:
            schedule: the plan, and who releases it.
            faults: begin anew in each execution.
            limit_s: simulated seconds of each execution.

        Yields:
            Arrival f8[d,n] and waiting f8[d,n] of the next d executions; see `ScheduleLoop`.
        """
        size = max(1, _AT_ONCE // max(1, self._robots))
        first, count = 1, self._settings.draws
        while first < count:
            batch = None if faults else schedule.batch(min(size, count - first))
            draws = range(first, min(first + size, count) if batch else first + 1)
            again = FaultState(faults.settings, faults.events, self._robots)
            loop = ScheduleLoop(schedule, self.stream(*draws), limit_s, faults=again, batch=batch)
            loop.run()
            yield loop.arrival, loop.waiting
            first = draws.stop
