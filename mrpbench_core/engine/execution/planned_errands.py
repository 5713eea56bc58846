"""The errands to which the paths of robots lead, from when a plan is asked for until the next one is executed."""

from collections.abc import Callable, Sequence

import numpy as np

from mrpbench_core.engine.execution.destinations import Errands
from mrpbench_core.model.common.arrays import Int


class PlannedErrands:
    """Keeps what is ahead of each robot in the current plan."""

    def __init__(self, robots: int) -> None:
        self.ahead: list[Errands] = [()] * robots
        """What the path of each robot leads to, from now on."""
        self._asked: Sequence[Errands] = self.ahead
        self._planned: list[Errands] = [()] * robots
        """What robots had to do when the current plan was asked for, but for what is done since then."""
        self.gone: Int = np.zeros(robots, np.int64)
        """i8[n]: how many errands of the current plan are not ahead any more."""

    def ask(self, wanted: Sequence[Errands]) -> None:
        """Note what robots have to do when a plan is asked for."""
        self._asked = wanted

    def adopt(self, errands: Sequence[Errands], done: Callable[[tuple[int, int]], bool]) -> None:
        """Note that the paths of a plan lead to these errands, of which some may be `done` since it was asked for."""
        self.ahead, self._planned = [*errands], [*self._asked]
        self.gone = np.zeros(len(errands), np.int64)
        for robot, way in enumerate(errands):
            if way and done(way[0]):
                gone = next((number for number, errand in enumerate(way) if not done(errand)), len(way))
                self.gone[robot], self.ahead[robot] = gone, way[gone:]
                self._planned[robot] = self._asked[robot][gone:]

    def visit(self, robot: int) -> tuple[int, int]:
        """Note that a robot has been at the next errand of its path, and return that."""
        errand, *_ = self.ahead[robot]
        self.ahead[robot] = self.ahead[robot][1:]
        self.gone[robot] += 1
        if self._planned[robot][:1] == (errand,):
            self._planned[robot] = self._planned[robot][1:]
        return errand

    def drop(self, robot: int) -> None:
        """Let a robot need another plan."""
        self._planned[robot] = ()

    def others(self, wanted: Sequence[Errands]) -> list[int]:
        """Return the robots that had something else to do when the current plan was asked for.

        What is `wanted` may begin with what was planned, and go on.
        """
        both = enumerate(zip(self._planned, wanted, strict=True))
        return [robot for robot, (old, new) in both if not (new == old or (old and new[: len(old)] == old))]
