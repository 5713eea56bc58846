"""Calls the planner during an execution, within the limits and measured like the first call."""

import math

import attrs
import numpy as np

from mrpbench_core.api.predictor import PredictorSession
from mrpbench_core.engine.contract_checks import check_returned
from mrpbench_core.engine.drive.plan import budget_of, call_planner
from mrpbench_core.engine.execution.replanning import Replanner
from mrpbench_core.engine.stage import RunEnded, RunInputs
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.runs.routing import Router
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.runs.status import Stage
from mrpbench_core.referee.plans import Promises, judge_plan


def replanner_of(inputs: RunInputs, context: RunContext, router: Router) -> Replanner:
    """What asks the planner of a run for new plans."""
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
        result, fault = judge_plan(promises, problem, result, counts=False)
        late = max(0.0, calls[-1] - limit)
        return result, fault or (f"the planner ended with {result.status}" if result.plan is None else None), late

    assert context.result.plan is not None
    planner, problem, plan = config.planner, context.problem, context.result.plan
    predictor, prediction = config.replanning.prediction, None
    if predictor is not None:
        started = predictor.start(context.fleet.robots, context.world)
        prediction = check_returned(predictor, started, PredictorSession)
    return Replanner(
        config.replanning,
        ask,
        router,
        problem,
        plan,
        planner.supports,
        reads_remaining=planner.reads_remaining,
        chooses_goals=planner.chooses_goals,
        prediction=prediction,
    )


def call_timing(seconds: list[float], limit: float) -> dict[str, float]:
    """Return the timing of the planner's calls during execution, for the record."""
    return {**calls_timing("replanning", seconds), "replanning_overruns": sum(spent > limit for spent in seconds)}


def calls_timing(what: str, seconds: list[float]) -> dict[str, float]:
    """Return the timing of the calls during execution, for the record."""
    return {
        f"{what}_s": sum(seconds),
        f"{what}_calls": len(seconds),
        f"{what}_p50_s": float(np.percentile(seconds, 50)),
        f"{what}_p99_s": float(np.percentile(seconds, 99)),
        f"{what}_max_s": max(seconds),
    }
