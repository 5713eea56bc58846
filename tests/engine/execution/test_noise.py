"""Errors of sensors, motors and starts: none by default, repeatable, and of the size asked for."""

import attrs
import numpy as np
import pytest

from mrpbench_core.config.settings import Noise
from mrpbench_core.engine.execution.noise import Disturbances
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.execution.state import State

START = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, np.pi / 2]])
PERIOD = 0.05
BURGER = load_robot("turtlebot3_burger")


def disturbances(seed=0, repeat=0, robots=2, **size):
    start = np.resize(START, (robots, 3))
    return Disturbances(Noise(**size), Fleet(robots=(BURGER,) * robots), start, PERIOD, Seeds(seed, repeat))


def straight(noise, steps=200, step=0.01, robots=2):
    """Robots drive straight ahead, from the two starts in turn."""
    pose, move = np.resize(START, (robots, 3)), np.resize([[step, 0.0, 0.0], [0.0, step, 0.0]], (robots, 3))
    for _ in range(steps):
        pose = pose + move
        state = State(pose=pose, twist=[[step / PERIOD, 0.0]] * robots, level=[0] * robots, contacts=[])
        odometry = noise.odometry(state)
    return pose, odometry


def test_by_default_everything_is_exact():
    noise = disturbances()
    assert set(attrs.asdict(Noise()).values()) == {0.0}
    pose, odometry = straight(noise)
    np.testing.assert_array_equal(odometry.pose, pose)
    batch = ScanBatch(stamp=0.0, robot=[0], ranges=[[1.0, np.inf]])
    assert noise.scans([batch]) == (batch,)
    assert noise.actuated(START[:, :2]) is not None
    np.testing.assert_array_equal(noise.actuated(START[:, :2]), START[:, :2])
    assert (noise.start_delay == 0).all()


@pytest.mark.parametrize("step", [0.01, 0.002])
def test_odometry_drifts_with_the_root_of_the_distance_at_any_period(step):
    """Two independent wheels of error k per root metre: distance errs by k sqrt(d/2), heading by k sqrt(2 d) / axle."""
    steps, k = round(1 / step), 0.003
    ends = straight(disturbances(robots=160, odometry=k), steps, step, robots=160)[1].pose
    ahead = np.concatenate([ends[::2, 0], ends[1::2, 1] - 1])
    heading = np.concatenate([ends[::2, 2], ends[1::2, 2] - np.pi / 2])
    assert ahead.mean() == pytest.approx(1.0, abs=0.002)
    assert ahead.std() == pytest.approx(k * np.sqrt(1 / 2), rel=0.2)
    assert heading.std() == pytest.approx(k * np.sqrt(2) / BURGER.wheel_separation, rel=0.2)


def test_a_wrong_scale_errs_in_proportion_to_the_way():
    one, two = (straight(disturbances(5, odometry_bias=0.01), steps)[1].pose[0] - START[0] for steps in (100, 200))
    assert two[2] == pytest.approx(2 * one[2], rel=1e-9)
    ends = straight(disturbances(robots=240, odometry_bias=0.01), 100, robots=240)[1].pose[::2, 2]
    assert ends.std() == pytest.approx(0.01 * np.sqrt(2) / BURGER.wheel_separation, rel=0.25)


def test_measured_speeds_are_the_measured_way():
    noise = disturbances(odometry=0.003)
    pose, before = START.copy(), START[0, 0]
    for _ in range(50):
        pose = pose + [[0.01, 0.0, 0.0], [0.0, 0.01, 0.0]]
        odometry = noise.odometry(State(pose=pose, twist=[[0.2, 0.0]] * 2, level=[0, 0], contacts=[]))
        moved = odometry.pose[0, 0] - before
        assert odometry.twist[0, 0] * PERIOD == pytest.approx(moved, rel=1e-2)
        before = odometry.pose[0, 0]


