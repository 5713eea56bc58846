"""The verdict on a run: a function of its instance, its recording and what it was asked."""

from collections.abc import Mapping
from typing import Any

import attrs
import numpy as np

from mrpbench_core.api.metric import Metric
from mrpbench_core.api.task_source import TaskSource
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.model.runs.arrivals import arrival_times
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.referee.asked import Asked
from mrpbench_core.referee.measuring import measure
from mrpbench_core.referee.motion import motion_fault
from mrpbench_core.referee.plan_summary import plan_summary
from mrpbench_core.referee.plans import judge_plan
from mrpbench_core.referee.releases import release_fault
from mrpbench_core.referee.tasks import tasks_fault
from mrpbench_core.store.recording import Recording

STATUS = {
    PlanStatus.TIMEOUT: RunStatus.PLAN_TIMEOUT,
    PlanStatus.OUT_OF_MEMORY: RunStatus.OUT_OF_MEMORY,
    PlanStatus.UNSOLVABLE: RunStatus.PLAN_UNSOLVABLE,
    PlanStatus.GAVE_UP: RunStatus.PLAN_NOT_FOUND,
}
"""A run's status for each way of having no plan."""


@attrs.frozen(kw_only=True)
class Failure:
    """Why a run did not succeed: as its own process says, or as the referee finds."""

    status: RunStatus
    stage: Stage
    message: str
    """One line."""


@attrs.frozen(kw_only=True)
class Verdict:
    """The status of a run, its metrics, and what its planner claims."""

    failure: Failure | None = None
    """None: the run succeeded."""
    plan: dict[str, Any] = attrs.field(factory=dict)
    """See `mrpbench_core.referee.plan_summary`."""
    metrics: dict[str, Any] = attrs.field(factory=dict)
    unmeasured: dict[str, str] = attrs.field(factory=dict)


def judge(
    asked: Asked,
    recording: Recording,
    instance_name: str | None,
    metrics: Mapping[str, Metric],
    said: Failure | None,
    source: TaskSource | None = None,
) -> Verdict:
    """Return the verdict on a run.

    Args:
        asked: of the run.
        recording: of the run.
        instance_name: of the instance that was made for the run; None: the recording holds it.
        metrics: to measure.
        said: how the run ended as its own process says; gives the words where the referee agrees.
        source: of the tasks that come over time, if it is asked again.
    """
    if recording.instance_name != instance_name:
        return broken("the recording has another instance than the run")
    try:
        recorded, instance = recording.recorded_run(), recording.instance()
        for name in ("run_id", "latency", "goal_tolerance", "plan_filter", "period"):
            if getattr(recorded, name) != getattr(asked, name):
                return broken(f"the recording has another {name} than the configuration")
        result, fault = judge_plan(asked.promises, instance.problem, recorded.claimed)
        if fault is not None:
            return Verdict(
                failure=_failure(RunStatus.PLAN_INVALID, Stage.PLANNING, f"{fault} ({asked.title('planner')})")
            )
        if result.plan is None and said is not None and said.status == RunStatus.PLAN_INVALID:
            message = f"{said.message} ({asked.title('planner')})"
            return Verdict(
                failure=attrs.evolve(said, message=message)
            )  # what the planner returned could not be recorded
        summary = {} if asked.tasks else plan_summary(asked.promises, instance.problem, result)
        run = _finished(recording, result, asked)
        if result.plan is None:
            failure: Failure | None = said if _agrees(said, STATUS[result.status]) else None
            said_none = f"the planner ended with {result.status}"
            failure = failure or _failure(STATUS[result.status], Stage.PLANNING, said_none)
        elif asked.executes:
            failure = _executed(asked, run, said, source)
        else:
            failure = None
        if failure is not None and failure.status == RunStatus.CONTRACT_BROKEN:
            return Verdict(failure=failure, plan=summary)
        values, reasons = measure(metrics, run)
    except InputError as error:
        return broken(f"the recording was damaged: {error.message}")
    return Verdict(failure=failure, plan=summary, metrics=values, unmeasured=reasons)


