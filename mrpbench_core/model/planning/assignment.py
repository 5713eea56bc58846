"""The assignment of tasks to robots."""

import attrs

from mrpbench_core.model.common.arrays import Float, Int32, array
from mrpbench_core.model.planning.scenario import Task


@attrs.frozen(kw_only=True)
class AssignmentProblem:
    """The cost of every pair of robot and task."""

    costs: Float = array("f8")
    """f8[n,m]; inf = forbidden. May be rectangular."""
    tasks: tuple[Task, ...] = ()
    robots: tuple[int, ...] = ()
    """Robot of each row; () = 0..n-1."""
    now: float = 0.0
    """simulated seconds."""


@attrs.frozen(kw_only=True)
class Assignment:
    """min(n, m) robots get one task each."""

    task: Int32 = array("i4")
    """i4[n]: column assigned to each row, -1 = none."""
    cost: float
    """Value of the assigner's objective."""
