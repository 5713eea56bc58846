"""Drives robots on to the ends of their paths where their controllers come no nearer.

Nav2's controllers need not come nearer to a goal than its tolerance, 0.25 m. Here paths end at bends and at places
where robots make room, and robots have to come within 0.10 m or less: others wait for that. Not every controller can:
the grids of DWB have cells of 0.05 m, and no critic of MPPI lets a robot turn to a place beside it.
"""

import math
from collections.abc import Iterable

import numpy as np

from mrpbench_core.api.recovery import RecoverySession, Surroundings
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_navigators_waypoints.rotations import ASIDE, TURN_RATE, stopping_speed
from mrpbench_navigators_waypoints.route_follower import RouteFollower
from mrpbench_navigators_waypoints.route_tables import FINE

REACH = 0.25
"""metres from the end of its path within which a robot is driven there: the goal tolerance of Nav2."""
_NEARER = 0.01
"""metres by which a robot that drives comes nearer from one look to the next."""
_DRIVING = (0.1, 0.3)
"""m/s and rad/s: a robot that is commanded more is to move, even if something holds it."""
_TIME_ALLOWANCE = 10.0
"""seconds, as that of Nav2's behaviours."""


class Approaches:
    """Finds robots that stand near the ends of their paths, but have not reached them.

    Args:
        follower: knows the paths.
    """

    def __init__(self, follower: RouteFollower) -> None:
        self._follower = follower
        self._seen: dict[int, tuple[int, float]] = {}
        """The end of the path of each robot that did not move when it was looked at, and metres from there."""
        self._tried: dict[int, int] = {}
        """The end to which each robot was driven last."""

    def reset(self) -> None:
        """Forget all ends: there are new routes."""
        self._seen.clear()
        self._tried.clear()

    def find(self, robots: Iterable[int], pose: Float, command: Float) -> list[int]:
        """Return those of `robots`, which hardly move, that also did not come nearer to the end since they were here.

        Each robot is found once for each end. `pose` f8[n,3] and `command` f8[n,2] are those of the fleet.
        """
        return [robot for robot in robots if self._stands(robot, pose[robot], command[robot])]

    def _stands(self, robot: int, pose: Float, command: Float) -> bool:
        follower, others = self._follower, self._follower.activities
        if others.recovering[robot] or others.aborted[robot] or others.detouring[robot]:
            return False
        if not follower.under_way[robot] or follower.only_turns(robot):
            return False
        end, left = int(follower.end[robot]), math.dist(follower.path_end(robot), pose[:2].tolist())
        before = self._seen.get(robot)
        self._seen[robot] = end, left
        stands = before is not None and before[0] == end and before[1] - left < _NEARER
        if not stands or left > REACH or self._tried.get(robot) == end or (np.abs(command) > _DRIVING).any():
            return False
        self._tried[robot] = end
        return True


class Approach(RecoverySession):
    """Turns a robot to a place nearby, ahead or behind, and drives it there, as far as the way is free.

    Args:
        place: x, y, metres.
        robot: which drives.
        surroundings: where it may be.
        period: control period, simulated seconds.
    """

    def __init__(
        self, place: tuple[float, float], robot: RobotModel, surroundings: Surroundings, period: float
    ) -> None:
        self._place, self._robot, self._surroundings, self._period = place, robot, surroundings, period
        self._until: float | None = None

    def step(self, now: float, pose: Float, twist: Float) -> tuple[float, float] | bool:  # noqa: ARG002
        """Return the next command, or whether the robot has arrived."""
        if self._until is None:
            self._until = now + _TIME_ALLOWANCE
        x, y, yaw = pose.tolist()
        away = np.subtract(self._place, (x, y))
        left = float(np.hypot(*away))
        if left <= FINE:
            return True
        error = math.remainder(math.atan2(away[1], away[0]) - yaw, math.tau)
        back = abs(error) > math.pi / 2
        error = math.remainder(error + math.pi, math.tau) if back else error
        ahead = np.array([x, y]) + np.outer((0.5, 1.0), away * FINE / left)
        way = np.column_stack([ahead, np.full(2, yaw + error)])
        if now > self._until or not self._surroundings.is_free(way).all():
            return False
        if abs(error) > ASIDE:
            rate = float(stopping_speed(abs(error), self._robot.turn_acceleration, self._period))
            return 0.0, math.copysign(min(rate, TURN_RATE, self._robot.max_turn_rate), error)
        speed = min(float(stopping_speed(FINE, self._robot.acceleration, self._period)), self._robot.max_speed)
        return -speed if back else speed, 0.0
