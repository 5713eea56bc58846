"""Executes a plan in the simulator, and writes what happens to the recording and the exports."""

import math
import time
from collections.abc import Mapping

import attrs
import numpy as np

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.api.dispatcher import DispatchError
from mrpbench_core.api.simulator import Simulation
from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.contract_checks import check_returned
from mrpbench_core.engine.drive.export import Exports
from mrpbench_core.engine.drive.plan import budget_of, call_planner
from mrpbench_core.engine.execution.crowds import Crowds
from mrpbench_core.engine.execution.destinations import Places
from mrpbench_core.engine.execution.draws import Draws
from mrpbench_core.engine.execution.evaluations import Evaluations
from mrpbench_core.engine.execution.facility_manager import ExecutionError
from mrpbench_core.engine.execution.faults import FaultState, draw_faults
from mrpbench_core.engine.execution.loop import ExecutionLoop
from mrpbench_core.engine.execution.loop_inputs import ExecutionResult, LoopComponents, LoopInputs
from mrpbench_core.engine.execution.noise import Disturbances
from mrpbench_core.engine.execution.progress import ExecutionProgress
from mrpbench_core.engine.execution.queue_costs import QueueCosts
from mrpbench_core.engine.execution.recorder import Recorder
from mrpbench_core.engine.execution.replanning import Replanner
from mrpbench_core.engine.execution.schedule import Schedule
from mrpbench_core.engine.execution.schedule_loop import ScheduleLoop
from mrpbench_core.engine.execution.task_manager import TaskManager
from mrpbench_core.engine.execution.worst_case import Adversary
from mrpbench_core.engine.seeds import seed_of
from mrpbench_core.engine.stage import RunEnded, RunInputs
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.execution.motion import Event
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.routing import Router, start_poses
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.referee.plans import Promises, judge_plan
from mrpbench_core.store.recording import RecordingWriter


def execute_plan(
    inputs: RunInputs, context: RunContext, router: Router, stream: TaskStream | None = None
) -> tuple[RunEnded | None, dict[str, str], dict[str, str]]:
    """Execute the plan of `context`, and the tasks of `stream`.

    No unfinished recording or export gets its final name.

    Returns:
        How the run ended, None if every robot arrived; why an export failed, by the format's name; and, in runs with
        faults, why robots did not arrive, by their names.

    Raises:
        InputError: a fault, or a setting of the recording, names what does not exist.
    """
    config, timing = inputs.config, inputs.timing
    inputs.announce(Stage.EXECUTION, {})
    faults = _faults(config, context)
    blocked = [event for event in faults.events if event.kind == "blocked"]
    poses = start_poses(context.routes, context.scenario.start[:, 2])
    levels = np.array([route.level[0] for route in context.routes], np.int16)
    crowds = Crowds(
        config.crowds,
        context.world,
        context.fleet,
        context.period,
        config.seed,
        config.repeat,
        blocked,
        poses=poses,
        levels=levels,
        apart=config.crowds_apart,
    )
    context = attrs.evolve(context, movers=crowds.members)
    writer = RecordingWriter(inputs.paths.recording, context, inputs.instance)
    exports = Exports()

    def sink(chunk: Chunk) -> None:
        writer.write({name: rows for name, rows in chunk.items() if config.recording.scans or name[:5] != "scan_"})
        exports.write(chunk)

    ended: RunEnded | None
    unarrived: dict[str, str] = {}
    try:
        exports.open(config.export, context, inputs.paths.exports)
        wants_scans = config.recording.scans or bool(config.export)
        recorder = Recorder(
            config.recording.rate,
            context.period,
            sink,
            wants_scans,
            tasks=config.tasks is not None,
            trajectories=config.recording.trajectories is not None and config.execution == "simulated",
        )
        began = time.perf_counter()
        replanner = _replanner(inputs, context, router)
        inputs.hooks.call("mrpbench_executing", context=context)
        if config.execution == "schedule_only":
            result, draws = _follow_schedule(config, context, recorder, faults)
            if len(draws["draw"]) > 1:
                sink(draws)
        else:
            tasks = None if stream is None else _tasks(config, context, stream, recorder)
            result = _simulate(inputs, context, (poses, levels), crowds, recorder, replanner, faults, tasks)
        unarrived = {context.fleet.names[robot]: reason for robot, reason in result.unarrived.items()}
        for robot, reason in result.unarrived.items():
            recorder.events([Event(stamp=result.simulated_s, kind="not_arrived", robot=robot, detail=reason)])
        ended = _failure(result, config, unarrived)
        timing["execution_wall_s"] = time.perf_counter() - began
        timing["real_time_factor"] = result.simulated_s / timing["execution_wall_s"]
    except (DispatchError, ExecutionError) as error:
        ended = RunEnded(RunStatus.EXECUTION_ABORTED, Stage.EXECUTION, str(error))
    except BaseException:
        writer.discard()
        exports.abandon()
        raise
    finally:
        inputs.hooks.call("mrpbench_executed")
    recorder.flush()
    writer.close()
    inputs.announce(Stage.EXPORT, {})
    exports.close()
    return ended, exports.failed, unarrived


