"""One run from its configuration to its record, in this process."""

from typing import Any

import attrs
import numpy as np

from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.execution import drive, measure_recording
from mrpbench_core.engine.measure import measure
from mrpbench_core.engine.observers import Observers
from mrpbench_core.engine.plain import readable
from mrpbench_core.engine.planning import STATUS, budget_of, call_planner, judge
from mrpbench_core.engine.preparation import (
    Announce,
    Ended,
    Setting,
    assign,
    keep_off_doors,
    pose_problem,
    set_scene,
    taken,
)
from mrpbench_core.engine.replanning import replanning_fault
from mrpbench_core.engine.routes import Router, speed_limits
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
        setting = set_scene(config, announce)
        record["scenario_id"] = setting.scenario.id
        if config.simulator is not None:
            keep_off_doors(setting)
        chosen = None if config.planner.assigns else assign(config, setting, announce, record["timing"])
        problem = pose_problem(setting, chosen, config.assigner)
        result, ended = _plan(config, problem, announce, record["timing"], observers)
        assigned = _assigned(setting, problem, result, chosen)
        router = _router(config, setting, assigned, problem)
        context = _context(config, run_id, setting, assigned, problem, result, router)
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
    except Ended as error:
        ended = error
    record["status"] = RunStatus.SUCCEEDED if ended is None else ended.status
    if ended is not None:
        record["error"] = {"stage": ended.stage, "message": readable(str(ended))}
    return record


def _plan(
    config: RunConfig, problem: Problem, announce: Announce, timing: dict[str, Any], observers: Observers
) -> tuple[PlanResult, Ended | None]:
    """Plan; the second value says how the run ended if there is nothing to execute."""
    if reason := config.planner.skip(problem) or replanning_fault(config):
        raise Ended(RunStatus.SKIPPED, Stage.PLANNING, reason)
    announce(Stage.PLANNING, {"limit_s": config.limits.planning})
    result, spent = call_planner(config.planner, problem, budget_of(config))
    timing |= spent
    announce(Stage.CHECKING, {})  # which is no part of the planner's time
    result, fault = judge(config.planner, problem, result)
    observers.planned(problem=problem, result=result)
    if fault is not None:
        return attrs.evolve(result, plan=None), Ended(RunStatus.PLAN_INVALID, Stage.PLANNING, fault)
    if result.plan is None:
        return result, Ended(STATUS[result.status], Stage.PLANNING, f"the planner ended with {result.status}")
    return result, None


def _assigned(
    setting: Setting, problem: Problem, result: PlanResult, chosen: tuple[int, ...] | None
) -> tuple[int, ...]:
    if chosen is not None:
        return chosen
    return (-1,) * len(problem) if result.plan is None else taken(setting, problem, result.plan)


def _router(config: RunConfig, setting: Setting, assigned: tuple[int, ...], problem: Problem) -> Router:
    yaw = np.array([setting.scenario.tasks[task].goals[-1, 2] if task >= 0 else np.nan for task in assigned])
    return Router(problem, yaw, speed_limits(setting.world, setting.roadmap), config.plan_filter)


def _context(
    config: RunConfig,
    run_id: str,
    setting: Setting,
    assigned: tuple[int, ...],
    problem: Problem,
    result: PlanResult,
    router: Router,
) -> RunContext:
    routes = () if result.plan is None else router(result.plan)
    return RunContext(
        run_id=run_id,
        world=setting.world,
        fleet=setting.fleet,
        scenario=setting.scenario,
        problem=problem,
        result=result,
        routes=routes,
        goal=tuple((float(x), float(y), float(yaw)) for x, y, yaw in (route.waypoint[-1] for route in routes)),
        period=1 / config.control_rate,
        assigned=assigned,
    )
