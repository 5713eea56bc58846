"""Contract of the kind *assigner*."""

from abc import abstractmethod
from typing import ClassVar, Literal

import attrs
import numpy as np

from mrpbench_core.api.component import Component, option
from mrpbench_core.model.planning.assignment import Assignment, AssignmentProblem, QueueProblem, Queues

Cost = Literal["euclidean", "manhattan", "roadmap"]


@attrs.frozen(kw_only=True)
class Assigner(Component):
    """Decides which robot does which task."""

    group: ClassVar[str] = "mrpbench.assigners"
    reads_costs: ClassVar[bool] = True
    """False if the assigner ignores costs, which are then not computed; see `QueueProblem.approach`."""
    optimal: ClassVar[bool] = False
    """True if it promises the least value of its objective, the sum of costs or what its option `objective` says."""

    reads_between: ClassVar[bool] = False
    """True if the assigner orders tasks in queues, and so needs `QueueProblem.between`."""

    cost: Cost = option(
        "euclidean",
        help="cost of a pair: straight-line or Manhattan distance (m), or duration of the shortest path (s)",
    )

    look_ahead: float = option(
        0.0,
        help="tasks that come over time: a robot takes part this long before it is free",
        unit="s",
        validator=attrs.validators.ge(0),
    )

    def idle_options(self) -> dict[str, str]:
        """Return `cost` if the assigner ignores costs."""
        return {} if self.reads_costs else {"cost": "this assigner reads no costs"}

    @abstractmethod
    def assign(self, problem: AssignmentProblem) -> Assignment:
        """Return an assignment of min(n, m) tasks, no pair of which has a forbidden (infinite) cost.

        Raises:
            AssignmentError: there is none, or the assigner found none.
        """

    def assign_queues(self, problem: QueueProblem) -> Queues:
        """Return which tasks each robot does next. Called when tasks arrive or finish; a task may be taken back.

        By default `assign` is called in batches, over the robots that are free within `look_ahead` and all tasks; a
        robot gets at most one task.

        Raises:
            AssignmentError: there is no assignment, or the assigner found none; the queues stay as they are.
        """
        near = np.flatnonzero(problem.free_in <= self.look_ahead)
        costs = problem.free_in[near, None] + problem.approach[near] + problem.length[near]
        able = np.isfinite(costs)
        rows, columns = np.flatnonzero(able.any(axis=1)), np.flatnonzero(able.any(axis=0))
        queues: list[tuple[int, ...]] = [()] * len(problem.free_in)
        if len(rows) and len(columns):
            batch = AssignmentProblem(
                costs=costs[np.ix_(rows, columns)],
                tasks=tuple(problem.tasks[column] for column in columns.tolist()),
                robots=tuple(near[rows].tolist()),
                now=problem.now,
            )
            for robot, task in zip(batch.robots, self.assign(batch).task.tolist(), strict=True):
                if task >= 0:
                    queues[robot] = (int(columns[task]),)
        return tuple(queues)


class AssignmentError(Exception):
    """No feasible assignment exists, or the solver did not find one."""
