"""Optimal assignment in polynomial time.

Sum: Crouse, "On implementing 2D rectangular assignment algorithms", IEEE Trans. Aerospace and Electronic Systems 2016
(SciPy's method). Bottleneck: the least threshold that still admits a full matching (Gross, "The bottleneck assignment
problem", RAND P-1630, 1959), found by bisection with matchings of Hopcroft & Karp, SIAM J. Comput. 1973.
"""

from typing import ClassVar, Literal

import attrs
import numpy as np

from mrpbench_core.api import Assigner, AssignmentError, option
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.planning.assignment import Assignment, AssignmentProblem


@attrs.frozen(kw_only=True)
class Hungarian(Assigner):
    """The exact polynomial method, by SciPy."""

    optimal: ClassVar[bool] = True

    objective: Literal["sum", "bottleneck"] = option(
        "sum", help="objective: the sum of costs, or the largest cost and then the sum"
    )

    def assign(self, problem: AssignmentProblem) -> Assignment:
        """Return the best assignment."""
        from scipy.optimize import linear_sum_assignment  # not before a configuration asks for it

        costs = np.where(np.isfinite(problem.costs), problem.costs, np.inf)
        if not _matches(costs, np.inf):
            raise AssignmentError("no assignment gives every robot, or every task, a pair that is not forbidden")
        if self.objective == "bottleneck":
            costs = np.where(costs <= _threshold(costs), costs, np.inf)
        robots, tasks = linear_sum_assignment(costs)
        task = np.full(len(costs), -1)
        task[robots] = tasks
        paid = costs[robots, tasks]
        value = paid.sum() if self.objective == "sum" else paid.max(initial=-np.inf if len(paid) else 0.0)
        return Assignment(task=task, cost=float(value))


def _threshold(costs: Float) -> float:
    """The least cost such that min(n, m) pairs cost no more."""
    levels = np.unique(costs[np.isfinite(costs)])
    low, high = 0, len(levels) - 1
    while low < high:
        middle = (low + high) // 2
        if _matches(costs, levels[middle]):
            high = middle
        else:
            low = middle + 1
    return float(levels[low]) if len(levels) else 0.0


def _matches(costs: Float, threshold: float) -> bool:
    """Tell whether min(n, m) pairs of finite cost up to `threshold` exist."""
    from scipy.sparse import csr_matrix
    from scipy.sparse.csgraph import maximum_bipartite_matching

    allowed = csr_matrix(np.isfinite(costs) & (costs <= threshold))
    matched = maximum_bipartite_matching(allowed, perm_type="column")
    return bool((matched >= 0).sum() == min(costs.shape))
