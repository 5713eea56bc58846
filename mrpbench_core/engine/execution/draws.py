"""Executes a plan under further draws of its delays."""

import copy
from collections.abc import Iterator

from mrpbench_core.config.delays import Delays
from mrpbench_core.engine.execution.delays import DelayStream, DrawnDelays
from mrpbench_core.engine.execution.faults import FaultState
from mrpbench_core.engine.execution.repeated_loop import RepeatedLoop
from mrpbench_core.engine.execution.schedule import Schedule
from mrpbench_core.engine.execution.schedule_loop import ScheduleLoop
from mrpbench_core.engine.execution.worst_case import Adversary
from mrpbench_core.model.common.arrays import Float

_AT_ONCE = 1 << 14
"""Robots of all executions at once; with more of them, an execution takes no less time (`benchmarks/draws.py`)."""


class Draws:
    """The draws of the delays of a run; the same adversary attacks in all of them.

    Args:
        settings: of the delays.
        robots: their number.
        seeds: seed and repeat of the run.
        adversary: as it is before an execution.
    """

    def __init__(self, settings: Delays, robots: int, seeds: tuple[int, int], adversary: Adversary | None) -> None:
        self._settings, self._robots, self._seeds, self._adversary = settings, robots, seeds, adversary

    def stream(self, draw: int = 0) -> DelayStream:
        """The delays of one draw."""
        return DelayStream(self._settings, self._robots, *self._seeds, copy.deepcopy(self._adversary), draw)

    def execute(self, schedule: Schedule, faults: FaultState, limit_s: float) -> Iterator[tuple[Float, Float]]:
        """Execute the draws after the first one.

        Args:
            schedule: the plan, and who releases it.
            faults: begin anew in each execution.
            limit_s: simulated seconds of each execution.

        Yields:
            Arrival f8[d,n] and waiting f8[d,n] of the next d executions; see `ScheduleLoop`.
        """
        size = max(1, _AT_ONCE // max(1, self._robots))
        for first in range(1, self._settings.draws, size):
            draws = range(first, min(first + size, self._settings.draws))
            session = None if faults else schedule.repeated(len(draws))
            if session is not None:
                drawn = DrawnDelays(self._settings, self._robots, *self._seeds, draws)
                adversaries = [copy.deepcopy(self._adversary) for _ in draws] if self._adversary else []
                yield RepeatedLoop(schedule, session, drawn, adversaries).run(limit_s)
                continue
            for draw in draws:
                again = FaultState(faults.settings, faults.events, self._robots)
                loop = ScheduleLoop(schedule, self.stream(draw), faults=again)
                loop.run(limit_s)
                yield loop.arrival[None], loop.waiting[None]
