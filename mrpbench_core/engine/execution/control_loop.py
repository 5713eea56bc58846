"""The loop in which every plan is executed: the steps of a control period, whatever moves the robots."""

from abc import ABC, abstractmethod
from collections.abc import Mapping

import attrs

from mrpbench_core.engine.execution.delays import DelayStream
from mrpbench_core.engine.execution.faults import FaultState
from mrpbench_core.engine.execution.recorder import Recorder
from mrpbench_core.model.execution.state import State


@attrs.frozen(kw_only=True)
class ExecutionResult:
    """The end of an execution."""

    succeeded: bool
    """Every robot completed the last move of its path; with tasks that come over time: no robot gave up, and
    the planner found plans."""
    gave_up: tuple[str, ...] = ()
    """Robots that gave up, each with the cause if the navigator named one."""
    simulated_s: float
    contradiction: str | None = None
    """What the navigator reports and the true poses contradict."""
    unarrived: Mapping[int, str] = attrs.field(factory=dict)
    """Why robots did not arrive, by robot; only with faults."""


class ControlLoop(ABC):
    """Executes a plan, control period by control period.

    Args:
        period: simulated seconds between two control periods.
        limit_s: simulated seconds after which the execution ends.
        faults: what fails.
        delays: stops and speeds of the robots.
        recorder: of what happens; None = nothing is recorded.
    """

    def __init__(
        self, period: float, limit_s: float, faults: FaultState, delays: DelayStream, recorder: Recorder | None
    ) -> None:
        self._period, self._limit_s = period, limit_s
        self._faults, self._delays, self._recorder = faults, delays, recorder
        self._disturbed = bool(delays) or bool(faults)
        self._step = 0
        self._now = 0.0
        """Simulated seconds at the beginning of this control period."""
        self._state: State
        """True poses of the robots now; of one execution only."""

    def run(self) -> ExecutionResult:
        """Run until every robot has arrived or given up, or the simulated time is over."""
        while True:
            self._begin()
            self._sense()
            self._dispatch()
            self._drive()
            result = self._result()
            if (recorder := self._recorder) is not None:
                self._record(recorder, last=result is not None)
                if result is not None:
                    recorder.flush()
            if result is not None:
                return result
            self._advance()
            self._step += 1
            self._now = self._step * self._period

    def _begin(self) -> None:
        """Let faults and stops begin and end; record them and the contacts of the last control period, by time."""
        if self._disturbed:
            begun, faults = self._delays.begun(self._now), self._faults.update(self._now)
            if self._recorder is not None:
                self._recorder.events(sorted((*begun, *faults), key=lambda event: event.stamp))
        if self._recorder is not None and self._step:
            self._recorder.contacts(self._now, self._state)

    def _sense(self) -> None:  # noqa: B027 - without physics there is nothing to sense
        """Take in what sensors and localizers say."""

    @abstractmethod
    def _dispatch(self) -> None:
        """Release segments and grant resources."""

    @abstractmethod
    def _drive(self) -> None:
        """Decide how the robots move in this control period."""

    @abstractmethod
    def _result(self) -> ExecutionResult | None:
        """Return the end of the execution, or None if it continues."""

    @abstractmethod
    def _record(self, recorder: Recorder, last: bool) -> None:
        """Record this control period, the last one in any case."""

    @abstractmethod
    def _advance(self) -> None:
        """Let one control period pass."""
