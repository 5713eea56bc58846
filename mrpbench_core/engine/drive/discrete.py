"""Executes a run in a simulator that counts steps: one call, by the simulator's own clock."""

import math
from typing import cast

import numpy as np

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.api.discrete import DiscreteResult, DiscreteRun, DiscreteSimulator
from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.engine.contract_checks import check_returned
from mrpbench_core.engine.drive.execute import TimedExecution
from mrpbench_core.engine.drive.outputs import Outputs
from mrpbench_core.engine.drive.plan import budget_of
from mrpbench_core.engine.drive.replanning import call_timing
from mrpbench_core.engine.execution.control_loop import ExecutionResult
from mrpbench_core.engine.execution.recorder import IRREGULAR, TASKS
from mrpbench_core.engine.stage import RunInputs
from mrpbench_core.model.runs.run import RunContext


class DiscreteExecution(TimedExecution):
    """Lets the simulator do the tasks of a run, and records what it returns.

    Args:
        inputs: of the run.
        context: of the run.
        stream: of its tasks.
    """

    def __init__(self, inputs: RunInputs, context: RunContext, stream: TaskStream) -> None:
        super().__init__(inputs, context)
        self._stream = stream

    def _run(self, outputs: Outputs) -> ExecutionResult:
        inputs, context = self._inputs, self.context
        config, timing = inputs.config, inputs.timing
        simulator = cast("DiscreteSimulator", config.simulator)
        limit = min(config.replanning.budget or math.inf, config.limits.planning)
        run = DiscreteRun(
            world=context.world,
            fleet=context.fleet,
            scenario=context.scenario,
            stream=self._stream,
            planner=config.planner,
            duration=config.limits.execution,
            seed=budget_of(config).seed,
            limit=limit,
            iterations=config.limits.iterations,
            rate=config.recording.rate,
            exports=inputs.paths.exports,
        )
        result = check_returned(simulator, simulator.execute(run), DiscreteResult)
        timing["preprocessing_s"] = result.preprocessing
        channels = {name: np.empty((0, *shape), kind) for name, (kind, shape) in (IRREGULAR | TASKS).items()}
        channels |= result.channels
        if "time" not in channels or not len(channels["time"]):
            raise BrokenContractError("the simulator returned no samples", "simulator")
        if len(result.calls):
            timing.update(call_timing(list(result.calls), limit))
        timing["replanning_overruns"] = result.overruns
        timing["clock_bound"] = config.limits.iterations is None
        outputs.write(channels)
        return ExecutionResult(succeeded=True, simulated_s=float(channels["time"][-1]))
