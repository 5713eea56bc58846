"""The assigner of token passing: robots that become free choose among tasks whose places are no robot's destination.

Ma, Li, Kumar and Koenig, "Lifelong Multi-Agent Path Finding for Online Pickup and Delivery Tasks", AAMAS 2017: TP, and
with task swaps TPTS.
"""

import attrs
import numpy as np

from mrpbench_assigners_greedy.greedy import Greedy
from mrpbench_core.api.component import option
from mrpbench_core.model.planning.assignment import QueueProblem, Queues
from mrpbench_core.model.planning.problem import GoalSet


@attrs.frozen(kw_only=True)
class TokenPassing(Greedy):
    """Free robots choose one after another: each takes the task whose first errand is nearest, of those whose errands
    are at places to which no other robot is on its way. The planner `token_passing` then finishes all tasks if they are
    well-formed.

    Unlike in the paper, robots rest at every errand, so that pickups of others count as deliveries do, and swaps
    compare ways without other robots. Tasks of a batch are assigned as by `greedy`.
    """

    task_swaps: bool = option(
        False,
        help="a robot may take over a task that is not begun if it is there sooner than the robot that has it, which "
        "then chooses again (TPTS)",
    )

    def assign_queues(self, problem: QueueProblem) -> Queues:
        """Return queues of at most one task; a robot keeps its task until it is done, or taken over."""
        token = _Token(problem, self.task_swaps)
        for robot in np.flatnonzero(problem.free_in <= self.look_ahead).tolist():
            if token.task[robot] < 0:
                token.choose(robot)
        return tuple((task,) if task >= 0 else () for task in token.task)


class _Token:
    """What all robots know: who goes where."""

    def __init__(self, problem: QueueProblem, swaps: bool) -> None:
        self._problem, self._swaps = problem, swaps
        self._soonest = problem.free_in[:, None] + problem.approach
        self.task = [
            queue[0] if queue and np.isfinite(self._soonest[robot, queue[0]]) else -1
            for robot, queue in enumerate(problem.queues)
        ]
        """Of each robot, -1 = none."""

    def choose(self, robot: int) -> None:
        """Give a robot the nearest task that it may have; a robot that loses its task chooses next.

        This ends, because with each swap the robot that goes to a task is there sooner.
        """
        reaches = self._soonest[robot]
        for task in np.argsort(reaches, kind="stable").tolist():
            if not np.isfinite(reaches[task]):
                return
            holder = self.task.index(task) if task in self.task else -1
            if holder >= 0 and not (self._swaps and reaches[task] < self._soonest[holder, task]):
                continue
            if not _all_free(self._errands(task), self._wanted({robot, holder})):
                continue
            self.task[robot] = task
            if holder >= 0:
                self.task[holder] = -1
                self.choose(holder)
            return

    def _errands(self, task: int) -> tuple[GoalSet, ...]:
        return self._problem.errands[task] if self._problem.errands else ()

    def _wanted(self, without: set[int]) -> set[int]:
        """The vertices that robots, `without` some, still go to: one for each errand, which no other robot needs."""
        begun = (it for robot, it in enumerate(self._problem.ahead) if robot not in without)
        chosen = (self._errands(task) for robot, task in enumerate(self.task) if task >= 0 and robot not in without)
        wanted = set[int]()
        for errands in (*begun, *chosen):
            wanted |= {next((it for it in places if it not in wanted), places[0]) for places in errands}
        return wanted


def _all_free(errands: tuple[GoalSet, ...], wanted: set[int]) -> bool:
    """Tell whether each errand has a place that is not `wanted`."""
    return all(set(places) - wanted for places in errands)