def finished_run(recording: Recording, asked: Asked) -> FinishedRun:
    """The run as metrics see it, with the conflicts of its plan."""
    result, _ = judge_plan(asked.promises, recording.instance().problem, recording.recorded_run().claimed)
    return _finished(recording, result, asked)


def _finished(recording: Recording, result: PlanResult, asked: Asked) -> FinishedRun:
    executed = "time" in recording.channels
    first = attrs.evolve(recording.first_context(), result=result)
    if not executed:
        return FinishedRun(context=first, executed=False)
    context = attrs.evolve(recording.context(), result=result)
    return FinishedRun(context=context, executed=asked.executes, channels=recording.channels, first_routes=first.routes)


def _executed(asked: Asked, run: FinishedRun, said: Failure | None, source: TaskSource | None) -> Failure | None:
    """How the execution ended, None if every robot arrived."""
    if not run.executed:
        if said is not None and said.stage == Stage.EXECUTION:
            return said  # the dispatcher refused the plan
        return _failure(RunStatus.CONTRACT_BROKEN, Stage.EXECUTION, "nothing was recorded of the execution")
    if asked.driven and (fault := motion_fault(run, asked.rate, asked.actuation, asked.apart)):
        what = f"the recorded motion is impossible: {fault}"
        return _failure(RunStatus.CONTRACT_BROKEN, Stage.EXECUTION, f"{what} ({asked.title('simulator')})")
    time = run.channel("time")
    gave_up = _gave_up(run)
    if asked.tasks:
        fault = tasks_fault(run, asked.driven)
        if fault is None and source is not None:
            fault = release_fault(run, source, asked)
        if fault is not None:
            return _failure(RunStatus.CONTRACT_BROKEN, Stage.EXECUTION, f"the recorded tasks are impossible: {fault}")
        failed, missed = gave_up.any() or _unserved(run), "no plan was found and no task was done"
    else:
        missing = np.isnan(arrival_times(run))
        failed, missed = missing.any(), _not_arrived(run, missing)
    if not failed:
        return None
    early = time[-1] < asked.limit_s - 1e-9
    aborted = gave_up.any() or (early and _agrees(said, RunStatus.EXECUTION_ABORTED))
    status = RunStatus.EXECUTION_ABORTED if aborted else RunStatus.GOALS_MISSED
    if said is not None and _agrees(said, status):
        return said
    return _failure(status, Stage.EXECUTION, f"{missed} within {min(asked.limit_s, time[-1]):g} simulated seconds")


def _gave_up(run: FinishedRun) -> Bool:
    mode = run.channel("mode") if run.has("mode") else np.zeros((0, len(run.context.fleet)), int)
    gave_up: Bool = (mode[-1:] == Mode.ABORTED).any(axis=0)
    return gave_up


def _unserved(run: FinishedRun) -> bool:
    """True if no task was done, and the last call of the planner found no plan."""
    done = run.has("task_event") and bool((run.channel("task_event") == "done").any())
    kinds = run.channel("event_kind") if run.has("event_kind") else np.zeros(0, "U1")
    calls = kinds[np.isin(kinds, ("replan", "replan_failed"))]
    return not done and len(calls) > 0 and calls[-1] == "replan_failed"


def _not_arrived(run: FinishedRun, missing: Bool) -> str:
    names = np.array(run.context.fleet.names)[missing].tolist()
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "") + " did not arrive"


def _agrees(said: Failure | None, status: RunStatus) -> bool:
    return said is not None and said.status == status


def _failure(status: RunStatus, stage: Stage, message: str) -> Failure:
    return Failure(status=status, stage=stage, message=message)


def broken(message: str) -> Verdict:
    """The verdict on a run whose recording cannot be judged."""
    return Verdict(failure=_failure(RunStatus.CONTRACT_BROKEN, Stage.METRICS, message))
