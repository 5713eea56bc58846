"""Robots that follow their paths without physics, in one or more executions of one plan at once.

Robots are numbered through all executions: robot i of execution j is number j n + i. Each step of NumPy moves the
robots of all executions, by the same operations in the same order as those of one, so that times are equal bit for bit.
"""

from collections.abc import Callable

import numpy as np

from mrpbench_core.engine.execution.scheduled_paths import ScheduledPaths
from mrpbench_core.model.common.arrays import Bool, Float, Int

Speed = Callable[[Int, Int], Float]
"""The relative speed f8[j] of each robot i8[j] on a segment i8[j] of its path."""


class ScheduledFleet:
    """The progress of d times n robots.

    Args:
        paths: of the n robots.
        executions: d.
        speed: of the robots.
    """

    def __init__(self, paths: ScheduledPaths, executions: int, speed: Speed) -> None:
        self._paths, self._speed, self._robots = paths, speed, len(paths.first)
        self.first: Int = np.tile(paths.first, executions)
        """The row i8[dn] of the tables of `paths` at which the path of each robot begins."""
        self.counts: Int = np.zeros((2, len(self.first)), np.int64)
        """Leading segments i8[2,dn] that each robot has reached, and has cleared."""
        self.reached, self.cleared = self.counts
        self.done: Float = np.zeros(len(self.first))
        """Seconds f8[dn] of the planned duration that each robot has made of its present move."""
        self.moves: Bool = np.zeros(len(self.first), bool)
        """bool[dn]: the robot has moved in the last control period."""

    def advance(self, released: Int, in_step: Int, left: Float, period: float) -> Int:
        """Let one control period pass; return the robots that may have moved.

        Args:
            released: i8[dn] leading segments that each robot may complete.
            in_step: i8[k,4] of robots that rotate; see `BatchOrders`.
            left: f8[dn] seconds in which each robot moves; changed.
            period: simulated seconds.
        """
        reached, all_done = self.reached, self.done
        candidates = np.flatnonzero(reached < released)
        waits = candidates
        while len(waits := waits[self._durations(waits) == 0]):
            reached[waits] += 1
            waits = waits[reached[waits] < released[waits]]
        slowest = None
        if len(in_step):
            released, slowest = released.copy(), np.full(len(left), np.inf)
            self._keep_in_step(in_step, released, left, slowest, period)
        robots = candidates[(reached[candidates] < released[candidates])]
        duration, left = self._durations(robots), left[robots]
        speed = self._speed(robots, reached[robots])
        if slowest is not None:
            speed = np.minimum(speed, slowest[robots])
        going = (left > 0) | (duration == 0)
        robots, duration, left, speed = robots[going], duration[going], left[going], speed[going]
        done = all_done[robots]
        self.moves[:] = False
        while len(robots):
            needed = (duration - done) / speed
            self.moves[robots] |= needed > 0
            ends = needed <= left + 1e-9
            goes_on = ~ends
            all_done[robots[goes_on]] = (done + left * speed)[goes_on]
            robots, left = robots[ends], np.maximum(left - needed, 0.0)[ends]
            reached[robots] += 1
            all_done[robots] = 0.0
            duration = self._durations(robots)
            going = (reached[robots] < released[robots]) & ((left > 0) | (duration == 0))
            robots, duration, left = robots[going], duration[going], left[going]
            speed, done = self._speed(robots, reached[robots]), np.zeros(len(robots))
        at = reached[candidates]
        cleared = self._paths.cleared(self.first[candidates] + at, at, all_done[candidates])
        self.cleared[candidates] = np.maximum(self.cleared[candidates], cleared)
        return candidates

    def _keep_in_step(self, in_step: Int, released: Int, left: Float, slowest: Float, period: float) -> None:
        """Let the members of each group begin together, and then go as long and as fast as the slowest of them.

        `slowest` gets the speed of the slowest one of each robot's group.
        """
        group, execution, robot, segment = in_step.T
        robot = execution * self._robots + robot
        count = int(group.max()) + 1
        apart = np.zeros(count, bool)
        apart[group[self.reached[robot] < segment]] = True
        held = apart[group]
        np.minimum.at(released, robot[held], segment[held])
        going = self.reached[robot] == segment
        group, robot = group[going], robot[going]
        least, pace = np.full(count, period), np.full(count, np.inf)
        np.minimum.at(least, group, left[robot])
        np.minimum.at(pace, group, self._speed(robot, self.reached[robot]))
        left[robot], slowest[robot] = least[group], pace[group]

    def _durations(self, robots: Int) -> Float:
        """Planned seconds of the present segment of each of `robots`."""
        durations: Float = self._paths.duration[self.first[robots] + self.reached[robots]]
        return durations
