import numpy as np
import pytest

from mrpbench_core.builtin.localizers.odometry import DeadReckoning
from mrpbench_core.config.settings import Noise
from mrpbench_core.engine.execution.noise import Disturbances
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.common.poses import composed, wrapped
from mrpbench_core.model.execution.observation import Odometry
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.worlds.world import Level, World
from mrpbench_core.testing.fixtures.room import PERIOD, ROBOT, driven

WORLD = World(name="empty", levels=(Level(name="L1"),))
PLACES = np.array([[1.0, 2.0, 0.5], [3.0, 1.0, -2.0]])


def start():
    return DeadReckoning().start(Fleet(robots=(ROBOT,) * 2), WORLD, PLACES, 0)


def test_the_truth_is_not_needed():
    assert not DeadReckoning.needs_truth


@pytest.mark.parametrize("frame", [(0.0, 0.0, 0.0), (5.0, -3.0, 2.0)])
def test_the_frame_of_the_odometry_does_not_matter(frame):
    session, pose, twist = start(), PLACES, np.array([(0.2, 0.3), (0.1, -0.5)])
    for step in range(200):
        seen = composed(np.array(frame), pose)
        estimate = session.update(step * PERIOD, Odometry(pose=seen, twist=twist), (), None)
        off = estimate.pose - pose
        off[:, 2] = wrapped(off[:, 2])
        assert np.abs(off).max() < 1e-9
        pose = driven(pose, twist, PERIOD)


def test_the_estimate_drifts_as_the_odometry_does():
    fleet, twist = Fleet(robots=(ROBOT,) * 2), np.array([(0.2, 0.3)] * 2)
    noise, session, pose = Disturbances(Noise(odometry=0.01), fleet, PLACES, PERIOD, Seeds(1)), start(), PLACES
    for step in range(400):
        odometry = noise.odometry(State(pose=pose, twist=twist, level=[0, 0], contacts=[]))
        estimate = session.update(step * PERIOD, odometry, (), None)
        pose = driven(pose, twist, PERIOD)
    assert np.allclose(estimate.pose, odometry.pose, atol=1e-9)
    assert (np.hypot(*(estimate.pose - pose)[:, :2].T) > 0.02).all()
