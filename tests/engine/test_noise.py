"""Sensor noise: nothing by default, repeatable, and of the size asked for."""

import numpy as np

from mrpbench_core.engine.noise import SensorNoise
from mrpbench_core.model.execution import ScanBatch, State

START = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, np.pi / 2]])


def drive(noise, steps=200):
    pose = START.copy()
    for _ in range(steps):
        pose = pose + [[0.01, 0.0, 0.0], [0.0, 0.01, 0.0]]
        odometry = noise.odometry(State(pose=pose, twist=[[0.2, 0.0]] * 2, level=[0, 0], contacts=[]))
    return pose, odometry


def test_without_noise_sensors_are_exact():
    noise = SensorNoise(0.0, 0.0, 0.0, START, seed=0, repeat=0)
    pose, odometry = drive(noise)
    np.testing.assert_array_equal(odometry.pose, pose)
    batch = ScanBatch(stamp=0.0, robot=[0], ranges=[[1.0, np.inf]])
    assert noise.scans([batch]) == (batch,)
    assert (noise.start_delay == 0).all()


def test_odometry_drifts_by_about_the_relative_error():
    ends = [drive(SensorNoise(0.0, 0.1, 0.0, START, seed, 0))[1].pose for seed in range(60)]
    spread = np.array(ends)[:, 0, 0].std()
    assert 0.5 < spread / (0.1 * 0.01 * np.sqrt(200)) < 1.6
    assert abs(np.mean(ends, axis=0)[0, 0] - 2.0) < 0.02


def test_noise_repeats_for_a_seed_and_differs_for_a_repeat():
    one, same, other = (drive(SensorNoise(0.0, 0.1, 0.0, START, 3, repeat))[1].pose for repeat in (0, 0, 1))
    np.testing.assert_array_equal(one, same)
    assert not np.array_equal(one, other)


def test_lidar_noise_keeps_missing_returns_and_has_the_deviation_asked_for():
    noise = SensorNoise(0.02, 0.0, 1.5, START, 0, 0)
    (batch,) = noise.scans([ScanBatch(stamp=0.0, robot=[0, 1], ranges=[[2.0] * 500 + [np.inf]] * 2)])
    assert np.isinf(batch.ranges[:, -1]).all()
    assert 0.017 < batch.ranges[:, :-1].std() < 0.023
    assert not np.array_equal(batch.ranges[0], batch.ranges[1])
    assert ((noise.start_delay >= 0) & (noise.start_delay <= 1.5)).all()
