"""Validates a task: what it says of its places and errands agrees, and numbers are finite where arithmetic needs it."""

import math

import numpy as np

from mrpbench_core.model.planning.scenario import Task


def task_fault(task: Task) -> str | None:
    """Return what is wrong with a task, to follow "a task", or None."""
    if not len(task.goals):
        return "has no errand"
    if not task.levels.shape == task.errand.shape == (len(task.goals),):
        return "has not one level and errand per place"
    if task.errand[0] or not np.isin(np.diff(task.errand), (0, 1)).all():
        return f"has errands that do not count from 0: {task.errand.tolist()}"
    if task.service.shape != (task.errands,):
        return "has not one service time per errand"
    if not np.isfinite(task.goals[:, :2]).all():
        return "has a place that is not finite"
    if not (np.isfinite(task.service) & (task.service >= 0)).all():
        return f"has the service times {task.service.tolist()}"
    return "has a deadline that is not a number" if math.isnan(task.deadline) else None
