"""Recorded robots follow reports of vehicles within the limits of their models, and arrive where vehicles stand."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_live.fleet.tracking import Tracker

from mrpbench_core.api import RobotModel, wrapped

PERIOD = 0.1
ROBOT = RobotModel(
    name="box",
    footprint=[(0.2, 0.15), (-0.2, 0.15), (-0.2, -0.15), (0.2, -0.15)],
    max_speed=0.8,
    max_turn_rate=1.5,
    acceleration=0.6,
    turn_acceleration=2.0,
)
number, speed = st.floats(-3, 3), st.floats(-0.5, 0.8)
reports = st.lists(
    st.tuples(number, number, st.floats(-np.pi, np.pi), speed, st.integers(0, 30)), min_size=1, max_size=12
)


@settings(max_examples=60, deadline=None)
@given(reports)
def test_robots_keep_their_limits_and_arrive(reports):
    tracker = Tracker((ROBOT,), np.zeros((1, 3)), PERIOD)
    poses, steps = [tracker.pose[0]], [steps for *_, steps in reports[:-1]] + [900]
    for (x, y, yaw, speed, _), count in zip(reports, steps, strict=True):
        tracker.report(0, x, y, yaw, 0.0 if count == 900 else speed)
        for _ in range(count):
            tracker.step()
            poses.append(tracker.pose[0])
    poses = np.array(poses)
    shift, turn = np.diff(poses[:, :2], axis=0), wrapped(np.diff(poses[:, 2]))
    assert np.hypot(*shift.T).max() <= ROBOT.max_speed * PERIOD + 1e-9
    assert np.abs(turn).max() <= ROBOT.max_turn_rate * PERIOD + 1e-9
    heading = poses[:-1, 2] + turn / 2
    ahead = (shift[:, 0] * np.cos(heading) + shift[:, 1] * np.sin(heading)) / PERIOD
    assert np.abs(np.diff(ahead)).max() <= ROBOT.acceleration * PERIOD + 1e-6
    assert np.abs(np.diff(turn / PERIOD)).max() <= ROBOT.turn_acceleration * PERIOD + 1e-6
    assert abs(ahead[0]) <= ROBOT.acceleration * PERIOD / 2 + 1e-6  # it begins at rest
    assert abs(turn[0] / PERIOD) <= ROBOT.turn_acceleration * PERIOD / 2 + 1e-6
    x, y, yaw, *_ = reports[-1]
    assert np.hypot(*(poses[-1, :2] - (x, y))) < 0.05
    assert abs(wrapped(poses[-1, 2] - yaw)) < 0.05
