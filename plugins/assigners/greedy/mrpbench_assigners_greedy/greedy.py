"""The assigner that takes the cheapest pair of robot and task again and again."""

import attrs
import numpy as np

from mrpbench_core.api.assigner import Assigner, AssignmentError
from mrpbench_core.model.common.arrays import Float, Int32
from mrpbench_core.model.planning.assignment import Assignment, AssignmentProblem


@attrs.frozen(kw_only=True)
class Greedy(Assigner):
    """Takes the cheapest pair of a free robot and a task again and again, the first of equal ones."""

    def assign(self, problem: AssignmentProblem) -> Assignment:
        """Return min(n, m) pairs and the sum of their costs.

        Raises:
            AssignmentError: only forbidden pairs are left.
        """
        task = cheapest_pairs(problem.costs)
        assigned = np.flatnonzero(task >= 0)
        if len(assigned) < min(problem.costs.shape):
            raise AssignmentError(f"the cheapest pairs leave only forbidden ones after {len(assigned)} pairs")
        return Assignment(task=task, cost=float(problem.costs[assigned, task[assigned]].sum()))


def cheapest_pairs(costs: Float) -> Int32:
    """The column i4[n] of each row of `costs` f8[n,m], -1 = none; each column at most once, infinite pairs never."""
    rows, columns = costs.shape
    task, taken = np.full(rows, -1, np.int32), np.zeros(columns, bool)
    order = np.argsort(costs, axis=None, kind="stable")
    for row, column in zip(*(index.tolist() for index in np.unravel_index(order, costs.shape)), strict=True):
        if task[row] < 0 and not taken[column] and np.isfinite(costs[row, column]):
            task[row], taken[column] = column, True
    return task