def _evaluations(config: RunConfig, context: RunContext) -> Evaluations | None:
    """Collects what controllers weigh, if that is recorded."""
    settings = config.recording.trajectories
    return None if settings is None else Evaluations(settings, len(context.fleet))


def _faults(config: RunConfig, context: RunContext) -> FaultState:
    """The faults of the run."""
    roadmap, robots = context.problem.roadmap, len(context.fleet)
    names = [resource.name for resource in roadmap.resources if resource.kind != "mutex"]
    seeds = (config.seed, config.repeat)
    events = draw_faults(config.faults, robots, roadmap, names, config.limits.execution, *seeds)
    return FaultState(config.faults, events, robots)


def _draws(config: RunConfig, context: RunContext) -> Draws:
    """The delays of the run, and of its further draws."""
    settings, plan = config.delays, context.result.plan
    assert plan is not None
    attack = settings.worst_case * settings.tick
    adversary = Adversary(context.problem, plan, attack) if attack else None
    return Draws(settings, len(context.fleet), (config.seed, config.repeat), adversary)


def _replanner(inputs: RunInputs, context: RunContext, router: Router) -> Replanner:
    """Asks the run's planner for new plans, within the limits and measured like the first call."""
    config, timing = inputs.config, inputs.timing

    promises = Promises.of(config.planner)
    session = config.planner.start()
    limit = min(config.replanning.budget or math.inf, config.limits.planning)
    calls: list[float] = []

    def ask(problem: Problem) -> tuple[PlanResult, str | None, float]:
        inputs.announce(Stage.REPLANNING, {"limit_s": limit})
        budget = attrs.evolve(budget_of(config), wall_s=limit)
        try:
            result, spent = call_planner(config.planner, problem, budget, session)
        except RunEnded as skipped:
            inputs.announce(Stage.EXECUTION, {})
            return PlanResult(status=PlanStatus.GAVE_UP), f"the planner {skipped}", 0.0
        inputs.announce(Stage.EXECUTION, {})
        calls.append(spent["planning_s"])
        timing.update(call_timing(calls, limit))
        timing["clock_bound"] = timing.get("clock_bound", False) or spent["clock_bound"]
        result, fault = judge_plan(promises, problem, result)
        late = max(0.0, calls[-1] - limit)
        return result, fault or (f"the planner ended with {result.status}" if result.plan is None else None), late

    assert context.result.plan is not None
    planner, problem, plan = config.planner, context.problem, context.result.plan
    return Replanner(config.replanning, ask, router, problem, plan, planner.supports, planner.reads_remaining)


def call_timing(seconds: list[float], limit: float) -> dict[str, float]:
    """Return the timing of the planner's calls during execution, for the record."""
    return {**_calls("replanning", seconds), "replanning_overruns": sum(spent > limit for spent in seconds)}


def _calls(what: str, seconds: list[float]) -> dict[str, float]:
    """Return the timing of the calls during execution, for the record."""
    return {
        f"{what}_s": sum(seconds),
        f"{what}_calls": len(seconds),
        f"{what}_p50_s": float(np.percentile(seconds, 50)),
        f"{what}_p99_s": float(np.percentile(seconds, 99)),
        f"{what}_max_s": max(seconds),
    }


