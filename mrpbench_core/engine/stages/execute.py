"""Drives a plan in the simulator, and writes what happens to the recording and the exports."""

import time
from pathlib import Path
from typing import Any

import numpy as np

from mrpbench_core.api.dispatcher import DispatchError
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.execution.facility_manager import ExecutionError
from mrpbench_core.engine.execution.loop import ExecutionResult, Stack, execute_plan
from mrpbench_core.engine.execution.noise import Disturbances
from mrpbench_core.engine.execution.recorder import Recorder
from mrpbench_core.engine.execution.replanning import Replanner
from mrpbench_core.engine.execution.routes import Router, placements
from mrpbench_core.engine.observers import Observers
from mrpbench_core.engine.seeds import seed_of
from mrpbench_core.engine.stage import Announce, RunEnded
from mrpbench_core.engine.stages.export import Exports
from mrpbench_core.engine.stages.judge import judge
from mrpbench_core.engine.stages.measure import measure
from mrpbench_core.engine.stages.plan import budget_of, call_planner
from mrpbench_core.model.plan import PlanResult, PlanStatus
from mrpbench_core.model.problem import Problem
from mrpbench_core.model.recording import Chunk
from mrpbench_core.model.run import FinishedRun, RunContext
from mrpbench_core.model.status import RunStatus, Stage
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording, RecordingWriter


def drive(
    config: RunConfig,
    context: RunContext,
    router: Router,
    paths: RunPaths,
    announce: Announce,
    timing: dict[str, Any],
    observers: Observers,
) -> tuple[RunEnded | None, dict[str, str]]:
    """Execute the plan; says how it ended if not every robot arrived, and which exports failed, with the reasons.

    Nothing half-written keeps a final name.
    """
    announce(Stage.EXECUTION, {})
    writer = RecordingWriter(paths.recording, context)
    exports = Exports()

    def sink(chunk: Chunk) -> None:
        writer.write({name: rows for name, rows in chunk.items() if config.recording.scans or name[:5] != "scan_"})
        exports.write(chunk)

    ended: RunEnded | None
    try:
        exports.open(config.export, context, paths.exports)
        wants_scans = config.recording.scans or bool(config.export)
        recorder = Recorder(config.recording.rate, context.period, sink, wants_scans)
        began = time.perf_counter()
        replans = _replans(config, context, router, announce, timing)
        observers.executing(context=context)
        outcome = _simulate(config, context, recorder, replans, observers)
        ended = _judge(outcome, config)
        timing["execution_wall_s"] = time.perf_counter() - began
        timing["real_time_factor"] = outcome.simulated_s / timing["execution_wall_s"]
    except (DispatchError, ExecutionError) as error:
        ended = RunEnded(RunStatus.EXECUTION_ABORTED, Stage.EXECUTION, str(error))
    except BaseException:
        writer.discard()
        exports.abandon()
        raise
    finally:
        observers.executed()
    recorder.flush()
    writer.close()
    announce(Stage.EXPORT, {})
    exports.close()
    return ended, exports.failed


def measure_recording(config: RunConfig, file: Path) -> tuple[dict[str, Any], dict[str, str]]:
    """Metrics of a stored recording, and why some cannot be measured."""
    recording = Recording(file)
    try:
        run = FinishedRun(context=recording.context(), executed=True, channels=recording.channels)
        return measure(config.metrics, run)
    finally:
        recording.close()


def _replans(
    config: RunConfig, context: RunContext, router: Router, announce: Announce, timing: dict[str, Any]
) -> Replanner:
    def ask(problem: Problem) -> tuple[PlanResult, str | None]:
        if reason := config.planner.skip(problem):
            return PlanResult(status=PlanStatus.GAVE_UP), f"the planner {reason}"
        announce(Stage.REPLANNING, {"limit_s": config.limits.planning})
        result, spent = call_planner(config.planner, problem, budget_of(config))
        announce(Stage.EXECUTION, {})
        timing["replanning_s"] = timing.get("replanning_s", 0.0) + spent["planning_s"]
        timing["clock_bound"] = timing.get("clock_bound", False) or spent["clock_bound"]
        result, fault = judge(config.planner, problem, result)
        return result, fault or (f"the planner ended with {result.status}" if result.plan is None else None)

    assert context.result.plan is not None
    return Replanner(config.replanning, ask, router, context.problem, context.result.plan)


def _simulate(
    config: RunConfig,
    context: RunContext,
    recorder: Recorder,
    replans: Replanner,
    observers: Observers,
) -> ExecutionResult:
    assert config.simulator is not None
    stack = Stack.of(config)
    seeds = (config.seed, config.repeat)
    poses = placements(context.routes, context.scenario.start[:, 2])
    noise = Disturbances(config.noise, context.fleet, poses, context.period, *seeds)
    seed = seed_of(*seeds, "simulator")
    levels = np.array([route.level[0] for route in context.routes], np.int16)
    with config.simulator.open(context.world, context.fleet, poses, seed, context.period, levels=levels) as simulation:
        if not np.array_equal(simulation.state.level, levels):
            raise ExecutionError("the simulator knows no levels but the lowest, and robots start on others")
        return execute_plan(
            context, stack, simulation, noise, recorder, replans, config.limits.execution, seeds, observers.stepped
        )


def _judge(outcome: ExecutionResult, config: RunConfig) -> RunEnded | None:
    if outcome.arrived:
        return None
    if outcome.aborted:
        return RunEnded(RunStatus.EXECUTION_ABORTED, Stage.EXECUTION, "a robot gave up before all had arrived")
    limit = config.limits.execution
    return RunEnded(
        RunStatus.GOALS_MISSED, Stage.EXECUTION, f"not all robots arrived within {limit:g} simulated seconds"
    )
