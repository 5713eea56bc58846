"""Asks the planner of a run for its first plan, and checks whether that can be executed."""

from typing import cast

import attrs
import numpy as np

from mrpbench_core.api.discrete import DiscreteSimulator
from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.checking.plan_result import result_fault
from mrpbench_core.engine.drive.plan import LATE_S, budget_of, call_planner
from mrpbench_core.engine.drive.tasks import places_of, start_stream
from mrpbench_core.engine.execution.replanning import replanning_fault
from mrpbench_core.engine.stage import RunEnded, RunInputs
from mrpbench_core.model.planning.plan import Plan, PlanResult, PlanStatus, RobotPath
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_core.model.runs.instance import Instance
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.referee.plans import Promises, judge_plan
from mrpbench_core.referee.verdict import STATUS


@attrs.frozen(kw_only=True)
class FirstPlan:
    """What is to be executed: a plan and, where tasks come over time, their stream."""

    result: PlanResult
    stream: TaskStream | None
    failure: RunEnded | None
    """Why there is no plan that can be executed."""


def first_plan(inputs: RunInputs, instance: Instance) -> FirstPlan:
    """Plan, or let the robots stand until tasks come.

    Raises:
        RunEnded: the run is skipped.
    """
    config = inputs.config
    executes_runs = config.simulator is not None and config.simulator.executes_runs
    if not executes_runs and (reason := replanning_fault(config)):
        raise RunEnded(RunStatus.SKIPPED, Stage.PLANNING, reason)
    stream = start_stream(config, instance)
    result = _plan(inputs, instance.problem) if stream is None else _stand(inputs, instance, stream)
    inputs.hooks.call("mrpbench_planned", problem=instance.problem, result=result)
    result, failure = _checked(inputs, instance.problem, result)
    return FirstPlan(result=result, stream=stream, failure=failure)


def _plan(inputs: RunInputs, problem: Problem) -> PlanResult:
    """Call the planner.

    Raises:
        RunEnded: the planner does not support the problem.
    """
    config = inputs.config
    inputs.announce(Stage.PLANNING, {"limit_s": config.limits.planning})
    result, timing = call_planner(config.planner, problem, budget_of(config))
    inputs.timing.update(timing)
    inputs.announce(Stage.CHECKING, {})  # which is not part of the planner's time
    return result


def _stand(inputs: RunInputs, instance: Instance, stream: TaskStream) -> PlanResult:
    """The first plan where tasks come over time: every robot stays where it is until it has one.

    Raises:
        RunEnded: the planner does not support what it will be asked.
    """
    config, problem = inputs.config, instance.problem
    inputs.announce(Stage.PLANNING, {"limit_s": config.limits.planning})
    assert config.simulator is not None
    if config.simulator.executes_runs:
        reason = cast("DiscreteSimulator", config.simulator).skip(config.planner)
    else:
        asked = attrs.evolve(problem, features=problem.features | {Feature.COMMITMENTS})
        reason = config.planner.skip(asked) or config.planner.skip_tasks(problem, places_of(stream, instance))
    if reason:
        raise RunEnded(RunStatus.SKIPPED, Stage.PLANNING, reason)
    nothing = RobotPath(edge=np.empty(0, "i4"), enter=np.empty(0, "i8"), leave=np.empty(0, "i8"))
    return PlanResult(status=PlanStatus.SOLVED, plan=Plan(paths=(nothing,) * len(problem)))


def _checked(inputs: RunInputs, problem: Problem, result: PlanResult) -> tuple[PlanResult, RunEnded | None]:
    """A result that can be recorded, and why there is no plan to execute; what is not driven the referee judges."""
    config = inputs.config
    if fault := result_fault(result):
        return PlanResult(status=PlanStatus.GAVE_UP), RunEnded(RunStatus.PLAN_INVALID, Stage.PLANNING, fault)
    if config.executes or result.plan is None:
        fault = judge_plan(Promises.of(config.planner), problem, result)[1]
    if fault is not None:
        return result, RunEnded(RunStatus.PLAN_INVALID, Stage.PLANNING, fault)
    if result.plan is not None:
        return result, None
    return result, RunEnded(STATUS[result.status], Stage.PLANNING, _unsolved(inputs, problem, result))


_BLAMES = {
    PlanStatus.GAVE_UP: "gave up: it last found no path for",
    PlanStatus.UNSOLVABLE: "proved that there is no plan, because of",
}
"""How a planner ended that names a robot."""


def _unsolved(inputs: RunInputs, problem: Problem, result: PlanResult) -> str:
    """Why there is no plan."""
    limits, timing = inputs.config.limits, inputs.timing
    if result.status == PlanStatus.TIMEOUT and timing["planning_s"] > limits.planning + LATE_S:
        return f"returned after {timing['planning_s']:.3f} s; the limit is {limits.planning:g} s"
    if result.status == PlanStatus.OUT_OF_MEMORY:
        held, allowed = timing["planning_peak_bytes"] / 2**20, limits.memory / 2**20
        return f"the planner added {held:.0f} MiB; the option limits.memory allows the whole run {allowed:.0f} MiB"
    robot = int(result.statistics.get("failed_robot", -1))
    said = _BLAMES.get(result.status)
    if said is not None and 0 <= robot < len(problem):
        x, y = problem.roadmap.position[problem.start[robot]]
        return f"the planner {said} robot {robot}, which starts at ({x:.1f}, {y:.1f})"
    return f"the planner ended with {result.status}"
