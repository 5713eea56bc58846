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

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.common.poses import wrapped
from mrpbench_core.model.execution.orders import Orders
from mrpbench_navigators_waypoints.route_follower import RouteFollower

LEAD = 0.02
"""metres by which a robot may lead the last of its group."""
OFFSET = 0.01
"""metres from its vertex at which a robot has settled there."""
FACING = 0.02
"""radians off its way at which a robot is ready to drive."""
TURN_RATE = 1.0
"""rad/s at most, as Nav2's `spin`."""
ASIDE = 0.1
"""radians off its way at which a robot that drives stops, and turns back first."""
_ADVANCE = 0.1
"""Share of a segment that counts as progress of a group."""
_STEERING = (20.0, 3.0)
"""Gains of the steering: rad/s for each metre to the side and m/s of speed, and rad/s for each radian."""

Group = tuple[tuple[int, int], ...]


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
        self._turn_rate = np.minimum([robot.max_turn_rate for robot in robots], TURN_RATE)
        self._in_step: tuple[Group, ...] = ()
        self._robots: Int = np.zeros(0, np.int64)
        """i8[k]: robots of the groups, one group after another; `_segments` i8[k] are theirs."""
        self._segments = self._robots
        self._first = self._robots
        """i8[g]: where each group begins in `_robots`; `_group` i8[k] is the group of each row."""
        self._group = self._robots
        self._ready: Bool = np.zeros(0, bool)
        """bool[k]: robots that stand at their vertex and face their way, or have done so and driven off."""
        self._progress: Float = np.zeros(0)
        """f8[g]: greatest progress of each group: robots that are ready, and the share that the last one has driven."""
        self._since: Float = np.zeros(0)
        """f8[g]: simulated second of that progress."""
        self.rotating: Bool = follower.activities.rotating
        """bool[n]: robots that are commanded here and not by their controllers."""
        self._nobody: Bool = np.zeros(len(robots), bool)

    def __bool__(self) -> bool:
        """Tell whether any robots rotate."""
        return bool(self._in_step)

    def update(self, now: float, orders: Orders) -> None:
        """Take note of the groups that rotate."""
        if orders.in_step != self._in_step:
            self._take(now, orders.in_step)
            self.rotating[:] = False
        if orders.in_step:
            self.rotating[:] = False
            reached, released = self._follower.reached[self._robots], orders.released[self._robots]
            robots = self._robots[(reached == self._segments) & (released > self._segments)]
            self.rotating[[robot for robot in robots.tolist() if not self._follower.only_turns(robot)]] = True

    def _take(self, now: float, in_step: tuple[Group, ...]) -> None:
        ready = {
            (group, place): bool(self._ready[first + place])
            for group, first in zip(self._in_step, self._first.tolist(), strict=True)
            for place in range(len(group))
        }
        known = {group: (self._progress[index], self._since[index]) for index, group in enumerate(self._in_step)}
        sizes = np.array([len(group) for group in in_step], np.int64)
        pairs = np.array([pair for group in in_step for pair in group], np.int64).reshape(-1, 2)
        self._in_step = in_step
        self._robots, self._segments = pairs.T
        self._first, self._group = np.cumsum(sizes) - sizes, np.repeat(np.arange(len(in_step)), sizes)
        self._ready = np.array(
            [ready.get((group, place), False) for group in in_step for place in range(len(group))], bool
        )
        self._progress, self._since = np.array([known.get(group, (0.0, now)) for group in in_step]).reshape(-1, 2).T

    def cut(self, cut: Int32) -> None:
        """Note that the first `cut` i4[n] segments of the routes are left out from now on."""
        self._in_step = tuple(
            tuple((robot, segment - int(cut[robot])) for robot, segment in group) for group in self._in_step
        )
        self._segments = self._segments - cut[self._robots]

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
        if not self._in_step:
            return self._nobody
        stuck = np.zeros(len(pose), bool)
        robots, follower = self._robots, self._follower
        mine = self.rotating[robots] & able[robots]
        start, end = follower.segment_ends(robots, self._segments)
        length = np.hypot(*(end - start).T)
        along = (end - start) / length[:, None]
        offset = pose[robots, :2] - start
        ahead = (offset * along).sum(axis=1)
        aside = along[:, 0] * offset[:, 1] - along[:, 1] * offset[:, 0]
        error = wrapped(pose[robots, 2] - np.arctan2(along[:, 1], along[:, 0]))
        driving = np.logical_and.reduceat(self._ready, self._first)[self._group]
        settled = np.hypot(ahead, aside) <= OFFSET
        self._ready |= mine & settled & (np.abs(error) <= FACING)
        share = np.where(follower.reached[robots] > self._segments, 1.0, ahead / length)
        last = np.minimum.reduceat(share, self._first)
        lead = (share - last[self._group]) * length
        command = np.zeros((len(robots), 2))
        for rows, commands in (
            (driving, self._along(np.minimum(LEAD - lead, length - ahead), aside, error)),
            (~driving & ~self._ready & settled, self._on_the_spot(-error)),
            (~driving & ~self._ready & ~settled, self._towards(start, pose[robots])),
        ):
            command[rows] = commands[rows]
        twist[robots[mine]] = command[mine]
        progress = np.add.reduceat(self._ready, self._first) + last
        advanced = progress > self._progress + _ADVANCE
        self._progress[advanced] = progress[advanced]
        late = ~advanced & (now - self._since > self._allowance)
        self._since[advanced | late] = now
        stuck[robots[mine & late[self._group]]] = True
        return stuck

    def _towards(self, place: Float, pose: Float) -> Float:
        """Commands f8[k,2] to turn to a place nearby, ahead or behind, and drive there."""
        dx, dy = (place - pose[:, :2]).T
        error = wrapped(np.arctan2(dy, dx) - pose[:, 2])
        back = np.abs(error) > np.pi / 2
        error = np.where(back, wrapped(error + np.pi), error)
        command = self._on_the_spot(error)
        speed = np.where(back, -1.0, 1.0) * self._stopping(np.hypot(dx, dy))
        command[:, 0] = np.where(np.abs(error) > ASIDE, 0.0, speed)
        return command

    def _along(self, distance: Float, aside: Float, error: Float) -> Float:
        """Commands f8[k,2] to drive along segments and to be able to stop within a distance.

        Args:
            distance: f8[k] metres.
            aside: f8[k] metres to the left of the segment.
            error: f8[k] radians off it.
        """
        command = self._on_the_spot(-error)
        speed, limit = self._stopping(distance), self._turn_rate[self._robots]
        steering = (-_STEERING[0] * speed * aside - _STEERING[1] * error).clip(-limit, limit)
        straight = np.abs(error) <= ASIDE
        command[straight] = np.column_stack([speed, steering])[straight]
        return command

    def _on_the_spot(self, angle: Float) -> Float:
        """Commands f8[k,2] to turn by angles, at rates from which the robots still stop there."""
        rate = stopping_speed(np.abs(angle), self._turn_brake[self._robots], self._period)
        return np.column_stack(
            [np.zeros(len(angle)), np.copysign(np.minimum(rate, self._turn_rate[self._robots]), angle)]
        )

    def _stopping(self, distance: Float) -> Float:
        """The speeds f8[k] from which robots still stop within a distance, metres."""
        speed = stopping_speed(distance, self._brake[self._robots], self._period)
        allowed: Float = np.minimum(self._speed[self._robots], self._follower.speed[self._robots])
        return np.minimum(speed, allowed, out=speed)


def stopping_speed(distance: Float | float, brake: Float | float, period: float) -> Float:
    """The speed from which a robot still stops within a distance, metres or radians; `brake` is its deceleration."""
    speed: Float = brake * (np.sqrt(period**2 + 2 * np.maximum(distance, 0.0) / brake) - period)
    return speed
