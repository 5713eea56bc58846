"""One run from its configuration to its record, in this process."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from mrpbench_core.api.dispatcher import DispatchError
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.measure import measure
from mrpbench_core.engine.mission import MissionError, Outcome, Stack, execute_plan
from mrpbench_core.engine.noise import SensorNoise
from mrpbench_core.engine.planning import STATUS, call_planner, judge
from mrpbench_core.engine.preparation import Announce, Ended, Setting, assign, pose_problem, set_scene
from mrpbench_core.engine.recorder import Recorder
from mrpbench_core.engine.routes import build_routes, placements
from mrpbench_core.engine.seeds import seed_of
from mrpbench_core.model.execution import State
from mrpbench_core.model.plan import Budget, PlanResult
from mrpbench_core.model.problem import Problem
from mrpbench_core.model.recording import Chunk
from mrpbench_core.model.run import FinishedRun, RunContext
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording, RecordingWriter

CONTROL_RATE = 20.0
"""Hz of simulated time: how often dispatcher, navigator and controller act (Nav2's default controller frequency)."""

Observe = Callable[..., Any]


@attrs.frozen(kw_only=True)
class Observers:
    """Hook callers of the run's process; they watch and cannot change a result."""

    planned: Callable[[Problem, PlanResult], Any] = lambda problem, result: None  # noqa: ARG005
    stepped: Callable[[float, State], Any] = lambda now, state: None  # noqa: ARG005


def execute(
    config: RunConfig, run_id: str, paths: RunPaths, announce: Announce, observers: Observers | None = None
) -> dict[str, Any]:
    """Execute one run and return its record, less `attempt` and what only the invoking process knows.

    The recording and exports are complete under their final names when this returns.

    Raises:
        InputError: the configuration does not fit its world, robots or files.
    """
    observers = observers or Observers()
    record: dict[str, Any] = {"run_id": run_id, "scenario_id": None, "seed": config.seed, "repeat": config.repeat}
    timing: dict[str, Any] = {}
    metrics: dict[str, Any] = {}
    try:
        setting = set_scene(config, announce)
        record["scenario_id"] = setting.scenario.id
        assigned = assign(config, setting, announce, timing)
        problem = pose_problem(setting, assigned)
        context, ended = _plan(config, setting, assigned, problem, run_id, announce, timing, observers)
        if ended is None and config.simulator is not None:
            outcome, metrics = _execute(config, context, paths, announce, timing, observers)
            record |= outcome
        else:
            announce("metrics", {})
            metrics, _ = measure(config.metrics, FinishedRun(context=context, executed=False, timing=timing))
            record |= {"status": "succeeded"} if ended is None else _failure(ended)
    except Ended as ended:
        record |= _failure(ended)
    return record | {"metrics": metrics, "timing": timing}


def _failure(ended: Ended) -> dict[str, Any]:
    return {"status": ended.status, "error": {"stage": ended.stage, "message": str(ended)}}


def _plan(
    config: RunConfig,
    setting: Setting,
    assigned: tuple[int, ...],
    problem: Problem,
    run_id: str,
    announce: Announce,
    timing: dict[str, Any],
    observers: Observers,
) -> tuple[RunContext, Ended | None]:
    """Plan; the second value says how the run ended if there is nothing to execute."""
    if reason := config.planner.skip(problem):
        raise Ended("skipped", "planning", reason)
    announce("planning", {"limit_s": config.limits.planning})
    budget = Budget(wall_s=config.limits.planning, memory_bytes=config.limits.memory)
    result, spent = call_planner(config.planner, problem, budget)
    timing |= spent
    result, fault = judge(config.planner, problem, result)
    observers.planned(problem, result)
    ended = None
    if fault is not None:
        ended = Ended("plan_invalid", "planning", fault)
        result = attrs.evolve(result, plan=None)
    elif result.plan is None:
        ended = Ended(STATUS[result.status], "planning", f"the planner ended with {result.status}")
    yaw = np.array([setting.scenario.tasks[task].goals[-1, 2] if task >= 0 else np.nan for task in assigned])
    routes = () if result.plan is None else build_routes(problem, result.plan, yaw, _speed_limits(setting))
    context = RunContext(
        run_id=run_id,
        world=setting.world,
        fleet=setting.fleet,
        scenario=setting.scenario,
        problem=problem,
        result=result,
        routes=routes,
        goal=tuple(tuple(float(number) for number in route.waypoint[-1]) for route in routes),
        period=1 / CONTROL_RATE,
        assigned=assigned,
    )
    return context, ended


def _speed_limits(setting: Setting) -> np.ndarray:
    """m/s on each edge of the roadmap, f8[E]: what its duration implies where the world has speed limits, else inf."""
    roadmap = setting.roadmap
    if not any(lane.speed_limit > 0 for lane in setting.world.lanes) or not len(roadmap.edges):
        return np.full(len(roadmap.edges), np.inf)
    span = roadmap.position[roadmap.edges[:, 1]] - roadmap.position[roadmap.edges[:, 0]]
    ticks = np.where(roadmap.duration > 0, roadmap.duration, np.iinfo("i4").max).min(axis=0)
    return np.hypot(span[:, 0], span[:, 1]) / (ticks * roadmap.tick)


def _execute(
    config: RunConfig,
    context: RunContext,
    paths: RunPaths,
    announce: Announce,
    timing: dict[str, Any],
    observers: Observers,
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Drive the plan; returns the record's status (and error) and the metrics."""
    announce("execution", {})
    assert config.simulator is not None
    writer = RecordingWriter(paths.recording, context)
    paths.exports.mkdir(parents=True, exist_ok=True) if config.export else None
    exports = {name: exporter.open(context, paths.exports / name) for name, exporter in config.export.items()}
    stored = _sink(writer, config.recording.scans)

    def sink(chunk: Chunk) -> None:
        stored(chunk)
        for session in exports.values():
            session.write(chunk)

    seeds = (config.seed, config.repeat)
    poses = placements(context.routes, context.scenario.start[:, 2])
    noise = SensorNoise(
        config.noise.lidar, config.noise.odometry, config.noise.start_jitter, poses, config.seed, config.repeat
    )
    recorder = Recorder(config.recording.rate, context.period, sink)
    stack = Stack(
        localizer=config.localizer,
        dispatcher=config.dispatcher,
        navigator=config.navigator,
        controller=config.controller,
    )
    began = time.perf_counter()
    ended: dict[str, Any]
    try:
        with config.simulator.open(
            context.world, context.fleet, poses, seed_of(*seeds, "simulator"), context.period
        ) as simulation:
            outcome = execute_plan(
                context, stack, simulation, noise, recorder, config.limits.execution, seeds, observers.stepped
            )
        ended = _status(outcome, config)
        timing["execution_wall_s"] = time.perf_counter() - began
        timing["real_time_factor"] = outcome.simulated_s / timing["execution_wall_s"]
    except (DispatchError, MissionError) as error:
        ended = {"status": "execution_aborted", "error": {"stage": "execution", "message": str(error)}}
    except BaseException:
        writer.discard()
        raise
    recorder.flush()
    writer.close()
    announce("export", {})
    for session in exports.values():
        session.close()
    announce("metrics", {})
    metrics = measure_recording(config, paths.recording, timing)
    if config.recording.keep == "none" or (config.recording.keep == "failed" and ended["status"] == "succeeded"):
        paths.recording.unlink()
    return ended, metrics


def _sink(writer: RecordingWriter, scans: bool) -> Callable[[Chunk], None]:
    if scans:
        return writer.write
    return lambda chunk: writer.write({name: rows for name, rows in chunk.items() if not name.startswith("scan_")})


def _status(outcome: Outcome, config: RunConfig) -> dict[str, Any]:
    if outcome.arrived:
        return {"status": "succeeded"}
    if outcome.aborted:
        message = "a robot gave up before all had arrived"
        return {"status": "execution_aborted", "error": {"stage": "execution", "message": message}}
    message = f"not all robots arrived within {config.limits.execution:g} simulated seconds"
    return {"status": "goals_missed", "error": {"stage": "execution", "message": message}}


def measure_recording(config: RunConfig, file: Path, timing: dict[str, Any]) -> dict[str, Any]:
    """Metrics of a stored recording."""
    recording = Recording(file)
    try:
        run = FinishedRun(context=recording.context(), executed=True, channels=recording.channels, timing=timing)
        return measure(config.metrics, run)[0]
    finally:
        recording.close()
