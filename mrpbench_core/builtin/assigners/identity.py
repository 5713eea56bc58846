"""The assigner for scenarios that give a goal to each robot."""

from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api.assigner import Assigner
from mrpbench_core.model.planning.assignment import Assignment, AssignmentProblem, QueueProblem, Queues


@attrs.frozen(kw_only=True)
class Identity(Assigner):
    """Gives task i to robot i; if there are fewer tasks than robots, the last robots get none.

    Of tasks that come over time a robot that is free gets the oldest, and keeps it.
    """

    reads_costs: ClassVar[bool] = False

    def assign(self, problem: AssignmentProblem) -> Assignment:
        """Return the assignment; its cost is NaN because nothing is minimised."""
        robots, tasks = problem.costs.shape
        index = np.arange(robots)
        return Assignment(task=np.where(index < tasks, index, -1), cost=float("nan"))

    def assign_queues(self, problem: QueueProblem) -> Queues:
        """Return the queues as they are, with the oldest tasks for robots without one: first come, first served."""
        taken = {task for queue in problem.queues for task in queue}
        left = [task for task in range(len(problem.tasks)) if task not in taken]
        queues = [tuple(queue) for queue in problem.queues]
        for robot in np.flatnonzero(problem.free_in <= self.look_ahead).tolist():
            if queues[robot]:
                continue
            able = next((task for task in left if np.isfinite(problem.approach[robot, task])), None)
            if able is not None:
                queues[robot] = (able,)
                left.remove(able)
        return tuple(queues)
