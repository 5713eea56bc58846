"""The assigner that builds queues: each task goes to the place where it delays the fleet least."""

from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api.component import option
from mrpbench_core.builtin.assigners.greedy import Greedy
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
        robots, left = range(len(queues)), list(range(len(problem.tasks)))
        best = {task: [_cheapest(problem, robot, [], task) for robot in robots] for task in left}
        while left:
            task = max(left, key=lambda it: _regret([cost for cost, _ in best[it]])) if self.regret else left[0]
            left.remove(task)
            cost, robot = min((cost, robot) for robot, (cost, _) in enumerate(best[task]))
            if not np.isfinite(cost):
                continue
            queues[robot].insert(best[task][robot][1], task)
            for other in left:
                best[other][robot] = _cheapest(problem, robot, queues[robot], other)
        return tuple(map(tuple, queues))


def _regret(costs: list[float]) -> float:
    """By how much the second best robot is worse than the best one."""
    first, *others = sorted(cost for cost in costs if np.isfinite(cost)) or [0.0]
    return others[0] - first if others else np.inf


def _cheapest(problem: QueueProblem, robot: int, queue: list[int], task: int) -> tuple[float, int]:
    """The least growth of the sum of times at which the tasks of a queue are done, and the place in the queue."""
    if not np.isfinite(problem.free_in[robot] + problem.approach[robot, task]):  # the robot cannot do it
        return np.inf, 0
    before = _sum_of_times(problem, robot, queue)
    longer = ([*queue[:place], task, *queue[place:]] for place in range(len(queue) + 1))
    grown = [_sum_of_times(problem, robot, it) - before for it in longer]
    place = int(np.argmin(grown))
    return grown[place], place


def _sum_of_times(problem: QueueProblem, robot: int, queue: list[int]) -> float:
    """Seconds from now until each task of a queue is done, added up."""
    profile, time, total = int(problem.profile[robot]), float(problem.free_in[robot]), 0.0
    for place, task in enumerate(queue):
        way = problem.between[profile, queue[place - 1], task] if place else problem.approach[robot, task]
        time += float(way + problem.length[robot, task])
        total += time
    return total
