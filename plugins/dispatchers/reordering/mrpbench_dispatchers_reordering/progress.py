"""How long robots have been on their moves, and how late they are."""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.type2_edges import Moves


class Progress:
    """Measures the time in which each robot could drive, which excludes the time in which it waits for others."""

    def __init__(self, robots: int) -> None:
        self._now = 0.0
        self._reached: Int = np.zeros(robots, np.int64)
        self._moves: Moves
        self._sum: Float
        self._may_drive: Bool = np.zeros(robots, bool)
        self.driven: Float = np.zeros(robots)
        """seconds f8[n] in which each robot had a move to make."""
        self._begin: Float = np.zeros(robots)
        """`driven` at the beginning of each robot's present move."""

    def use(self, problem: Problem, moves: Moves, cut: Int32 | None = None) -> None:
        """Continue with the `moves` of a plan that begins with what was released of the old one, but for `cut`."""
        if cut is not None:
            gone = self._sum[self._first_left(cut.astype(np.int64))] - self._sum[self._moves.first[:-1]]
            self.driven, self._begin = self.driven - gone, self._begin - gone
            self._reached = np.maximum(self._reached - cut, 0)
        self._moves = moves
        ticks = problem.roadmap.duration[problem.profile[moves.robot], moves.edge]
        self.duration: Float = ticks.astype(np.float64) * problem.roadmap.tick
        """Planned seconds f8[m] of each move."""
        self._sum = np.concatenate([[0.0], np.cumsum(self.duration)])
        self.present = self._first_left(self._reached)
        """The first move i8[n] that each robot has not completed, that of the next robot if it has completed all."""

    def update(self, now: float, reached: Int, released: Int32) -> None:
        """Take note of what robots have `reached` i8[n] at `now`, and of what is `released` i4[n] from now on."""
        self.driven = self.driven + (now - self._now) * self._may_drive
        present = self._first_left(reached)
        self._begin = np.where(present != self.present, self.driven, self._begin)
        self._now, self._reached, self.present = now, reached, present
        left = present < self._moves.first[1:]
        self._may_drive = left & (np.append(self._moves.segment, 0)[present] < released)

    @property
    def elapsed(self) -> Float:
        """Seconds f8[n] for which each robot could have been on its present move."""
        return self.driven - self._begin

    @property
    def lateness(self) -> Float:
        """Seconds f8[n] that each robot has lost on the moves of its path so far; negative if it is ahead."""
        planned = self._sum[self.present] - self._sum[self._moves.first[:-1]]
        late: Float = self.driven - planned - np.minimum(self.elapsed, np.append(self.duration, 0.0)[self.present])
        return late

    def moves_until(self, horizon: float) -> Int:
        """The first move i8[n] that each robot begins more than `horizon` seconds after its present one if it does not
        wait; that of another robot if it has none.
        """
        moves: Int = np.searchsorted(self._sum, self._sum[self.present] + horizon, side="right")
        return moves

    def _first_left(self, reached: Int) -> Int:
        keys = self._moves.robot * (1 << 32) + self._moves.segment
        return np.searchsorted(keys, np.arange(len(reached)) * (1 << 32) + reached)
