"""Recoveries in turn, for robots that do not get on, until they do or give up."""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.api.controller import FleetControllerSession
from mrpbench_core.api.recovery import Recovery, RecoverySession, Surroundings
from mrpbench_core.builtin.navigators.followers import Followers
from mrpbench_core.model.arrays import Bool, Float
from mrpbench_core.model.execution import Event
from mrpbench_core.model.fleet import RobotModel


class Rescue:
    """Attempts of all robots. As in Nav2, each robot's next attempt is with the recovery after its last one.

    Args:
        robots: the fleet.
        recoveries: by name, in order.
        patience: how many attempts a robot has between two waypoints.
        period: control period, simulated seconds.
        controllers: know what is free.
        followers: know which room was given to others.
    """

    def __init__(
        self,
        robots: Sequence[RobotModel],
        recoveries: Sequence[tuple[str, Recovery]],
        patience: int,
        period: float,
        controllers: FleetControllerSession,
        followers: Followers,
    ) -> None:
        self._robots, self._recoveries, self._patience, self._period = robots, recoveries, patience, period
        self._controllers, self._followers = controllers, followers
        self._going: dict[int, tuple[str, RecoverySession]] = {}
        self._next = [0] * len(robots)
        self._attempts = [0] * len(robots)
        self._reached = [0] * len(robots)
        self.recovering: Bool = np.zeros(len(robots), bool)
        self.aborted: Bool = np.zeros(len(robots), bool)

    def forgive(self) -> None:
        """Let robots that gave up try again."""
        self.aborted[:] = False
        self._attempts = [0] * len(self._robots)

    def begin(self, robot: int, now: float, pose: Float) -> list[Event]:
        """Begin the next attempt of a robot, or let it give up; returns the events that follow."""
        reached = int(self._followers.reached[robot])
        if reached > self._reached[robot]:
            self._reached[robot], self._attempts[robot] = reached, 0
        self._attempts[robot] += 1
        if self._attempts[robot] > self._patience or not self._recoveries:
            self.aborted[robot] = True
            return [Event(stamp=now, kind="aborted", robot=robot)]
        name, recovery = self._recoveries[self._next[robot] % len(self._recoveries)]
        self._next[robot] += 1
        session = recovery.start(self._robots[robot], self._surroundings(robot, pose), self._period)
        self._going[robot] = name, session
        self.recovering[robot] = True
        return [Event(stamp=now, kind="recovery", robot=robot, detail=name)]

    def step(self, now: float, pose: Float, measured: Float, twist: Float) -> list[Event]:
        """Let recovering robots act, into `twist` f8[n,2]; returns the events that follow."""
        events = []
        for robot, (name, session) in list(self._going.items()):
            answer = session.step(now, pose[robot], measured[robot])
            if isinstance(answer, bool):
                del self._going[robot]
                self.recovering[robot] = False
                if not answer:
                    events.append(Event(stamp=now, kind="recovery_failed", robot=robot, detail=name))
            else:
                twist[robot, 0], twist[robot, 1] = answer
        return events

    def _surroundings(self, robot: int, pose: Float) -> Surroundings:
        left_behind = self._followers.left_behind(robot, *pose[robot, :2].tolist())
        return _Reserved(self._controllers, robot, *left_behind)


class _Reserved(Surroundings):
    """What the controller knows, and that a robot must not come back to a vertex that it has left to others.

    Args:
        controllers: know what is free.
        robot: whose they are.
        vertex: x, y of the vertex that it left last, or None.
        distance: metres that it must keep from there.
    """

    def __init__(
        self, controllers: FleetControllerSession, robot: int, vertex: tuple[float, float] | None, distance: float
    ) -> None:
        self._controllers, self._robot = controllers, robot
        self._vertex, self._distance = vertex, distance

    def clear(self) -> None:
        self._controllers.clear(self._robot)

    def is_free(self, poses: Float) -> Bool:
        free = self._controllers.is_free(self._robot, poses)
        if self._vertex is None:
            return free
        kept: Bool = np.hypot(poses[:, 0] - self._vertex[0], poses[:, 1] - self._vertex[1]) >= self._distance
        return free & kept
