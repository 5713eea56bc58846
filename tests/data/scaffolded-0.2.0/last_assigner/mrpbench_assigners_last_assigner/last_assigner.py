"""LastAssigner: an assignment with the least sum of costs.

Robots are added one at a time, each along a cheapest augmenting path, on which other robots change their tasks (Kuhn,
"The Hungarian method for the assignment problem", Naval Research Logistics Quarterly, 1955; Bellman and Ford).
"""

from typing import ClassVar

import attrs
import numpy as np
from mrpbench_core.api import Assigner, AssignmentError, option
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.planning.assignment import Assignment, AssignmentProblem


@attrs.frozen(kw_only=True)
class LastAssigner(Assigner):
    """Minimises the sum of costs."""

    optimal: ClassVar[bool] = True

    tolerance: float = option(
        1e-12, help="ignore savings smaller than this share of the largest cost", validator=attrs.validators.ge(0)
    )

    def assign(self, problem: AssignmentProblem) -> Assignment:
        """Return the best assignment of min(n, m) tasks."""
        costs = problem.costs
        flipped = costs.shape[0] > costs.shape[1]
        chosen = self.pairs(costs.T if flipped else costs)
        task = np.full(len(costs), -1)
        for row, column in enumerate(chosen):
            task[column if flipped else row] = row if flipped else column
        rows = np.flatnonzero(task >= 0)
        return Assignment(task=task, cost=float(costs[rows, task[rows]].sum()))

    def pairs(self, costs: Float) -> list[int]:
        """Return the column of each row of a matrix with at least as many columns as rows."""
        least = self.tolerance * float(np.abs(costs[np.isfinite(costs)]).max(initial=0.0))
        owner = [-1] * costs.shape[1]
        for row in range(len(costs)):
            price = costs[row].tolist()  # of the cheapest path from `row` to each column
            before = [-1] * len(owner)  # the previous column on that path
            changed = True
            while changed:
                changed = False
                for column, taken_by in enumerate(owner):
                    if taken_by < 0 or price[column] == np.inf:
                        continue
                    for other in range(len(owner)):
                        found = price[column] - costs[taken_by, column] + costs[taken_by, other]
                        if found < price[other] - least:
                            price[other], before[other], changed = found, column, True
            free = [column for column, taken_by in enumerate(owner) if taken_by < 0 and price[column] < np.inf]
            if not free:
                raise AssignmentError("no assignment avoids the forbidden pairs")
            column = min(free, key=price.__getitem__)
            while before[column] >= 0:
                owner[column] = owner[before[column]]
                column = before[column]
            owner[column] = row
        return [owner.index(row) for row in range(len(costs))]
