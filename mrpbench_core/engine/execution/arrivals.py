"""Which robots have arrived: what the navigator reports counts only where the true poses agree."""

from collections.abc import Sequence
from operator import is_

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int16, Int32
from mrpbench_core.model.execution.motion import Mode, Motion
from mrpbench_core.model.execution.route import Route, Routes, last_moves
from mrpbench_core.model.execution.state import State

REST = np.array([0.05, 0.2])
"""m/s and rad/s below which a robot is at rest."""
SETTLING_S = 5.0
"""Simulated seconds at rest after which a robot that is reported to be at its goal, and is not, will not get there."""


class Arrivals:
    """Compares the reports of a navigator with the true states of the robots.

    Args:
        routes: one per robot; a robot arrives at the last waypoint.
        tolerance: metres from there within which a robot has arrived.
    """

    def __init__(self, routes: Sequence[Route], tolerance: float) -> None:
        self._tolerance = tolerance
        self._rests_since = np.full(len(routes), np.inf)
        """f8[n]: since when robots that have reached all of their routes rest, as far as it is known."""
        self._no_robots: Bool = np.zeros(len(routes), bool)
        self._far = False
        """Whether a robot is reported to be where it is not."""
        self._recorded: Int32 = np.zeros(len(routes), np.int32)
        self.away: Float = np.full(len(routes), np.inf)
        """f8[n] metres from the goal, inf on another level or before any robot is reported to be there."""
        self.claimed: Bool = self._no_robots
        """bool[n]: the robot is reported to have arrived."""
        self.arrived: Bool = self.claimed
        """bool[n]: the robot is reported to have arrived, is at its goal, and rests."""
        self.mistaken: Bool = self.claimed
        """bool[n]: the robot is reported to have arrived, and stands elsewhere."""
        self.adopt(routes, self._recorded, np.ones(len(routes), bool))

    def adopt(self, routes: Sequence[Route], cut: Int32, leads: Bool) -> None:
        """Continue with the routes of a new plan.

        Args:
            routes: one per robot.
            cut: i4[n] segments that they leave out.
            leads: bool[n]: the route ends where its robot arrives.
        """
        self._reached: Int32 | None = None
        """The progress in the control period before."""
        self._finished: Int = np.zeros(0, np.int64)
        """i8[k]: robots that had reached all of their routes then."""
        self._compared: tuple[object, ...] = ()
        """What the last result followed from, if it follows from the same again."""
        self._leads = leads
        self._recorded = np.maximum(self._recorded - cut, 0).astype(np.int32)
        self._last: Int = last_moves(routes)
        joined = Routes.of(routes)
        self._goal: Float = joined.waypoint[joined.first[1:] - 1, :2]
        self._level: Int16 = joined.level[joined.first[1:] - 1]

    def update(self, now: float, state: State, motion: Motion) -> Motion:
        """Compare a report at `now` with the true state; return the report with confirmed arrivals only."""
        if motion.reached is not self._reached:
            self._reached, self._finished = motion.reached, (motion.reached >= self._last).nonzero()[0]
        at = self._finished
        if not len(at):
            if self._compared or self.claimed is not self._no_robots:
                self.claimed = self.arrived = self.mistaken = self._no_robots
                self._rests_since[:], self._compared = np.inf, ()
            self._recorded = motion.reached
            return motion
        pose, twist = state.pose.take(at, 0), state.twist.take(at, 0)
        compared = motion.mode, state.level, at.tobytes(), pose.tobytes(), twist.tobytes()
        before, self._compared = self._compared, compared
        if not self._far and before and all(map(is_, compared[:2], before)) and compared[2:] == before[2:]:
            self._recorded = motion.reached
            return motion
        return self._compare(now, state, motion)

    def _compare(self, now: float, state: State, motion: Motion) -> Motion:
        """Compare a report by which some robots have reached all of their routes."""
        finished: Bool = motion.reached >= self._last
        slow = np.abs(state.twist) < REST
        resting = finished & slow[:, 0] & slow[:, 1]
        np.minimum(self._rests_since, now, out=self._rests_since)
        self._rests_since[~resting] = np.inf
        offset = state.pose[:, :2] - self._goal
        self.away = np.hypot(offset[:, 0], offset[:, 1])
        self.away[state.level != self._level] = np.inf
        near = self.away <= self._tolerance
        self.claimed = finished & (motion.mode == Mode.WAITING)
        self.arrived = self.claimed & near & resting & self._leads
        far = finished & ~near
        self._far = bool(np.count_nonzero(far))
        self.mistaken = self.claimed & far & (now - self._rests_since >= SETTLING_S)
        early = far & (self._last > 0)
        if not np.count_nonzero(early):
            self._recorded = motion.reached
            return motion
        self._recorded = np.maximum(self._recorded, np.where(early, self._last - 1, motion.reached)).astype(np.int32)
        return attrs.evolve(motion, reached=self._recorded)

    def contradiction(self) -> str | None:
        """What the navigator reports and the true poses contradict, or None."""
        wrong = np.flatnonzero(self.claimed & ~(self.away <= self._tolerance))
        if not len(wrong):
            return None
        worst = wrong[self.away[wrong].argmax()]
        robots = "robot " if len(wrong) == 1 else "robots "
        robots += ", ".join(map(str, wrong[:5].tolist())) + (f" and {len(wrong) - 5} more" if len(wrong) > 5 else "")
        far = "on another level" if np.isinf(self.away[worst]) else f"{self.away[worst]:.2f} m from its goal"
        return f"the navigator reports that {robots} arrived, but robot {worst} is {far}"
