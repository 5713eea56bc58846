"""Recoveries in turn for robots that are stuck, until they make progress or give up."""

import math
import re
from collections.abc import Sequence
from typing import Any

import attrs
import numpy as np

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.api.controller import FleetControllerSession
from mrpbench_core.api.recovery import Recovery, RecoverySession, Surroundings
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.execution.motion import Event
from mrpbench_navigators_waypoints.approaches import Approach
from mrpbench_navigators_waypoints.route_follower import RouteFollower
from mrpbench_navigators_waypoints.route_tables import SLACK


@attrs.frozen(kw_only=True)
class RecoveryOptions:
    """The recoveries that robots try, and their limits."""

    recoveries: Sequence[Recovery]
    """In the order in which a robot tries them."""
    max_recoveries: int
    """Attempts that a robot has between two waypoints."""
    period: float
    """Control period, simulated seconds."""


class RecoveryManager:
    """Runs the recoveries of all robots. As in Nav2, each attempt of a robot is with the recovery after its last one,
    and one that fails is followed by the next one at once.

    Args:
        robots: the fleet.
        options: what robots try.
        controllers: know which poses are free.
        follower: knows which vertices were left to other robots.
    """

    def __init__(
        self,
        robots: Sequence[RobotModel],
        options: RecoveryOptions,
        controllers: FleetControllerSession,
        follower: RouteFollower,
    ) -> None:
        self._robots, self._options = robots, options
        self._names = [_snake_case(type(recovery).__name__) for recovery in options.recoveries]
        self._controllers, self._follower = controllers, follower
        self._sessions: dict[int, tuple[str, RecoverySession]] = {}
        self._next = [0] * len(robots)
        self._attempts = [0] * len(robots)
        self._failed = [0] * len(robots)
        """Recoveries of each robot that have failed, one after another, in its attempt."""
        self._reached = [0] * len(robots)
        self.recovering: Bool = follower.activities.recovering
        self.aborted: Bool = follower.activities.aborted
        self._some_aborted = False

    def __bool__(self) -> bool:
        """Tell whether any robot recovers or has given up."""
        return bool(self._sessions) or self._some_aborted

    def reset(self) -> None:
        """Let robots that gave up try again."""
        self.aborted[:] = self._some_aborted = False
        self._attempts = [0] * len(self._robots)

    def begin(self, robot: int, now: float, pose: Float, events: list[Event]) -> bool:
        """Begin the next attempt of a robot and append its event, or let the robot give up and return False."""
        reached = int(self._follower.reached[robot])
        if reached > self._reached[robot]:
            self._reached[robot], self._attempts[robot] = reached, 0
        self._attempts[robot] += 1
        if self._attempts[robot] > self._options.max_recoveries or not self._names:
            self.aborted[robot] = self._some_aborted = True
            return False
        self._failed[robot] = 0
        self._begin_next(robot, now, pose, events)
        return True

    def _begin_next(self, robot: int, now: float, pose: Float, events: list[Event]) -> None:
        index = self._next[robot] % len(self._names)
        name, recovery = self._names[index], self._options.recoveries[index]
        self._next[robot] += 1
        session = recovery.start(self._robots[robot], self._surroundings(robot, pose), self._options.period)
        if not isinstance(session, RecoverySession):
            raise BrokenContractError(f"the recovery {name} returned {type(session).__name__} instead of a session")
        self._run(robot, now, name, session, events)

    def approach(self, robot: int, now: float, pose: Float, events: list[Event]) -> None:
        """Drive a robot straight to the end of its path; that is not one of its attempts."""
        place, period = self._follower.path_end(robot), self._options.period
        session = Approach(place, self._robots[robot], self._surroundings(robot, pose), period)
        self._run(robot, now, "drive_on_heading", session, events)

    def _run(self, robot: int, now: float, name: str, session: RecoverySession, events: list[Event]) -> None:
        self._sessions[robot] = name, session
        self.recovering[robot] = True
        events.append(Event(stamp=now, kind="recovery", robot=robot, detail=name))

    def step(self, now: float, pose: Float, measured: Float, twist: Float) -> list[Event]:
        """Write the commands of recovering robots into `twist` f8[n,2]; returns the events that follow."""
        events: list[Event] = []
        for robot, (name, session) in list(self._sessions.items()):
            answer = session.step(now, pose[robot], measured[robot])
            if isinstance(answer, bool):
                del self._sessions[robot]
                self.recovering[robot] = False
                if not answer:
                    events.append(Event(stamp=now, kind="recovery_failed", robot=robot, detail=name))
                    self._failed[robot] += 1
                    if not isinstance(session, Approach) and self._failed[robot] < len(self._names):
                        self._begin_next(robot, now, pose, events)
            else:
                twist[robot] = _command(answer, name, robot)
        return events

    def _surroundings(self, robot: int, pose: Float) -> Surroundings:
        here = pose[robot, :2]
        heading = self._follower.heading(robot, *here.tolist())
        if self._robots[robot].lidar is None:
            return _HeldSurroundings(self._controllers, robot, heading, self._follower.held_way(robot), here)
        vertex, distance = self._follower.cleared_vertex(robot, *here.tolist())
        return _KnownSurroundings(self._controllers, robot, heading, vertex, distance)


