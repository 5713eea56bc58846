"""The assignment of tasks to robots."""

from collections.abc import Sequence

import attrs

from mrpbench_core.model.common.arrays import Float, Int32, array
from mrpbench_core.model.planning.problem import GoalSet
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.planning.tasks import flat_tasks


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


Queues = tuple[tuple[int, ...], ...]
"""For each robot the tasks that it does next, in order, as columns of `QueueProblem.tasks`; each task at most once."""


@attrs.frozen(kw_only=True)
class QueueProblem:
    """The tasks that no robot has begun, and when and where each robot is free for them.

    A robot has begun a task when it has done the first of several errands or rests at it; then it finishes the task.
    All durations are seconds without other robots. An assigner with `cost: euclidean` or `manhattan` gets them for that
    way at the greatest speed of the robot.
    """

    now: float
    """simulated seconds."""
    tasks: Sequence[Task] = attrs.field(converter=flat_tasks)
    """m tasks, in the order of their release, which are held as `Tasks`."""
    queues: Queues
    """What was decided last, one queue per robot."""
    free_in: Float = array("f8")
    """f8[n] until the robot has finished the task that it has begun, 0 = free; inf = it gave up."""
    approach: Float = array("f8")
    """f8[n,m] from where the robot becomes free to the first errand of the task; inf = it cannot do the task. Of
    several places of an errand, those count that make the whole task shortest. 0 instead of the duration unless the
    assigner `reads_costs`."""
    length: Float = array("f8")
    """f8[n,m] from the arrival at its first errand to the end of the task, with its service times; f8[n,1], all 0,
    unless the assigner `reads_costs`."""
    between: Float = array("f8")
    """f8[p,m,m] from the end of a task (row) to the first errand of another (column), of several places the nearest to
    one another; f8[0,0,0] unless the assigner `reads_between`."""
    profile: Int32 = array("i4")
    """i4[n] first index of `between` for each robot."""
    errands: tuple[tuple[GoalSet, ...], ...] = ()
    """For each of the m tasks the roadmap vertices of each errand, of which any will do."""
    ahead: tuple[tuple[GoalSet, ...], ...] = ()
    """For each of n robots the errands left of the task that it has begun."""
