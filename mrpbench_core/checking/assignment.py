"""Validates an assignment against its problem, and what a planner that assigns has chosen."""

from collections import defaultdict

import numpy as np

from mrpbench_core.model.assignment import Assignment, AssignmentProblem
from mrpbench_core.model.plan import Plan
from mrpbench_core.model.problem import Problem


def check_assignment(problem: AssignmentProblem, assignment: Assignment) -> list[str]:
    """What is wrong with an assignment, one sentence each: every task at most once, none forbidden, min(n, m) given."""
    robots, tasks = problem.costs.shape
    task = assignment.task
    if task.shape != (robots,):
        return [f"assigns {task.size} robots instead of {robots}"]
    if ((task < -1) | (task >= tasks)).any():
        return ["names a task that does not exist"]
    faults = []
    taken, times = np.unique(task[task >= 0], return_counts=True)
    faults += [f"gives task {index} to {count} robots" for index, count in zip(taken, times, strict=True) if count > 1]
    rows = np.flatnonzero(task >= 0)
    faults += [
        f"gives robot {row} the forbidden task {task[row]}"
        for row in rows
        if not np.isfinite(problem.costs[row, task[row]])
    ]
    if len(rows) != min(robots, tasks):
        faults.append(f"assigns {len(rows)} robots instead of {min(robots, tasks)}")
    return faults


def check_choice(problem: Problem, plan: Plan) -> list[str]:
    """Which robots took the same goal where the planner chose, one sentence each; the paths have to be sound.

    Where robots disappear at their goals that is no conflict, but a task is done by one robot, and so another is not.
    """
    robots = defaultdict(list)
    for robot, path in enumerate(plan.paths):
        robots[path.end(problem.roadmap, int(problem.start[robot]))].append(robot)
    return [
        f"robots {' and '.join(map(str, there))} take the same goal, vertex {vertex}, so that a task is left undone"
        for vertex, there in sorted(robots.items())
        if len(there) > 1
    ]