class _Surroundings(Surroundings):
    """The surroundings of a robot.

    Args:
        controllers: know which poses are free.
        robot: index of the robot.
        heading: radians, of the path ahead of it.
    """

    def __init__(self, controllers: FleetControllerSession, robot: int, heading: float) -> None:
        self._controllers, self._robot, self._heading = controllers, robot, heading

    def clear(self) -> None:
        self._controllers.clear(self._robot)

    def is_free(self, poses: Float) -> Bool:
        return self._controllers.is_free(self._robot, poses)

    def heading(self) -> float:
        return self._heading


class _KnownSurroundings(_Surroundings):
    """The surroundings of a robot, without the vertex that it has left to other robots.

    Args:
        controllers, robot, heading: see `_Surroundings`.
        vertex: x, y of the vertex that it cleared last, or None.
        distance: metres that it must keep from there.
    """

    def __init__(
        self,
        controllers: FleetControllerSession,
        robot: int,
        heading: float,
        vertex: tuple[float, float] | None,
        distance: float,
    ) -> None:
        super().__init__(controllers, robot, heading)
        self._vertex, self._distance = vertex, distance

    def is_free(self, poses: Float) -> Bool:
        free = super().is_free(poses)
        if self._vertex is None:
            return free
        apart: Bool = np.hypot(poses[:, 0] - self._vertex[0], poses[:, 1] - self._vertex[1]) >= self._distance
        return free & apart


class _HeldSurroundings(_Surroundings):
    """The surroundings of a robot without a lidar, which sees no other robot: the way that it still holds.

    Args:
        controllers, robot, heading: see `_Surroundings`.
        held: waypoints f8[k,2] that no other robot may be at, in order.
        here: f8[2], where the robot is; it need not come nearer to them.
    """

    def __init__(
        self, controllers: FleetControllerSession, robot: int, heading: float, held: Float, here: Float
    ) -> None:
        super().__init__(controllers, robot, heading)
        self._held = held
        self._distance = float(self._from_held(here[None])[0]) + SLACK

    def is_free(self, poses: Float) -> Bool:
        near: Bool = self._from_held(poses[:, :2]) <= self._distance
        return near & super().is_free(poses)

    def _from_held(self, points: Float) -> Float:
        """Metres f8[k] from the held way."""
        ends = np.concatenate([self._held[1:], self._held[-1:]])
        distance: Float = point_segment_distance(points[:, None], self._held, ends).min(axis=1)
        return distance


def _command(answer: Any, recovery: str, robot: int) -> tuple[float, float]:
    """The command that a recovery returned."""
    try:
        ahead, turn = map(float, answer)
    except (TypeError, ValueError):
        ahead = turn = math.nan
    if not (math.isfinite(ahead) and math.isfinite(turn)):
        expected = "instead of (speed, turn rate) or a bool"
        raise BrokenContractError(f"the recovery {recovery} returned {answer!r:.60} for robot {robot} {expected}")
    return ahead, turn


def _snake_case(name: str) -> str:
    """`back_up` for `BackUp`."""
    return re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower()