def _tasks(config: RunConfig, context: RunContext, stream: TaskStream, recorder: Recorder) -> TaskManager:
    """The tasks of an execution."""
    costs = QueueCosts(config.assigner.cost, context.problem.roadmap, context.fleet)
    supports, windowed = config.planner.supports, config.replanning.window is not None
    sets, shared = Feature.GOAL_SETS in supports, windowed and Feature.SHARED_GOALS in supports
    places = Places(context.problem, costs.labels, config.replanning.parking, sets, shared)
    sequences = Feature.GOAL_SEQUENCES in supports
    return TaskManager(
        stream, config.assigner, costs, places, context.problem, recorder, config.replanning.interval, sequences
    )


def _simulate(
    inputs: RunInputs,
    context: RunContext,
    starts: tuple[Float, Int16],
    crowds: Crowds,
    recorder: Recorder,
    replanner: Replanner,
    faults: FaultState,
    tasks: TaskManager | None,
) -> ExecutionResult:
    """Open the simulator and run the execution loop."""
    config = inputs.config
    assert config.simulator is not None
    components = LoopComponents.of(config)
    seeds = (config.seed, config.repeat)
    poses, levels = starts
    noise = Disturbances(config.noise, context.fleet, poses, context.period, *seeds)
    seed = seed_of(*seeds, "simulator")
    radii = [mover.radius for mover in crowds.members]
    placed = poses.copy(), seed, context.period, radii
    opened = config.simulator.open(context.world, context.fleet, *placed, levels=levels.copy())
    result: ExecutionResult | None = None
    with check_returned(config.simulator, opened, Simulation) as simulation:
        if not np.array_equal(simulation.state.level, levels):
            raise ExecutionError("the simulator supports the lowest level only, and robots start on other levels")
        loop = ExecutionLoop(
            LoopInputs(
                context=context,
                components=components,
                crowds=crowds,
                simulation=simulation,
                placed=poses,
                noise=noise,
                delays=_draws(config, context).stream(),
                faults=faults,
                evaluations=_evaluations(config, context),
                recorder=recorder,
                replanner=replanner,
                tasks=tasks,
                limit_s=config.limits.execution,
                goal_tolerance=config.goal_tolerance,
                seeds=seeds,
                hooks=inputs.hooks,
                progress=ExecutionProgress(inputs.progress, config.limits.execution),
            )
        )
        result = loop.run()
    if result is None:
        raise BrokenContractError("the simulator hid an exception", "simulator")
    if tasks is not None and tasks.assignment_s:
        inputs.timing.update(_calls("assignment", tasks.assignment_s))
    return result


def _follow_schedule(
    config: RunConfig, context: RunContext, recorder: Recorder, faults: FaultState
) -> tuple[ExecutionResult, Chunk]:
    """Execute without physics; return the first execution, and the times of all draws of the delays."""
    assert config.dispatcher is not None
    limit = config.limits.execution
    draws = _draws(config, context)
    schedule = Schedule(context, config.dispatcher)
    loop = ScheduleLoop(schedule, draws.stream(), recorder, faults)
    arrived, simulated_s = loop.run(limit)
    unarrived = {} if loop.ending is None else loop.ending.reasons()
    times = [(loop.arrival[None], loop.waiting[None]), *draws.execute(schedule, faults, limit)]
    arrival, waiting = (np.concatenate(column) for column in zip(*times, strict=True))
    rows = {"draw": np.arange(len(arrival), dtype=np.int32), "draw_arrival": arrival, "draw_waiting": waiting}
    result = ExecutionResult(succeeded=arrived, gave_up=(), simulated_s=simulated_s, unarrived=unarrived)
    return result, rows


def _failure(result: ExecutionResult, config: RunConfig, unarrived: Mapping[str, str]) -> RunEnded | None:
    """Return the status of the run, None if every robot arrived."""
    if result.succeeded:
        return None
    if unarrived:
        each = [f"{name} {reason}" for name, reason in unarrived.items()]
        causes = "; ".join(each[:3]) + (f"; … ({len(each)} robots)" if len(each) > 3 else "")
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
    return RunEnded(RunStatus.GOALS_MISSED, Stage.EXECUTION, result.contradiction or late)
