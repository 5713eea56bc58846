"""Leaves out of plans what robots drove long ago, so that an execution needs no more memory the longer it lasts.

Components count segments from the beginning of what is left. Recordings count all segments that a robot has driven, so
that nothing in them depends on what is left out.
"""

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.execution.motion import Motion
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.planning.plan import Paths, Plan
from mrpbench_core.model.planning.problem import Problem

KEPT = 8
"""Driven segments that are kept: robots may still be beside them, and uses of doors and rotations may begin there."""


def driven(plan: Plan, reached: Int32, cleared: Int32) -> Int32:
    """Return how many leading segments i4[n] of each path may be left out.

    A robot has completed these and left the start of each. Waits at the end of a path are never left: of these it is
    enough that they are completed.

    Args:
        plan: the current one.
        reached: i4[n] leading segments that each robot has completed.
        cleared: i4[n] leading segments whose start it has left.
    """
    paths = Paths.of(plan.paths)
    moves = np.concatenate([[0], np.cumsum(paths.edge >= 0)])
    left = moves[paths.first[:-1] + np.minimum(cleared, reached)] == moves[paths.first[:-1] + reached]
    done: Int32 = np.maximum(np.where(left, reached, cleared) - KEPT, 0).astype(np.int32)
    return done


def without(problem: Problem, commitments: Paths, cut: Int32) -> Problem:
    """Return a problem whose `commitments` lack the first `cut` i4[n] segments; it begins where and when these end."""
    start, ready, since = problem.start.copy(), problem.ready.copy(), problem.begins.copy()
    gone = commitments.part(np.zeros_like(cut), cut)
    move = gone.edge >= 0
    start[gone.robot[move]] = problem.roadmap.edges[gone.edge[move]].reshape(-1, 2)[:, 1]  # the last one counts
    since[gone.robot] = gone.leave
    ready[cut > 0] = since[cut > 0]
    return attrs.evolve(
        problem, start=start, ready=ready, since=since, commitments=commitments.part(cut, commitments.size)
    )


class DrivenSegments:
    """Counts what was left out, and restores the counts of all segments for the recording."""

    def __init__(self, robots: int) -> None:
        self.count: Int32 = np.zeros(robots, np.int32)
        """i4[n] segments of each robot that were left out."""
        self._cleared = self.count
        self._some = False

    def cut(self, cut: Int32) -> None:
        """Note that `cut` i4[n] more segments are left out."""
        self.count = self.count + cut
        self._some = bool(self.count.any())

    def orders(self, orders: Orders) -> Orders:
        """The orders, counted from the first segment of all."""
        if not self._some:  # the usual case in every control period, here and below
            return orders
        return attrs.evolve(orders, released=orders.released + self.count)

    def motion(self, motion: Motion) -> Motion:
        """The same of how far the robots are. A robot that stands at the end of its path clears nothing."""
        if not self._some:
            self._cleared = motion.cleared
            return motion
        self._cleared = np.where(motion.cleared > 0, motion.cleared + self.count, self._cleared)
        return attrs.evolve(motion, reached=motion.reached + self.count, cleared=self._cleared)


def shifted(motion: Motion, cut: Int32) -> Motion:
    """Return how far robots are, counted without the first `cut` i4[n] segments."""
    return attrs.evolve(motion, reached=motion.reached - cut, cleared=np.maximum(motion.cleared - cut, 0))
