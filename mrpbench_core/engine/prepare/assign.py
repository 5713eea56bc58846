"""Decides which robot does which task."""

import time
from typing import Any

import numpy as np

from mrpbench_core.api.assigner import Assigner, AssignmentError
from mrpbench_core.checking.assignment import check_assignment
from mrpbench_core.checking.scenario import check_travel
from mrpbench_core.engine.contract_checks import check_returned
from mrpbench_core.engine.prepare.costs import cost_matrix
from mrpbench_core.engine.prepare.run_instance import RunInstance, summary
from mrpbench_core.engine.stage import Announce, RunEnded
from mrpbench_core.model.common.arrays import read_only
from mrpbench_core.model.planning.assignment import Assignment, AssignmentProblem
from mrpbench_core.model.runs.status import RunStatus, Stage


def assign(assigner: Assigner, instance: RunInstance, announce: Announce, timing: dict[str, Any]) -> tuple[int, ...]:
    """The task of each robot, -1 = none.

    Raises:
        RunEnded: no assignment was found, or the assigner returned a wrong one.
    """
    announce(Stage.ASSIGNMENT, {"scenario_id": instance.scenario.id})
    began = time.perf_counter()
    if assigner.reads_costs:
        costs = cost_matrix(assigner.cost, instance.roadmap, instance.fleet, instance.scenario)
        if faults := check_travel(costs, instance.scenario.start_names, instance.task_names):
            raise RunEnded(RunStatus.SCENARIO_INFEASIBLE, Stage.SCENARIO, summary(faults))
    else:
        costs = read_only(np.zeros((len(instance.fleet), len(instance.scenario.tasks))))
    timing["cost_matrix_s"] = time.perf_counter() - began
    question = AssignmentProblem(costs=costs, tasks=instance.scenario.tasks)
    began = time.perf_counter()
    try:
        assignment = assigner.assign(question)
    except AssignmentError as error:
        raise RunEnded(RunStatus.ASSIGNMENT_FAILED, Stage.ASSIGNMENT, str(error)) from error
    timing["assignment_s"] = time.perf_counter() - began
    assignment = check_returned(assigner, assignment, Assignment)
    if faults := check_assignment(question, assignment):
        raise RunEnded(RunStatus.ASSIGNMENT_FAILED, Stage.ASSIGNMENT, f"{type(assigner).__name__} {faults[0]}")
    return tuple(int(task) for task in assignment.task)
