"""One run from its configuration to its record, in this process."""

from typing import Any

import attrs
import numpy as np

from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.execution.replanning import replanning_fault
from mrpbench_core.engine.execution.routes import Router, speed_limits
from mrpbench_core.engine.json_values import printable
from mrpbench_core.engine.observers import Observers
from mrpbench_core.engine.stage import Announce, RunEnded
from mrpbench_core.engine.stages.assign import assign, tasks_of_plan
from mrpbench_core.engine.stages.execute import drive, measure_recording
from mrpbench_core.engine.stages.judge import judge
from mrpbench_core.engine.stages.measure import measure
from mrpbench_core.engine.stages.plan import STATUS, budget_of, call_planner
from mrpbench_core.engine.stages.prepare import Instance, build_instance, require_free_doorways
from mrpbench_core.engine.stages.problem_building import build_problem
from mrpbench_core.model.plan import PlanResult
from mrpbench_core.model.problem import Problem
from mrpbench_core.model.run import FinishedRun, RunContext
from mrpbench_core.model.status import RunStatus, Stage
from mrpbench_core.store.paths import RunPaths


def execute(
    config: RunConfig, run_id: str, paths: RunPaths, announce: Announce, observers: Observers | None = None
) -> dict[str, Any]:
    """Execute one run and return its record, less what only the invoking process knows.

    The recording and exports are complete under their final names when this returns.

    Raises:
        InputError: the configuration does not fit its world, robots or files.
    """
    observers = observers or Observers()
    record: dict[str, Any] = {"run_id": run_id, "scenario_id": None, "metrics": {}, "timing": {}}
    try:
        instance = build_instance(config, announce)
        record["scenario_id"] = instance.scenario.id
        if config.simulator is not None:
            require_free_doorways(instance)
        chosen = None if config.planner.assigns else assign(config, instance, announce, record["timing"])
        if chosen is not None and config.scenario.gives_goals:
            record["reassigned"] = sum(task != robot for robot, task in enumerate(chosen))
        problem = build_problem(instance, chosen, config.assigner)
        result, ended = _plan(config, problem, announce, record["timing"], observers)
        assigned = _assigned(instance, problem, result, chosen)
        router = _router(config, instance, assigned, problem)
        context = _context(config, run_id, instance, assigned, problem, result, router)
        if ended is None and config.simulator is not None:
            ended, record["unexported"] = drive(config, context, router, paths, announce, record["timing"], observers)
            announce(Stage.METRICS, {})
            record["executed"] = True
            record["metrics"], record["unmeasured"] = measure_recording(config, paths.recording)
            if config.recording.keep == "none" or (config.recording.keep == "failed" and ended is None):
                paths.recording.unlink()
        else:
            announce(Stage.METRICS, {})
            run = FinishedRun(context=context, executed=False)
            record["metrics"], record["unmeasured"] = measure(config.metrics, run)
    except RunEnded as error:
        ended = error
    record["status"] = RunStatus.SUCCEEDED if ended is None else ended.status
    if ended is not None:
        record["error"] = {"stage": ended.stage, "message": printable(str(ended))}
    return record


def _plan(
    config: RunConfig, problem: Problem, announce: Announce, timing: dict[str, Any], observers: Observers
) -> tuple[PlanResult, RunEnded | None]:
    """Plan; the second value says how the run ended if there is nothing to execute."""
    if reason := config.planner.skip(problem) or replanning_fault(config):
        raise RunEnded(RunStatus.SKIPPED, Stage.PLANNING, reason)
    announce(Stage.PLANNING, {"limit_s": config.limits.planning})
    result, spent = call_planner(config.planner, problem, budget_of(config))
    timing |= spent
    announce(Stage.CHECKING, {})  # which is no part of the planner's time
    result, fault = judge(config.planner, problem, result)
    observers.planned(problem=problem, result=result)
    if fault is not None:
        return attrs.evolve(result, plan=None), RunEnded(RunStatus.PLAN_INVALID, Stage.PLANNING, fault)
    if result.plan is None:
        return result, RunEnded(STATUS[result.status], Stage.PLANNING, f"the planner ended with {result.status}")
    return result, None


def _assigned(
    instance: Instance, problem: Problem, result: PlanResult, chosen: tuple[int, ...] | None
) -> tuple[int, ...]:
    if chosen is not None:
        return chosen
    return (-1,) * len(problem) if result.plan is None else tasks_of_plan(instance, problem, result.plan)


def _router(config: RunConfig, instance: Instance, assigned: tuple[int, ...], problem: Problem) -> Router:
    yaw = np.array([instance.scenario.tasks[task].goals[-1, 2] if task >= 0 else np.nan for task in assigned])
    return Router(problem, yaw, speed_limits(instance.world, instance.roadmap), config.plan_filter)


def _context(
    config: RunConfig,
    run_id: str,
    instance: Instance,
    assigned: tuple[int, ...],
    problem: Problem,
    result: PlanResult,
    router: Router,
) -> RunContext:
    routes = () if result.plan is None else router(result.plan)
    return RunContext(
        run_id=run_id,
        world=instance.world,
        fleet=instance.fleet,
        scenario=instance.scenario,
        problem=problem,
        result=result,
        routes=routes,
        goal=tuple((float(x), float(y), float(yaw)) for x, y, yaw in (route.waypoint[-1] for route in routes)),
        period=1 / config.control_rate,
        assigned=assigned,
    )
