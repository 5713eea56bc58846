"""Validates assignments, and the goals that a planner with the option `assign` has chosen."""

from collections import defaultdict
from itertools import chain
from typing import Any

import numpy as np

from mrpbench_core.model.planning.assignment import Assignment, AssignmentProblem, QueueProblem
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem


def check_assignment(problem: AssignmentProblem, assignment: Assignment) -> list[str]:
    """The faults of an assignment, one sentence each.

    A valid assignment gives each task to at most one robot, gives no forbidden pair (cost inf), and assigns min(n, m)
    of n robots and m tasks.
    """
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
    """The robots that share a goal in a plan whose planner assigned the tasks, one sentence each.

    A task belongs to exactly one robot. Where robots disappear at their goals, two robots at one goal do not conflict,
    but another task is left undone. The paths must have no faults.
    """
    robots = defaultdict(list)
    for robot, path in enumerate(plan.paths):
        robots[path.end(problem.roadmap, int(problem.start[robot]))].append(robot)
    return [
        f"robots {' and '.join(map(str, there))} take the same goal, vertex {vertex}, so that a task is left undone"
        for vertex, there in sorted(robots.items())
        if len(there) > 1
    ]


def check_queues(problem: QueueProblem, queues: Any) -> str | None:
    """Return what is wrong with queues of tasks, as the end of a sentence, or None."""
    if not isinstance(queues, tuple | list) or len(queues) != len(problem.free_in):
        return f"returned {queues!r:.60} instead of one queue for each of {len(problem.free_in)} robots"
    for robot, queue in enumerate(queues):
        if not isinstance(queue, tuple | list):
            return f"gave robot {robot} {queue!r:.60} instead of a queue"
        for task in queue:
            if not isinstance(task, int | np.integer) or not 0 <= task < len(problem.tasks):
                return f"gave robot {robot} task {task!s:.60}, which does not exist"
    tasks = np.array([*chain.from_iterable(queues)], np.int64)
    if len(again := np.flatnonzero(np.bincount(tasks) > 1)):
        return f"gave task {again[0]} twice"
    robots = np.repeat(np.arange(len(queues)), [len(queue) for queue in queues])
    if len(unable := np.flatnonzero(~np.isfinite(problem.approach[robots, tasks]))):
        return f"gave task {tasks[unable[0]]} to robot {robots[unable[0]]}, which cannot do it"
    return None
