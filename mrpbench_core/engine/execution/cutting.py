"""Leaves out of plans what robots drove long ago, so that an execution needs no more memory the longer it lasts.

Components count segments from the beginning of what is left. Recordings count all segments that a robot has driven, so
that nothing in them depends on what is left out.
"""

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.execution.motion import Motion
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.planning.plan import Path, Plan
from mrpbench_core.model.planning.problem import Problem

KEPT = 8
"""Driven segments that are kept: robots may still be beside them, and uses of doors and rotations may begin there."""


def driven(plan: Plan, reached: Int32, cleared: Int32) -> Int32:
    """Return how many leading segments i4[n] of each path may be left out.

    A robot has completed these and left the start of each. Waits at the end of a path are never left: of these it is
    enough that they are completed.

    Args:
        plan: in force.
        reached: i4[n] leading segments that each robot has completed.
        cleared: i4[n] leading segments whose start it has left.
    """
    done = reached.copy()
    for robot in np.flatnonzero(cleared < reached).tolist():
        if (plan.paths[robot].edge[cleared[robot] : reached[robot]] >= 0).any():
            done[robot] = cleared[robot]
    return np.maximum(done - KEPT, 0).astype(np.int32)


def without(problem: Problem, commitments: tuple[Path, ...], cut: Int32) -> Problem:
    """Return a problem whose `commitments` lack the first `cut` i4[n] segments; it begins where and when these end."""
    start, ready = problem.start.copy(), problem.ready.copy()
    since = np.array([problem.begin(robot) for robot in range(len(problem))], np.int64)
    left = list(commitments)
    for robot in np.flatnonzero(cut).tolist():
        path, first = commitments[robot], int(cut[robot])
        moves = np.flatnonzero(path.edge[:first] >= 0)
        if len(moves):
            start[robot] = problem.roadmap.edges[path.edge[moves[-1]], 1]
        since[robot], ready[robot] = path.leave[first - 1], 0
        left[robot] = Path(edge=path.edge[first:], enter=path.enter[first:], leave=path.leave[first:])
    return attrs.evolve(problem, start=start, ready=ready, since=since, commitments=tuple(left))


class DrivenSegments:
    """Counts what was left out, and restores the counts of all segments for the recording."""

    def __init__(self, robots: int) -> None:
        self.count: Int32 = np.zeros(robots, np.int32)
        """i4[n] segments of each robot that were left out."""
        self._cleared = self.count

    def cut(self, cut: Int32) -> None:
        """Note that `cut` i4[n] more segments are left out."""
        self.count = self.count + cut

    def orders(self, orders: Orders) -> Orders:
        """The orders, counted from the first segment of all."""
        return attrs.evolve(orders, released=orders.released + self.count)

    def motion(self, motion: Motion) -> Motion:
        """The same of how far the robots are. A robot that stands at the end of its path clears nothing."""
        self._cleared = np.where(motion.cleared > 0, motion.cleared + self.count, self._cleared)
        return attrs.evolve(motion, reached=motion.reached + self.count, cleared=self._cleared)


def shifted(motion: Motion, cut: Int32) -> Motion:
    """Return how far robots are, counted without the first `cut` i4[n] segments."""
    return attrs.evolve(motion, reached=motion.reached - cut, cleared=np.maximum(motion.cleared - cut, 0))
