"""Lifecycle hooks, group `mrpbench.hooks`. They only observe; one that raises is disabled for the rest of the run.

The hooks of a study are called in a process that each plugin has for the whole study, the others in the process of the
run.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import pluggy

from mrpbench_core.model.execution.observation import FleetObservation
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.planning.plan import PlanResult
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.runs.run import RunContext

hookspec = pluggy.HookspecMarker("mrpbench")
hookimpl = pluggy.HookimplMarker("mrpbench")


@hookspec
def mrpbench_check() -> str | None:
    """Return in one line what keeps the plugin from doing what its settings ask for, or None if nothing does.

    The line is printed as a warning before the first run of a study (a process of its own).
    """


@hookspec
def mrpbench_study_started(study: Mapping[str, Any], runs: int) -> None:
    """A study begins with its configuration and the number of runs to do (the plugin's process of the study)."""


@hookspec
def mrpbench_run_started(run_id: str, config: Mapping[str, Any]) -> None:
    """A run was handed to a worker (the plugin's process of the study)."""


@hookspec
def mrpbench_run_finished(record: Mapping[str, Any]) -> None:
    """A run's record was stored (the plugin's process of the study)."""


@hookspec
def mrpbench_study_finished(records: int) -> None:
    """Every run of the study has a record (the plugin's process of the study)."""


@hookspec
def mrpbench_planned(problem: Problem, result: PlanResult) -> None:
    """A planner returned (the run's process)."""


@hookspec
def mrpbench_executing(context: RunContext) -> None:
    """Called in the process of the run when the execution of a plan begins."""


@hookspec
def mrpbench_stepped(now: float, state: State, observation: FleetObservation, routes: Sequence[Route]) -> None:
    """A control period ended; `now` in simulated seconds (the run's process).

    `state` is the ground truth, `observation` what the robots sense and estimate, and `routes` are the current routes:
    the same object until there is a new plan.
    """


@hookspec
def mrpbench_executed() -> None:
    """The execution ended, with or without success (the run's process)."""
