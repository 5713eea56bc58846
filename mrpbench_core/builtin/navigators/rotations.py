"""Drives robots that rotate: each stands at its vertex and faces its way before all of them drive, in step.

Robots of a rotation pass one another at a few centimetres, closer than controllers keep to a path. The navigator
therefore drives them itself, by the motions of Nav2's behaviours `spin` and `drive_on_heading`:

1. *settle*: each robot drives to within `OFFSET` of the vertex at which its segment starts;
2. *face*: it turns on the spot until it heads along the segment;
3. *drive*: when all robots of the group are ready, all drive. None leads the last one by more than `LEAD`.

In step 3, a robot that leads by l may drive so fast that it stops before it leads by L. With acceleration a and
commands that hold for one period T, that is v T + v^2 / (2 a) <= L - l, hence v <= a (sqrt(T^2 + 2 (L - l) / a) - T).
The robot that is furthest behind is never slowed down, so a group always moves on.
"""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.builtin.navigators.route_follower import RouteFollower
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.common.poses import wrapped

LEAD = 0.02
"""metres by which a robot may lead the last of its group."""
OFFSET = 0.01
"""metres from its vertex at which a robot has settled there."""
FACING = 0.02
"""radians off its way at which a robot is ready to drive."""
_TURN_RATE = 1.0
"""rad/s at most, as Nav2's `spin`."""
_ASIDE = 0.1
"""radians off its way at which a robot that drives stops, and turns back first."""
_STEERING = (20.0, 3.0)
"""Gains of the steering: rad/s for each metre to the side and m/s of speed, and rad/s for each radian."""

Group = tuple[tuple[int, int], ...]


@attrs.define
class _Progress:
    """How far a group is."""

    ready: Bool
    """bool[k]: robots that stand at their vertex and face their way, or have driven off."""
    furthest: float = 0.0
    """Share of its segment that the last robot has driven."""
    since: float = 0.0
    """Simulated second of the latest progress."""


class Rotations:
    """Commands robots that rotate.

    Args:
        follower: knows the routes.
        robots: the fleet.
        period: control period, seconds.
        allowance: simulated seconds within which a group has to make progress.
    """

    def __init__(self, follower: RouteFollower, robots: Sequence[RobotModel], period: float, allowance: float) -> None:
        self._follower, self._period, self._allowance = follower, period, allowance
        self._brake = np.array([robot.acceleration for robot in robots])
        self._turn_brake = np.array([robot.turn_acceleration for robot in robots])
        self._speed = np.array([robot.max_speed for robot in robots])
        self._turn_rate = np.minimum([robot.max_turn_rate for robot in robots], _TURN_RATE)
        self._groups: dict[Group, _Progress] = {}
        self.rotating: Bool = np.zeros(len(robots), bool)
        """bool[n]: robots that are commanded here and not by their controllers."""

    def update(self, now: float, in_step: tuple[Group, ...]) -> None:
        """Take note of the groups of `Orders.in_step`."""
        self._groups = {
            group: self._groups.get(group) or _Progress(np.zeros(len(group), bool), since=now) for group in in_step
        }
        self.rotating[:] = False
        for group in self._groups:
            robots, segments = np.array(group).T
            here = self._follower.reached[robots] == segments
            here &= [not self._follower.only_turns(robot) for robot in robots.tolist()]
            self.rotating[robots[here]] = True

    def command(self, now: float, pose: Float, able: Bool, twist: Float) -> Bool:
        """Write the commands of rotating robots into `twist` f8[n,2].

        Args:
            now: simulated seconds.
            pose: f8[n,3] estimated.
            able: bool[n] robots that neither recover nor have given up.
            twist: of the fleet.

        Returns:
            bool[n]: rotating robots whose group has made no progress for too long; its time begins anew.
        """
        stuck = np.zeros(len(pose), bool)
        for group, progress in self._groups.items():
            robots, segments = np.array(group).T
            mine = self.rotating[robots] & able[robots]
            before = int(progress.ready.sum())
            share = self._command_group(robots, segments, pose, mine, progress, twist)
            if int(progress.ready.sum()) > before or share > progress.furthest + 0.1:
                progress.furthest, progress.since = max(share, progress.furthest), now
            elif now - progress.since > self._allowance:
                stuck[robots[mine]] = True
                progress.since = now
        return stuck

    def _command_group(
        self, robots: Int, segments: Int, pose: Float, mine: Bool, progress: _Progress, twist: Float
    ) -> float:
        """Command the robots `mine` bool[k] of one group; returns the least share of a segment driven."""
        start, end = self._follower.segment_ends(robots, segments)
        length = np.hypot(*(end - start).T)
        along = (end - start) / length[:, None]
        offset = pose[robots, :2] - start
        ahead = (offset * along).sum(axis=1)
        aside = along[:, 0] * offset[:, 1] - along[:, 1] * offset[:, 0]
        error = wrapped(pose[robots, 2] - np.arctan2(along[:, 1], along[:, 0]))
        settled = np.hypot(ahead, aside) <= OFFSET
        driving = bool(progress.ready.all())
        if not driving:
            progress.ready |= mine & settled & (np.abs(error) <= FACING)
        share = np.where(self._follower.reached[robots] > segments, 1.0, ahead / length)
        lead = (share - share.min()) * length
        for index in mine.nonzero()[0].tolist():
            robot = int(robots[index])
            if driving:
                v = min(self._stopping(robot, LEAD - lead[index]), self._stopping(robot, length[index] - ahead[index]))
                command = self._along(robot, v, float(aside[index]), float(error[index]))
            elif progress.ready[index]:
                command = 0.0, 0.0
            elif settled[index]:
                command = 0.0, self._turning(robot, -float(error[index]))
            else:
                command = self._towards(robot, start[index], pose[robot])
            twist[robot] = command
        return float(share.min())

    def _towards(self, robot: int, place: Float, pose: Float) -> tuple[float, float]:
        """Turn to a place nearby, ahead or behind, and drive there."""
        dx, dy = place - pose[:2]
        error = float(wrapped(np.arctan2(dy, dx) - pose[2]))
        back = abs(error) > np.pi / 2
        error = float(wrapped(error + np.pi)) if back else error
        if abs(error) > _ASIDE:
            return 0.0, self._turning(robot, error)
        v = self._stopping(robot, float(np.hypot(dx, dy)))
        return -v if back else v, self._turning(robot, error)

    def _along(self, robot: int, v: float, aside: float, error: float) -> tuple[float, float]:
        """Drive along the segment, `aside` metres to the left of it and `error` radians off it."""
        if abs(error) > _ASIDE:
            return 0.0, self._turning(robot, -error)
        rate = -_STEERING[0] * v * aside - _STEERING[1] * error
        return v, float(np.clip(rate, -self._turn_rate[robot], self._turn_rate[robot]))

    def _stopping(self, robot: int, distance: float) -> float:
        """The speed from which a robot still stops within a distance, metres."""
        speed = _stopping_speed(distance, self._brake[robot], self._period)
        return min(speed, float(self._speed[robot]), float(self._follower.speed[robot]))

    def _turning(self, robot: int, angle: float) -> float:
        """The turn rate from which a robot still stops within an angle, radians."""
        rate = _stopping_speed(abs(angle), self._turn_brake[robot], self._period)
        return float(np.copysign(min(rate, self._turn_rate[robot]), angle))


def _stopping_speed(distance: float, brake: float, period: float) -> float:
    return float(brake * (np.sqrt(period**2 + 2 * max(distance, 0.0) / brake) - period))
