"""Filters in a world of which their map lacks parts."""

import attrs
import numpy as np
import pytest
from mrpbench_localizers_amcl import Amcl
from mrpbench_simulators_planar import Planar

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.common.poses import composed, relative, wrapped
from mrpbench_core.model.execution.observation import Odometry
from mrpbench_core.model.execution.state import Inputs
from mrpbench_core.model.worlds.world import Level, Obstacle, World

PERIOD = 0.05
BURGER = load_robot("turtlebot3_burger")
ROOM = World(
    name="room",
    levels=(
        Level(
            name="L1",
            walls=[[0, 0, 5, 0], [5, 0, 5, 4], [5, 4, 0, 4], [0, 4, 0, 0], [3, 0, 3, 1.2]],
            obstacles=(Obstacle(name="crate", polygon=[[1, 2.6], [1.6, 2.8], [1.2, 3.4]]),),
        ),
    ),
)


def follow(localizer, placed, seed=0, seconds=30):
    """Truth and estimates f8[T,1,3] of a robot that drives circles, where the filter believes that it was `placed`."""
    fleet, truths, estimates, starts = Fleet(robots=(BURGER,)), [], [], np.array([[2.3, 1.2, 0.3]])
    session = localizer.start(fleet, ROOM, composed(starts, np.array(placed)), seed)
    with Planar().open(ROOM, fleet, starts, 0, PERIOD) as simulation:
        state = simulation.state
        for step in range(round(seconds / PERIOD)):
            odometry = Odometry(pose=relative(starts, state.pose), twist=state.twist)
            estimates.append(session.update(step * PERIOD, odometry, simulation.scans(), None))
            truths.append(state.pose)
            state = simulation.step(Inputs(twist=np.array([[0.15, 0.25]])))
    return np.array(truths), np.array([estimate.pose for estimate in estimates]), estimates[-1].covariance, session


def off(truth, estimate):
    return np.hypot(*(truth - estimate)[..., :2].T), np.abs(wrapped(truth[..., 2] - estimate[..., 2]))


def test_a_wrong_placement_is_found_out():
    wide = {"initial_cov_xx": 0.25, "initial_cov_yy": 0.25, "initial_cov_aa": 0.07}
    truth, estimate, covariance, session = follow(Amcl(**wide), placed=(0.5, -0.4, 0.25))
    assert np.hypot(*(truth - estimate)[0, 0, :2]) > 0.3
    distance, angle = off(truth[-200:], estimate[-200:])
    assert distance.max() < 0.15
    assert angle.max() < 0.12
    assert 0 < covariance[0, 0, 0] < 0.05
    assert len(session._filters.particles(0)) == 500  # few are enough once it knows


def kidnapped(localizer):
    """The error f8[T] of the estimate of a robot that drives circles and is moved away after 20 s."""
    fleet, found = Fleet(robots=(BURGER,)), []
    session = localizer.start(fleet, ROOM, np.array([[2.3, 1.2, 0.3]]), 0)
    odometry, now = np.zeros((1, 3)), 0.0
    for start, seconds in (((2.3, 1.2, 0.3), 20), ((4.2, 2.6, 2.0), 60)):
        with Planar().open(ROOM, fleet, np.array([start]), 0, PERIOD) as simulation:
            state = simulation.state
            for _ in range(round(seconds / PERIOD)):
                estimate = session.update(now, Odometry(pose=odometry, twist=state.twist), simulation.scans(), None)
                found.append(off(state.pose[0], estimate.pose[0])[0])
                before, state = state.pose, simulation.step(Inputs(twist=np.array([[0.15, 0.25]])))
                odometry = composed(odometry, relative(before, state.pose))
                now += PERIOD
    return np.array(found)


def test_a_kidnapped_robot_recovers_when_particles_may_be_placed_anywhere():
    options = {"laser_model_type": "likelihood_field_prob", "max_particles": 5000}
    stays_lost = kidnapped(Amcl(**options))
    recovers = kidnapped(Amcl(**options, recovery_alpha_slow=0.01, recovery_alpha_fast=0.5))
    for distance in (stays_lost, recovers):
        assert distance[300:400].max() < 0.2
        assert distance[410] > 1.0
    assert stays_lost[-100:].min() > 0.5
    assert recovers[-100:].max() < 0.2


def test_random_draws_depend_on_seed_and_robot_alone():
    def drawn(seed, robots):
        fleet, starts = Fleet(robots=(BURGER,) * robots), np.tile((2.3, 1.2, 0.3), (robots, 1))
        return Amcl().start(fleet, ROOM, starts, seed)._filters.particles(0)

    assert np.array_equal(drawn(0, 1), drawn(0, 3))
    assert not np.isclose(drawn(0, 1), drawn(1, 1))[:, :3].any()


def test_a_robot_without_a_lidar_follows_its_odometry():
    blind = Fleet(robots=(attrs.evolve(BURGER, lidar=None),))
    start = np.array([[2.0, 2.0, 0.3]])
    session = Amcl().start(blind, ROOM, start, 0)
    for step in range(3):
        moved = Odometry(pose=np.array([[0.1 * step, 0.0, 0.0]]), twist=np.zeros((1, 2)))
        estimate = session.update(step * PERIOD, moved, (), None)
    assert np.allclose(estimate.pose, composed(start, np.array([[0.2, 0.0, 0.0]])))


def test_a_world_of_several_levels_is_refused():
    house = attrs.evolve(ROOM, name="house", levels=(*ROOM.levels, Level(name="L2", elevation=3.0)))
    with pytest.raises(InputError, match="one level, and house has 2"):
        Amcl().start(Fleet(robots=(BURGER,)), house, np.zeros((1, 3)), 0)
