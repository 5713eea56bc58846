"""Executes a run in a simulator that counts steps, and writes what happens to the recording."""

import math
import time
from typing import cast

import numpy as np

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.api.discrete import DiscreteResult, DiscreteRun, DiscreteSimulator
from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.engine.contract_checks import check_returned
from mrpbench_core.engine.drive.execute import call_timing
from mrpbench_core.engine.drive.export import Exports
from mrpbench_core.engine.drive.plan import budget_of
from mrpbench_core.engine.execution.recorder import IRREGULAR, TASKS
from mrpbench_core.engine.stage import RunEnded, RunInputs
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.runs.status import Stage
from mrpbench_core.store.recording import RecordingWriter


def execute_steps(inputs: RunInputs, context: RunContext, stream: TaskStream) -> tuple[RunEnded | None, dict[str, str]]:
    """Execute the tasks of a run; returns what `execute_plan` returns."""
    config, timing = inputs.config, inputs.timing
    simulator = cast("DiscreteSimulator", config.simulator)
    inputs.announce(Stage.EXECUTION, {})
    limit = min(config.replanning.budget or math.inf, config.limits.planning)
    run = DiscreteRun(
        world=context.world,
        fleet=context.fleet,
        scenario=context.scenario,
        stream=stream,
        planner=config.planner,
        duration=config.limits.execution,
        seed=budget_of(config).seed,
        limit=limit,
        iterations=config.limits.iterations,
        rate=config.recording.rate,
        exports=inputs.paths.exports,
    )
    began = time.perf_counter()
    result = check_returned(simulator, simulator.execute(run), DiscreteResult)
    timing["preprocessing_s"] = result.preprocessing
    timing["execution_wall_s"] = time.perf_counter() - began
    channels = {name: np.empty((0, *shape), kind) for name, (kind, shape) in (IRREGULAR | TASKS).items()}
    channels |= result.channels
    if "time" not in channels or not len(channels["time"]):
        raise BrokenContractError("the simulator returned no samples", "simulator")
    timing["real_time_factor"] = float(channels["time"][-1]) / timing["execution_wall_s"]
    if len(result.calls):
        timing.update(call_timing(list(result.calls), limit))
    timing["replanning_overruns"] = result.overruns
    timing["clock_bound"] = config.limits.iterations is None
    writer, exports = RecordingWriter(inputs.paths.recording, context, inputs.instance), Exports()
    try:
        exports.open(config.export, context, inputs.paths.exports)
        writer.write(channels)
        exports.write(channels)
    except BaseException:
        writer.discard()
        exports.abandon()
        raise
    writer.close()
    inputs.announce(Stage.EXPORT, {})
    exports.close()
    return None, exports.failed
