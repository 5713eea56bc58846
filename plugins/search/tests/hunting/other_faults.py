"""Faults of other kinds than those in `faulty.py`: of a planner in time, of a dispatcher that waits, of an assigner."""

from unittest.mock import patch

import attrs
import numpy as np
from mrpbench_assigners_greedy import Greedy
from mrpbench_planners_example import cooperative_astar

from mrpbench_core.api import Planner, Promise
from mrpbench_core.builtin.dispatchers.adg import Adg, AdgSession
from mrpbench_core.model.common.arrays import frozen_array


@attrs.frozen(kw_only=True)
class ForgetsParked(Planner):
    """Plans as `example`, but forgets a robot that has stood at its goal for some ticks."""

    promises = frozenset({Promise.CONFLICT_FREE})
    after = 12

    def plan(self, problem, budget):
        after = self.after

        class Reservations(cooperative_astar.Reservations):
            def allow(self, tail, head, tick):
                parked = self.parked.get(head, np.inf)
                return super().allow(tail, head, tick) or (
                    tick > parked + after and (head, tick) not in self.places and (head, tail, tick) not in self.moves
                )

        with patch.object(cooperative_astar, "Reservations", Reservations):
            return cooperative_astar.Example().plan(problem, budget)


@attrs.frozen(kw_only=True)
class LosesWakeUp(Adg):
    """Releases as `adg`, but never again to the last one of four robots of which each stands waiting for the next."""

    def start(self, problem, plan):
        return LosesWakeUpSession(self, problem, plan)


class LosesWakeUpSession(AdgSession):
    lost = frozenset()

    def batch(self, executions):
        return None

    def _release(self):
        before = self.released
        super()._release()
        waits = [
            set(self.graph.blockers(robot)) if self.released[robot] == self.counts[0][robot] else set()
            for robot in range(len(self.released))
        ]

        def before_it(robot, behind=()):
            if robot in behind:
                return 0
            return max((1 + before_it(other, (*behind, robot)) for other in waits[robot]), default=0)

        self.lost |= {robot for robot in range(len(waits)) if before_it(robot) > 2}
        if self.lost:
            kept = self.released.copy()
            for robot in self.lost:
                kept[robot] = before[robot]
            self.released = frozen_array(kept, "i4")


@attrs.frozen(kw_only=True)
class KeyedByGoal(Greedy):
    """Assigns as `greedy`, but keeps waiting tasks by their goal, and loses the first of two with the same one."""

    def assign_queues(self, problem):
        waiting = {tuple(task.goals[-1, :2].tolist()): index for index, task in enumerate(problem.tasks)}
        if len(waiting) < len(problem.tasks):
            raise KeyError("a task that waits is not known")
        return super().assign_queues(problem)
