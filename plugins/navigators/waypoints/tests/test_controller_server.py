"""A controller may know no admissible command for a while before a robot recovers."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_navigators_waypoints.controller_server import ControllerServer

from mrpbench_core.api.controller import FleetControllerSession
from mrpbench_core.model.execution.observation import Observations

PERIOD = 0.1


class Told(FleetControllerSession):
    """Has commands for the robots that it is told."""

    def __init__(self):
        super().__init__(())

    def command(self, observations):
        return np.where(self.has[observations.robot, None], 0.1, np.nan) * np.ones(2)


def seen(now, robots):
    """What the controllers of `robots` see; only `now` and the robots matter."""
    rows, none = np.zeros((len(robots), 3)), np.zeros(len(robots))
    return Observations(
        now=now, robot=robots, pose=rows, twist=rows[:, :2], foot=rows[:, :2], points=rows[:, :2], begin=robots,
        end=robots, yaw=none, speed=none, fleet_pose=rows,
    )  # fmt: skip


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 2**32 - 1), st.sampled_from([0.0, 0.25, 0.55]))
def test_a_robot_fails_when_it_has_followed_without_a_command_for_longer_than_tolerated(seed, tolerance):
    random, controllers, last = np.random.default_rng(seed), Told(), np.zeros(3)
    server = ControllerServer(controllers, "Told", tolerance)
    for step in range(60):
        now, following = step * PERIOD, random.random(3) < 0.9
        controllers.has = random.random(3) < 0.3
        _, missing = server.command(seen(now, np.flatnonzero(following)))
        without = np.flatnonzero(~controllers.has[following]).tolist()
        assert (missing.nonzero()[0].tolist() == without) if without else (missing is None)
        last[controllers.has | ~following] = now
        expected = np.flatnonzero(now - last > tolerance).tolist()
        assert server.have_failed(now) == expected
        last[expected] = now
