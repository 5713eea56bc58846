"""The assigner for scenarios that give a goal to each robot."""

from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api.assigner import Assigner
from mrpbench_core.model.planning.assignment import Assignment, AssignmentProblem


@attrs.frozen(kw_only=True)
class Identity(Assigner):
    """Gives task i to robot i; if there are fewer tasks than robots, the last robots get none."""

    reads_costs: ClassVar[bool] = False

    def assign(self, problem: AssignmentProblem) -> Assignment:
        """Return the assignment; its cost is NaN because nothing is minimised."""
        robots, tasks = problem.costs.shape
        index = np.arange(robots)
        return Assignment(task=np.where(index < tasks, index, -1), cost=float("nan"))
