"""One run from its configuration to its record, in this process."""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path as FilePath
from typing import Any

import attrs
import numpy as np

from mrpbench_core.api.discrete import DiscreteSimulator
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.execution.loop_inputs import granted_localizer
from mrpbench_core.engine.execution.replanning import replanning_fault
from mrpbench_core.engine.execution.routes import Router, speed_limits
from mrpbench_core.engine.observers import Observers
from mrpbench_core.engine.origins import title
from mrpbench_core.engine.own import own
from mrpbench_core.engine.record import RunError, RunRecord
from mrpbench_core.engine.stage import Announce, RunEnded, RunInputs
from mrpbench_core.engine.stages.assign import assign, tasks_of_plan
from mrpbench_core.engine.stages.claims import claims_of
from mrpbench_core.engine.stages.discrete import execute_steps
from mrpbench_core.engine.stages.execute import execute_plan
from mrpbench_core.engine.stages.judge import Promises, judge
from mrpbench_core.engine.stages.measure import measure, measure_recording
from mrpbench_core.engine.stages.plan import LATE_S, STATUS, budget_of, call_planner
from mrpbench_core.engine.stages.prepare import RunInstance, build_run_instance, goal_yaws, require_free_doorways
from mrpbench_core.engine.stages.problem_building import build_problem, standing_problem
from mrpbench_core.engine.stages.tasks import places_of, start_stream
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.printing import printable
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.planning.plan import Path, Plan, PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_core.model.runs.run import FinishedRun, RunContext
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.run_files import seal


def execute(
    config: RunConfig, run_id: str, paths: RunPaths, announce: Announce, observers: Observers | None = None
) -> RunRecord:
    """Execute one run and return its record, without what only the invoking process knows.

    The recording and the exports are complete under their final names when this returns.

    Raises:
        InputError: the configuration does not fit its world, robots or files.
    """
    record = RunRecord(run_id=run_id)
    inputs = RunInputs(
        config=config, paths=paths, announce=announce, observers=observers or Observers(), timing=record.timing
    )
    try:
        _run_stages(inputs, record)
    except RunEnded as ended:
        record.status = ended.status
        record.error = RunError(stage=ended.stage, message=printable(str(ended)))
    return record


def _run_stages(inputs: RunInputs, record: RunRecord) -> None:
    """Prepare, assign, plan, execute and measure.

    Raises:
        RunEnded: the run did not succeed; the record holds what was found until then.
    """
    config = inputs.config
    instance = build_run_instance(config, inputs.announce)
    record.scenario_id = instance.scenario.id
    if config.executes:
        require_free_doorways(instance)
    stream = start_stream(config, instance)
    assigned: tuple[int, ...] | None
    if stream is not None:
        assigned, problem = (-1,) * len(instance.fleet), standing_problem(instance)
        result, failure = _stand(inputs, problem, record, places_of(stream, instance)), None
    else:
        assigned = None if config.planner.assigns else assign(config, instance, inputs.announce, inputs.timing)
        if assigned is not None and config.scenario.gives_goals:
            record.reassigned = sum(task != robot for robot, task in enumerate(assigned))
        problem = build_problem(instance, assigned, config.assigner, Feature.GOAL_SETS in config.planner.supports)
        result, failure = _plan(inputs, problem, record)
    if assigned is None:
        assigned = (-1,) * len(problem) if result.plan is None else tasks_of_plan(instance, problem, result.plan)
    router = router_of(config, instance, assigned, problem)
    context = _context(inputs, record.run_id, instance, router, result, assigned)
    if failure is None and config.executes:
        record.true_poses = granted_localizer(config)
        if isinstance(config.simulator, DiscreteSimulator):
            assert stream is not None
            failure, record.unexported = execute_steps(inputs, context, stream)
        else:
            failure, record.unexported, record.unarrived = execute_plan(inputs, context, router, stream)
        inputs.announce(Stage.METRICS, {})
        record.executed = True
        kept = config.recording.keep == "all" or (config.recording.keep == "failed" and failure is not None)
        with ThreadPoolExecutor(1) as disk:  # which is as slow as the metrics
            sealed = disk.submit(seal, inputs.paths, recording=kept)
            record.metrics, record.unmeasured = _measure(config, inputs.paths.recording)
            record.files = sealed.result()
        if not kept:
            inputs.paths.recording.unlink()
    else:
        inputs.announce(Stage.METRICS, {})
        run = FinishedRun(context=context, executed=False)
        record.metrics, record.unmeasured = measure(config.metrics, run)
    if failure is not None:
        raise failure


def _measure(config: RunConfig, recording: FilePath) -> tuple[dict[str, Any], dict[str, str]]:
    """Measure the recording that this process wrote."""
    try:
        return measure_recording(config.metrics, recording)
    except InputError as error:  # no mistake of the user: a component changed the file, and would do so again
        raise RuntimeError(f"the recording was changed after it was written: {error.message}") from error


