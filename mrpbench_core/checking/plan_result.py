"""Checks the types of what a planner returned; `check_plan` then checks its paths."""

import numbers
from collections.abc import Mapping
from typing import Any

import numpy as np

from mrpbench_core.model.planning.plan import AnytimePoint, Paths, Plan, PlanResult, PlanStatus, RobotPath

RETURNED = tuple(status for status in PlanStatus if status != PlanStatus.UNKNOWN)
"""The statuses that a planner may return."""


def result_fault(result: Any) -> str | None:
    """The first fault in the types of what a planner returned, or None."""
    if not isinstance(result, PlanResult):
        return f"returned {_type_name(result)} instead of a PlanResult"
    if result.status not in RETURNED:
        return f"returned the status {str(result.status)[:40]!r}, which is not one a planner may return"
    if result.plan is not None and (fault := _plan_fault(result.plan)):
        return fault
    if not isinstance(result.lower_bound, numbers.Real):
        return f"returned {_type_name(result.lower_bound)} as lower bound"
    if not isinstance(result.statistics, Mapping):
        return f"returned {_type_name(result.statistics)} instead of a mapping as statistics"
    for name, value in result.statistics.items():
        if not isinstance(name, str) or not isinstance(value, numbers.Real) or _overflows(value):
            return f"returned the statistic {name!s:.40}, {_type_name(value)}, which is not a number of 64 bits"
    if not isinstance(result.clock_bound, bool | np.bool_):
        return f"returned {_type_name(result.clock_bound)} instead of whether the clock decided"
    if not isinstance(result.history, tuple | list) or not all(
        isinstance(point, AnytimePoint) for point in result.history
    ):
        return "returned a history that is not a tuple of AnytimePoint"
    if result.plan is not None and result.status not in (PlanStatus.SOLVED, PlanStatus.TIMEOUT):
        return f"returned a plan with the status {result.status}"
    return None


def _overflows(value: numbers.Real) -> bool:
    return isinstance(value, int) and not -(2**63) <= value < 2**63


def _plan_fault(plan: Any) -> str | None:
    if not isinstance(plan, Plan):
        return f"returned {_type_name(plan)} instead of a Plan"
    if isinstance(plan.paths, Paths):
        return None if _joins(plan.paths) else "returned a plan whose flat arrays do not fit together"
    if not isinstance(plan.paths, tuple | list):
        return f"returned a plan with {_type_name(plan.paths)} instead of a tuple of paths"
    for robot, path in enumerate(plan.paths):
        if not isinstance(path, RobotPath):
            return f"robot {robot}: {_type_name(path)} instead of a RobotPath"
        if not path.edge.ndim == path.enter.ndim == path.leave.ndim == 1:
            return f"robot {robot}: edge, enter and leave are not all one-dimensional"
    return None


def _joins(paths: Paths) -> bool:
    """Tell whether `first` divides the other columns, all of the same length."""
    first, edge = paths.first, paths.edge
    if not first.ndim == edge.ndim == paths.enter.ndim == paths.leave.ndim == 1 or not len(first):
        return False
    ends_fit = first[0] == 0 and first[-1] == len(edge) == len(paths.enter) == len(paths.leave)
    return bool(ends_fit and (np.diff(first) >= 0).all())


def _type_name(value: Any) -> str:
    """A short description of a value."""
    if value is None:
        return "None"
    return f"the class {value.__name__}" if isinstance(value, type) else f"a value of type {type(value).__name__}"
