"""Plans and executes one run in this process, where its plugins are, and records what happened and what was claimed.

What this process says of the run is a claim: `mrpbench_core.referee` judges the recording in another one.
"""

import math
from collections.abc import Mapping
from typing import Any, Self, cast

import attrs
import numpy as np

from mrpbench_core.api.discrete import DiscreteSimulator
from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.checking.plan_result import result_fault
from mrpbench_core.engine.drive.discrete import execute_steps
from mrpbench_core.engine.drive.execute import execute_plan
from mrpbench_core.engine.drive.plan import LATE_S, budget_of, call_planner
from mrpbench_core.engine.drive.tasks import places_of, start_stream
from mrpbench_core.engine.execution.replanning import replanning_fault
from mrpbench_core.engine.stage import RunEnded, RunInputs
from mrpbench_core.files.codec import decode
from mrpbench_core.files.printing import printable
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import Path as RobotPath
from mrpbench_core.model.planning.plan import Plan, PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_core.model.runs.instance import Instance
from mrpbench_core.model.runs.routing import ends_of
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.referee.plans import Promises, judge_plan
from mrpbench_core.referee.verdict import STATUS, Ending
from mrpbench_core.store.instances import inlined_array
from mrpbench_core.store.recording import RecordingWriter


@attrs.define(kw_only=True)
class Claims:
    """What the process of a run says of it beside the recording."""

    ending: Ending | None = None
    """None: it succeeded."""
    recorded: bool = False
    """There is a recording."""
    unexported: dict[str, str] = attrs.field(factory=dict)
    """The reason why an export failed, by its name."""
    unarrived: dict[str, str] = attrs.field(factory=dict)
    """Why robots did not arrive, by their names."""
    timing: dict[str, Any] = attrs.field(factory=dict)

    def message(self) -> dict[str, Any]:
        """The claims as plain data, for another process."""
        return attrs.asdict(self)

    @classmethod
    def of_message(cls, message: Mapping[str, Any]) -> Self:
        """The claims that another process sent.

        Raises:
            ValueError: they have another form.
        """
        claims = decode(message, cls, inlined_array)
        for name, value in claims.timing.items():
            if isinstance(value, list) and name == "planning_history":
                continue
            if not isinstance(value, int | float) or not math.isfinite(value) or value < 0:
                raise ValueError(f"the time {name!r:.40} is not a number of 0 or more")
        return claims


def drive(inputs: RunInputs, instance: Instance) -> Claims:
    """Plan and execute a run; its recording and exports have their final names when this returns.

    Raises:
        InputError: the configuration does not fit its instance or its files.
    """
    claims = Claims(timing=inputs.timing)
    try:
        _drive(inputs, instance, claims)
    except RunEnded as ended:
        claims.ending = attrs.evolve(ended.ending, message=printable(str(ended)))
    return claims


def _drive(inputs: RunInputs, instance: Instance, claims: Claims) -> None:
    """Plan, write the plan to the recording, and execute it.

    Raises:
        RunEnded: the run did not succeed.
    """
    config = inputs.config
    executes_runs = config.simulator is not None and config.simulator.executes_runs
    if not executes_runs and (reason := replanning_fault(config)):
        raise RunEnded(RunStatus.SKIPPED, Stage.PLANNING, reason)
    stream = start_stream(config, instance)
    result = _plan(inputs, instance.problem) if stream is None else _stand(inputs, instance, stream)
    inputs.hooks.call("mrpbench_planned", problem=instance.problem, result=result)
    result, failure = _checked(inputs, instance.problem, result)
    context = _context(inputs, instance, result, executes=failure is None and config.executes)
    if failure is not None or not config.executes:
        RecordingWriter(inputs.paths.recording, context, inputs.instance).close()
        claims.recorded = True
        if failure is not None:
            raise failure
        return
    if executes_runs:
        assert stream is not None
        failure, claims.unexported = execute_steps(inputs, context, stream)
    else:
        router = instance.router(context.assigned, config.plan_filter)
        failure, claims.unexported, claims.unarrived = execute_plan(inputs, context, router, stream)
    claims.recorded = True
    if failure is not None:
        raise failure


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


def _context(inputs: RunInputs, instance: Instance, result: PlanResult, *, executes: bool) -> RunContext:
    """The context of the run before its execution; without one there are no routes."""
    config = inputs.config
    result = attrs.evolve(result, history=())  # wall times are in the record, and recordings are reproducible
    assigned = instance.tasks_of(result.plan if executes else None)
    routes: tuple[Route, ...] = ()
    if executes and result.plan is not None:
        routes = tuple(instance.router(assigned, config.plan_filter)(result.plan))
    return RunContext(
        run_id=inputs.run_id,
        world=instance.world,
        fleet=instance.fleet,
        scenario=instance.scenario,
        problem=instance.problem,
        result=result,
        routes=routes,
        goal=ends_of(routes),
        period=1 / config.control_rate,
        latency=config.replanning.latency,
        assigned=assigned,
        planner_assigns=instance.assigned is None,
        goal_tolerance=config.goal_tolerance,
        plan_filter=config.plan_filter,
    )