def _plan(inputs: RunInputs, problem: Problem, record: RunRecord) -> tuple[PlanResult, RunEnded | None]:
    """Plan and judge; the second value says how the run ended if there is no plan to execute.

    Raises:
        RunEnded: the planner does not support the problem.
    """
    config = inputs.config
    if reason := replanning_fault(config):
        raise RunEnded(RunStatus.SKIPPED, Stage.PLANNING, reason)
    inputs.announce(Stage.PLANNING, {"limit_s": config.limits.planning, "scenario_id": record.scenario_id})
    promises = Promises.of(config.planner)
    result, timing = call_planner(config.planner, problem, budget_of(config))
    inputs.timing.update(timing)
    inputs.announce(Stage.CHECKING, {})  # which is no part of the planner's time
    result, fault = judge(promises, problem, result)
    record.plan = {} if fault else claims_of(promises, problem, result)
    if inputs.observers.planned is not None:
        inputs.observers.planned(problem=own(problem), result=own(result))
    if fault is not None:
        return attrs.evolve(result, plan=None), RunEnded(
            RunStatus.PLAN_INVALID, Stage.PLANNING, f"{fault} ({title(config.planner)})"
        )
    if result.plan is None:
        return result, RunEnded(STATUS[result.status], Stage.PLANNING, _unsolved(config, problem, result, timing))
    return result, None


def _stand(inputs: RunInputs, problem: Problem, record: RunRecord, places: Int | None) -> PlanResult:
    """The first plan where tasks come over time: every robot stays where it is until it has one.

    Raises:
        RunEnded: the planner does not support what it will be asked.
    """
    config = inputs.config
    inputs.announce(Stage.PLANNING, {"limit_s": config.limits.planning, "scenario_id": record.scenario_id})
    if isinstance(config.simulator, DiscreteSimulator):
        reason = config.simulator.skip(config.planner)
    else:
        asked = attrs.evolve(problem, features=problem.features | {Feature.COMMITMENTS})
        reason = replanning_fault(config) or config.planner.skip(own(asked))
        reason = reason or config.planner.skip_tasks(own(problem), places)
    if reason:
        raise RunEnded(RunStatus.SKIPPED, Stage.PLANNING, reason)
    nothing = Path(edge=np.empty(0, "i4"), enter=np.empty(0, "i8"), leave=np.empty(0, "i8"))
    result = PlanResult(status=PlanStatus.SOLVED, plan=Plan(paths=(nothing,) * len(problem)))
    if inputs.observers.planned is not None:
        inputs.observers.planned(problem=own(problem), result=own(result))
    return result


_BLAMES = {
    PlanStatus.GAVE_UP: "gave up: it last found no path for",
    PlanStatus.UNSOLVABLE: "proved that there is no plan, because of",
}
"""How a planner ended that names a robot."""


def _unsolved(config: RunConfig, problem: Problem, result: PlanResult, timing: Mapping[str, Any]) -> str:
    """Why there is no plan."""
    if result.status == PlanStatus.TIMEOUT and timing["planning_s"] > config.limits.planning + LATE_S:
        return f"returned after {timing['planning_s']:.3f} s; the limit is {config.limits.planning:g} s"
    if result.status == PlanStatus.OUT_OF_MEMORY:
        held, allowed = timing["planning_peak_bytes"] / 2**20, config.limits.memory / 2**20
        return f"the planner added {held:.0f} MiB; the option limits.memory allows the whole run {allowed:.0f} MiB"
    robot = int(result.statistics.get("failed_robot", -1))
    said = _BLAMES.get(result.status)
    if said is not None and 0 <= robot < len(problem):
        x, y = problem.roadmap.position[problem.start[robot]]
        return f"the planner {said} robot {robot}, which starts at ({x:.1f}, {y:.1f})"
    return f"the planner ended with {result.status}"


def router_of(config: RunConfig, instance: RunInstance, assigned: tuple[int, ...], problem: Problem) -> Router:
    """Return what turns plans of a problem into routes."""
    yaw = np.full(len(assigned), np.nan)
    for robot, task in enumerate(assigned):
        if task >= 0:
            yaws = goal_yaws(instance.roadmap, instance.scenario.tasks[task])[-1]
            goal = problem.goals[robot][-1]  # a planner that assigns has the goals of all tasks here
            yaw[robot] = next(yaws[vertex] for vertex in goal if vertex in yaws)  # of several, all are equal
    return Router(problem, yaw, speed_limits(instance.world, instance.roadmap), config.plan_filter)


def _context(
    inputs: RunInputs, run_id: str, instance: RunInstance, router: Router, result: PlanResult, assigned: tuple[int, ...]
) -> RunContext:
    """The context of the run before its execution; without a plan there are no routes."""
    routes = () if result.plan is None else tuple(router(result.plan))
    return RunContext(
        run_id=run_id,
        world=instance.world,
        fleet=instance.fleet,
        scenario=instance.scenario,
        problem=router.problem,
        result=attrs.evolve(result, history=()),  # wall times are in the record, and recordings are reproducible
        routes=routes,
        goal=tuple((float(x), float(y), float(yaw)) for x, y, yaw in (route.waypoint[-1] for route in routes)),
        period=1 / inputs.config.control_rate,
        latency=inputs.config.replanning.latency,
        assigned=assigned,
    )
