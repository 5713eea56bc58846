"""Drives a plan in the simulator, and writes what happens to the recording and the exports."""

import time
from pathlib import Path
from typing import Any

import numpy as np

from mrpbench_core.api.dispatcher import DispatchError
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.concierge import MissionError
from mrpbench_core.engine.exports import Exports
from mrpbench_core.engine.measure import measure
from mrpbench_core.engine.mission import Outcome, Stack, execute_plan
from mrpbench_core.engine.noise import Disturbances
from mrpbench_core.engine.observers import Observers
from mrpbench_core.engine.planning import budget_of, call_planner, judge
from mrpbench_core.engine.preparation import Announce, Ended
from mrpbench_core.engine.recorder import Recorder
from mrpbench_core.engine.replanning import Replans
from mrpbench_core.engine.routes import Router, placements
from mrpbench_core.engine.seeds import seed_of
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
) -> tuple[Ended | None, dict[str, str]]:
    """Execute the plan; says how it ended if not every robot arrived, and which exports failed, with the reasons.

    Nothing half-written keeps a final name.
    """
    announce(Stage.EXECUTION, {})
    writer = RecordingWriter(paths.recording, context)
    exports = Exports()

    def sink(chunk: Chunk) -> None:
        writer.write({name: rows for name, rows in chunk.items() if config.recording.scans or name[:5] != "scan_"})
        exports.write(chunk)

    ended: Ended | None
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
    except (DispatchError, MissionError) as error:
        ended = Ended(RunStatus.EXECUTION_ABORTED, Stage.EXECUTION, str(error))
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
) -> Replans:
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
    return Replans(config.replanning, ask, router, context.problem, context.result.plan)


def _simulate(
    config: RunConfig,
    context: RunContext,
    recorder: Recorder,
    replans: Replans,
    observers: Observers,
) -> Outcome:
    assert config.simulator is not None
    stack = Stack.of(config)
    seeds = (config.seed, config.repeat)
    poses = placements(context.routes, context.scenario.start[:, 2])
    noise = Disturbances(config.noise, context.fleet, poses, context.period, *seeds)
    seed = seed_of(*seeds, "simulator")
    levels = np.array([route.level[0] for route in context.routes], np.int16)
    with config.simulator.open(context.world, context.fleet, poses, seed, context.period, levels=levels) as simulation:
        if not np.array_equal(simulation.state.level, levels):
            raise MissionError("the simulator knows no levels but the lowest, and robots start on others")
        return execute_plan(
            context, stack, simulation, noise, recorder, replans, config.limits.execution, seeds, observers.stepped
        )


def _judge(outcome: Outcome, config: RunConfig) -> Ended | None:
    if outcome.arrived:
        return None
    if outcome.aborted:
        return Ended(RunStatus.EXECUTION_ABORTED, Stage.EXECUTION, "a robot gave up before all had arrived")
    limit = config.limits.execution
    return Ended(RunStatus.GOALS_MISSED, Stage.EXECUTION, f"not all robots arrived within {limit:g} simulated seconds")
