"""The assigner that builds queues: each task goes to the place where it delays the fleet least."""

from typing import ClassVar

import attrs
import numpy as np

from mrpbench_assigners_greedy.greedy import Greedy
from mrpbench_core.api.component import option
from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.planning.assignment import QueueProblem, Queues


@attrs.frozen(kw_only=True)
class Insertion(Greedy):
    """Inserts tasks into the queues of robots where the sum of the times at which tasks are done grows least.

    All tasks that are not begun are inserted anew at each call, the oldest first, or with `regret` first the task that
    loses most if it does not get its best robot (Potvin and Rousseau, "A parallel route building algorithm for the
    vehicle routing and scheduling problem with time windows", EJOR 1993). Tasks of a batch are assigned as by `greedy`.
    """

    reads_between: ClassVar[bool] = True

    regret: bool = option(False, help="insert first the task whose second best robot is the most worse than its best")

    def idle_options(self) -> dict[str, str]:
        """Return `look_ahead`: robots that are not free have queues."""
        return {"look_ahead": "robots have queues, whether they are free or not"}

    def assign_queues(self, problem: QueueProblem) -> Queues:
        """Return the queues of all robots; a task that no robot can do is in none."""
        queues: list[list[int]] = [[] for _ in problem.free_in]
        left = np.arange(len(problem.tasks) if queues else 0)
        growth, place = np.empty((len(queues), len(left))), np.empty((len(queues), len(left)), np.int64)
        for robot in range(len(queues)):
            growth[robot], place[robot] = _insertions(problem, robot, [])
        while left.size:
            number = int(_regret(growth[:, left]).argmax()) if self.regret else 0
            task, left = int(left[number]), np.delete(left, number)
            robot = int(growth[:, task].argmin())
            if np.isfinite(growth[robot, task]):
                queues[robot].insert(place[robot, task], task)
                growth[robot], place[robot] = _insertions(problem, robot, queues[robot])
        return tuple(map(tuple, queues))


def _regret(growth: Float) -> Float:
    """By how much the second best robot is worse than the best one: f8[k] for growth f8[n,k]; inf if only one can."""
    regret = np.full(growth.shape[1], np.inf)
    if len(growth) > 1:
        best, second = np.sort(growth, axis=0)[:2]
        np.subtract(second, best, out=regret, where=np.isfinite(second))
    return regret


def _insertions(problem: QueueProblem, robot: int, queue: list[int]) -> tuple[Float, Int]:
    """For each task, the least growth f8[m] of the sum of times at which a queue's tasks are done, and the place i8[m].

    A task is done when the robot has come to it from what is before it, and delays all that is after it.
    """
    between, length, size = problem.between[problem.profile[robot]], problem.length[robot], len(queue)
    way = np.vstack([problem.approach[robot], between[queue]])  # f8[k+1,m] to each task from what is before each place
    driven = way[np.arange(size), queue]
    start = problem.free_in[robot] + np.concatenate([[0.0], np.cumsum(driven + length[queue])])
    growth = start[:, None] + way + length
    growth[:size] += np.arange(size, 0, -1)[:, None] * (way[:size] + length + between[:, queue].T - driven[:, None])
    growth[:, ~np.isfinite(problem.approach[robot])] = np.inf
    place = growth.argmin(axis=0)
    return growth[place, np.arange(len(place))], place