def test_lidar_noise_keeps_missing_returns_and_has_the_deviation_asked_for():
    noise = disturbances(lidar=0.02)
    (batch,) = noise.scans([ScanBatch(stamp=0.0, robot=[0, 1], ranges=[[2.0] * 500 + [np.inf]] * 2)])
    assert np.isinf(batch.ranges[:, -1]).all()
    assert 0.017 < batch.ranges[:, :-1].std() < 0.023
    assert not np.array_equal(batch.ranges[0], batch.ranges[1])


def test_dropouts_lose_their_share_of_returns_and_change_no_other():
    batch = ScanBatch(stamp=0.0, robot=[0, 1], ranges=[[2.0] * 2000] * 2)
    (exact,) = disturbances(lidar=0.02).scans([batch])
    (holed,) = disturbances(lidar=0.02, lidar_dropout=0.1).scans([batch])
    lost = np.isinf(holed.ranges)
    assert 0.08 < lost.mean() < 0.12
    np.testing.assert_array_equal(holed.ranges[~lost], exact.ranges[~lost])


def test_motors_err_by_the_share_asked_for():
    noise = disturbances(actuation=0.1)
    given = np.array([[0.2, 1.0], [0.1, 0.0]])
    made = np.array([noise.actuated(given) for _ in range(600)])
    assert not made[:, 1, 1].any()
    assert (made[:, :, 0] / given[:, 0]).std() == pytest.approx(0.1, rel=0.1)
    assert (made[:, 0, 1]).std() == pytest.approx(0.1, rel=0.1)


def test_starts_are_late_by_up_to_the_jitter():
    delay = disturbances(robots=200, start_jitter=1.5).start_delay
    assert delay.min() < 0.1
    assert 1.4 < delay.max() <= 1.5


EVERYTHING = {
    "lidar": 0.01,
    "lidar_dropout": 0.1,
    "odometry": 0.01,
    "odometry_bias": 0.01,
    "actuation": 0.1,
    "start_jitter": 2.0,
}


def trace(seed, repeat, robots, size):
    """All that robot 0 meets."""
    noise = disturbances(seed, repeat, robots, **size)
    found = [noise.start_delay[:1]]
    pose = np.resize(START, (robots, 3))
    for period in range(70):
        pose = pose + (0.01, 0.0, 0.02)
        odometry = noise.odometry(
            State(pose=pose, twist=np.full((robots, 2), 0.2), level=np.zeros(robots, "i2"), contacts=[])
        )
        found += [odometry.pose[0], odometry.twist[0], noise.actuated(np.ones((robots, 2)))[0]]
        if period % 4 == 0:
            batch = ScanBatch(stamp=0.0, robot=np.arange(robots), ranges=np.ones((robots, 9)))
            found.append(noise.scans([batch])[0].ranges[0])
    return found


def test_noise_follows_seed_repeat_and_robot_and_nothing_else():
    one, same, crowd, again, other = (
        np.concatenate(trace(seed, repeat, robots, EVERYTHING))
        for seed, repeat, robots in ((3, 0, 2), (3, 0, 2), (3, 0, 5), (3, 1, 2), (4, 0, 2))
    )
    np.testing.assert_array_equal(one, same)
    np.testing.assert_array_equal(one, crowd)
    assert not np.array_equal(one, again)
    assert not np.array_equal(one, other)


@pytest.mark.parametrize("name", sorted(EVERYTHING))
def test_sources_of_noise_do_not_change_one_another(name):
    everything = trace(3, 0, 2, EVERYTHING)
    without = trace(3, 0, 2, {**EVERYTHING, name: 0.0})
    unchanged = {
        "start_jitter": range(1, len(everything)),
        "actuation": [0, 1, 2],
        "odometry": [0, 3],
        "odometry_bias": [0, 3],
        "lidar": [0, 1, 2, 3],
        "lidar_dropout": [0, 1, 2, 3],
    }[name]
    for index in unchanged:
        np.testing.assert_array_equal(everything[index], without[index])
