"""Keeps robots that rotate in step: none leads the others by more than a distance, whatever each has to turn first.

A robot that leads by l along its segment may drive so fast that it stops before it leads by L. With acceleration a and
commands that hold for one period T, that is v T + v^2 / (2 a) <= L - l, hence v <= a (sqrt(T^2 + 2 (L - l) / a) - T).
The robot that is furthest behind is never slowed down, so a group always moves on.
"""

import numpy as np

from mrpbench_core.builtin.navigators.route_follower import RouteFollower
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.execution.orders import Orders

LEAD = 0.05
"""metres by which a robot may lead the last of its group."""


class InStep:
    """Limits the commands of robots that rotate.

    Args:
        follower: knows the routes.
        acceleration: f8[n] m/s^2 with which each robot brakes.
        period: control period, seconds.
    """

    def __init__(self, follower: RouteFollower, acceleration: Float, period: float) -> None:
        self._follower, self._acceleration, self._period = follower, acceleration, period

    def limit(self, twist: Float, pose: Float, orders: Orders) -> None:
        """Slow down, in `twist` f8[n,2], the robots that lead their groups; `pose` f8[n,3] is estimated."""
        for group in orders.in_step:
            robots, segments = np.array(group).T
            start, end = self._follower.segment_ends(robots, segments)
            along = end - start
            length = np.hypot(along[:, 0], along[:, 1])
            share = ((pose[robots, :2] - start) * along).sum(axis=1) / length**2
            lead = (share - share.min()) * length
            brake, period = self._acceleration[robots], self._period
            allowed = brake * (np.sqrt(period**2 + 2 * np.maximum(LEAD - lead, 0.0) / brake) - period)
            going = (self._follower.reached[robots] <= segments) & (twist[robots, 0] > allowed)
            twist[robots[going]] *= (allowed[going] / twist[robots[going], 0])[:, None]
