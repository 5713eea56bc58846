"""Optimal assignment in polynomial time, O(n^2 m) for n robots and m >= n tasks.

Sum: shortest augmenting paths (Jonker and Volgenant, "A shortest augmenting path algorithm for dense and sparse linear
assignment problems", Computing 1987). Bottleneck: the least threshold that admits a full matching, by augmenting paths
too (Derigs and Zimmermann, "An augmenting path method for solving linear bottleneck assignment problems", Computing
1978), and the least sum below it.
"""

from typing import ClassVar, Literal

import attrs
import numpy as np
from mrpbench_native.mapf import bottleneck, cheapest_assignment

from mrpbench_core.api import Assigner, AssignmentError, option
from mrpbench_core.model.common.arrays import Float, Int32
from mrpbench_core.model.planning.assignment import Assignment, AssignmentProblem


@attrs.frozen(kw_only=True)
class Hungarian(Assigner):
    """The exact polynomial method, in C++."""

    optimal: ClassVar[bool] = True

    objective: Literal["sum", "bottleneck"] = option(
        "sum", help="objective: the sum of costs, or the largest cost and then the sum"
    )

    def assign(self, problem: AssignmentProblem) -> Assignment:
        """Return the best assignment."""
        costs = problem.costs
        if not costs.min(initial=np.inf) > -np.inf:  # a NaN or -inf; large matrices are copied only then
            costs = np.where(np.isfinite(costs), costs, np.inf)
        flipped = len(costs) > costs.shape[1]
        scarce = np.ascontiguousarray(costs.T) if flipped else costs
        column = self._columns(scarce)
        row = np.arange(len(scarce))
        task = np.full(len(costs), -1)
        if flipped:
            task[column] = row
        else:
            task[row] = column
        paid = scarce[row, column]
        value = paid.sum() if self.objective == "sum" else paid.max(initial=-np.inf if len(paid) else 0.0)
        return Assignment(task=task, cost=float(value))

    def _columns(self, costs: Float) -> Int32:
        """The column of each row."""
        if self.objective == "bottleneck" and (threshold := bottleneck(costs)) is not None:
            costs = np.where(costs <= threshold, costs, np.inf)
        columns = cheapest_assignment(costs)
        if columns is None:
            raise AssignmentError("no assignment gives every robot, or every task, a pair that is not forbidden")
        return columns
