"""Statuses of runs, and stages of a run: the only definition of what a status means."""

from enum import StrEnum


class RunStatus(StrEnum):
    """The status of a finished run; see `docs/reference/results-folder.md`."""

    SUCCEEDED = "succeeded"
    """Every robot arrived; without a simulator, the planner found a valid plan."""
    GOALS_MISSED = "goals_missed"
    """The simulated time was over before every robot had arrived."""
    EXECUTION_ABORTED = "execution_aborted"
    """A robot gave up, or the dispatcher refused the plan."""
    PLAN_TIMEOUT = "plan_timeout"
    OUT_OF_MEMORY = "out_of_memory"
    WALL_TIMEOUT = "wall_timeout"
    PLAN_UNSOLVABLE = "plan_unsolvable"
    """The planner proved that there is no plan."""
    PLAN_NOT_FOUND = "plan_not_found"
    """An incomplete planner found no plan, which proves nothing."""
    PLAN_INVALID = "plan_invalid"
    """The plan breaks a promise of its planner."""
    PROMISE_BROKEN = "promise_broken"
    """Other runs of the same problem show that the planner's plan, bound or proof is not what it promises. Reports find
    this; records keep the status with which the run ended."""
    ASSIGNMENT_FAILED = "assignment_failed"
    """No assignment exists, or the assigner returned a wrong one."""
    SCENARIO_INFEASIBLE = "scenario_infeasible"
    """No planner can solve the scenario; found before planning."""
    SKIPPED = "skipped"
    """The planner does not support the problem."""
    UNKNOWN = "unknown"
    """A recording of others ends before its robots are seen to arrive or to stop."""
    CONTRACT_BROKEN = "contract_broken"
    """A component returned what its contract forbids, or changed its inputs."""
    CRASHED = "crashed"
    """The worker process died, or a plugin raised an exception."""


LEFT_OUT = frozenset({RunStatus.SCENARIO_INFEASIBLE, RunStatus.SKIPPED, RunStatus.UNKNOWN})
"""Statuses that say nothing about the method: these runs leave every denominator and are listed as such."""
PLANNED = frozenset({RunStatus.SUCCEEDED, RunStatus.GOALS_MISSED, RunStatus.EXECUTION_ABORTED})
"""Statuses of runs that had a valid plan and ended regularly."""
FAILED = frozenset(
    {
        RunStatus.CRASHED,
        RunStatus.CONTRACT_BROKEN,
        RunStatus.OUT_OF_MEMORY,
        RunStatus.WALL_TIMEOUT,
        RunStatus.PLAN_INVALID,
        RunStatus.ASSIGNMENT_FAILED,
    }
)
"""Statuses that `--rerun failed` repeats: such runs say more about a defect or the machine than about the method.

A plan timeout or a missed goal is a result; repeating only those would favour luck.
"""


class Stage(StrEnum):
    """The stages of a run, in order."""

    START = "start"
    """The worker has received the run and has not begun it."""
    WORLD = "world"
    ROADMAP = "roadmap"
    SCENARIO = "scenario"
    ASSIGNMENT = "assignment"
    PLANNING = "planning"
    CHECKING = "checking"
    """The plan is checked against its planner's promises."""
    EXECUTION = "execution"
    REPLANNING = "replanning"
    """The planner is called during execution."""
    EXPORT = "export"
    METRICS = "metrics"
    WORKER = "worker"
    """Nothing is known but that the worker process was lost."""
    ANALYSIS = "analysis"
    """Of recordings that are measured by `mrpbench analyze`."""


AFTER_PLANNING = frozenset({Stage.EXECUTION, Stage.EXPORT, Stage.METRICS})
"""Stages in which a run that was ended had a valid plan."""
