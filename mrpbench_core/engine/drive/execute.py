"""Executes a run, whatever moves its robots, and says how that ended."""

import time
from abc import ABC, abstractmethod
from collections.abc import Mapping

from mrpbench_core.api.dispatcher import DispatchError
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.drive.outputs import Outputs
from mrpbench_core.engine.execution.control_loop import ExecutionResult
from mrpbench_core.engine.execution.resources import ExecutionError
from mrpbench_core.engine.stage import RunEnded, RunInputs
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.runs.status import RunStatus, Stage


class Execution(ABC):
    """What is executed, and by which clock.

    Args:
        inputs: of the run.
        context: of the run, for the recording.
    """

    def __init__(self, inputs: RunInputs, context: RunContext) -> None:
        self._inputs, self.context = inputs, context
        self.unarrived: dict[str, str] = {}
        """Why robots did not arrive, by their names, once it is over."""

    @abstractmethod
    def execute(self, outputs: Outputs) -> RunEnded | None:
        """Execute it, and write what happens; return how it ended, None if every robot arrived."""


class PlanOnly(Execution):
    """Nothing is executed; the recording has what was planned.

    Args:
        inputs: of the run.
        context: of the run.
        failure: why there is no plan.
    """

    def __init__(self, inputs: RunInputs, context: RunContext, failure: RunEnded | None) -> None:
        super().__init__(inputs, context)
        self._failure = failure

    def execute(self, outputs: Outputs) -> RunEnded | None:  # noqa: ARG002, D102 - there is nothing to write
        return self._failure


class TimedExecution(Execution):
    """An execution of which the wall time is measured."""

    def execute(self, outputs: Outputs) -> RunEnded | None:  # noqa: D102 - as above
        inputs = self._inputs
        outputs.begin()
        began = time.perf_counter()
        inputs.hooks.call("mrpbench_executing", context=self.context)
        try:
            result = self._run(outputs)
        except (DispatchError, ExecutionError) as error:
            return RunEnded(RunStatus.EXECUTION_ABORTED, Stage.EXECUTION, str(error))
        finally:
            inputs.hooks.call("mrpbench_executed")
        inputs.timing["execution_wall_s"] = time.perf_counter() - began
        inputs.timing["real_time_factor"] = result.simulated_s / inputs.timing["execution_wall_s"]
        return _failure(result, inputs.config, self.unarrived)

    @abstractmethod
    def _run(self, outputs: Outputs) -> ExecutionResult:
        """Execute it.

        Raises:
            DispatchError: the dispatcher refuses the plan.
            ExecutionError: a component asks for what does not exist.
        """


def _failure(result: ExecutionResult, config: RunConfig, unarrived: Mapping[str, str]) -> RunEnded | None:
    """Return the status of the run, None if every robot arrived."""
    if result.succeeded:
        return None
    if config.faults and unarrived:
        causes = _first(unarrived)
        if result.simulated_s < config.limits.execution:
            return RunEnded(RunStatus.EXECUTION_ABORTED, Stage.EXECUTION, f"not all robots can arrive: {causes}")
        late = f"not all robots arrived within {config.limits.execution:g} simulated seconds: {causes}"
        return RunEnded(RunStatus.GOALS_MISSED, Stage.EXECUTION, late)
    if result.gave_up:
        causes = "; ".join(result.gave_up[:3]) + ("; …" if len(result.gave_up) > 3 else "")
        said = f"a robot gave up before all had arrived: {causes}"
        return RunEnded(RunStatus.EXECUTION_ABORTED, Stage.EXECUTION, said)
    missed = "not all robots arrived" if config.tasks is None else "no plan was found and no task was done"
    late = f"{missed} within {config.limits.execution:g} simulated seconds"
    late += f": {causes}" if (causes := _first(unarrived)) else ""
    return RunEnded(RunStatus.GOALS_MISSED, Stage.EXECUTION, result.contradiction or late)


def _first(unarrived: Mapping[str, str]) -> str:
    """The reasons of the first three robots."""
    each = [f"{name} {reason}" for name, reason in unarrived.items()]
    return "; ".join(each[:3]) + (f"; … ({len(each)} robots)" if len(each) > 3 else "")
