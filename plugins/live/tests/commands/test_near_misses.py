"""Near misses, against distances of bodies that are found point by point."""

import numpy as np
import pytest
from mrpbench_live.commands.near_misses import NEAR_M, near_misses

from mrpbench_core.api import RobotModel

BOX = RobotModel(
    name="box", footprint=[(0.4, 0.2), (-0.4, 0.2), (-0.4, -0.2), (0.4, -0.2)], max_speed=1.0, max_turn_rate=1.0
)
KITE = RobotModel(name="kite", footprint=[(0.3, 0.0), (0.0, 0.3), (-0.3, 0.0)], max_speed=1.0, max_turn_rate=1.0)
NONE = np.zeros(0), np.zeros((0, 2), np.int32)


def passing(x, y, yaw=0.0):
    """A robot that stands at (0, 0), and one that passes it on a line beside it, a sample each tenth of a second."""
    time = np.arange(len(x)) / 10
    pose = np.zeros((len(x), 2, 3))
    pose[:, 1, 0], pose[:, 1, 1], pose[:, 1, 2] = x, y, yaw
    return time, pose, np.zeros((len(x), 2), np.int16)


X = np.linspace(-3, 3, 61)


def test_bodies_count_and_not_discs():
    assert near_misses(*passing(X, 0.49), (BOX, BOX), *NONE).tolist() == pytest.approx([2.2])  # where x = -0.8
    assert near_misses(*passing(X, 0.51), (BOX, BOX), *NONE).tolist() == []
    assert near_misses(*passing(X, 0.55, np.pi / 4), (BOX, BOX), *NONE).size == 1  # its corner comes near


def test_other_levels_parked_robots_and_contacts_are_no_near_misses():
    time, pose, level = passing(X, 0.49)
    level[:, 1] = 1
    assert near_misses(time, pose, level, (BOX, BOX), *NONE).size == 0
    assert near_misses(*passing(np.zeros(30), 0.49), (BOX, BOX), *NONE).size == 0
    for at, count in ((3.0, 0), (5.9, 1)):
        contact = np.array([at]), np.array([[1, 0]], np.int32)
        assert near_misses(*passing(X, 0.49), (BOX, BOX), *contact).size == count


def test_robots_that_part_and_come_back_have_two():
    back = np.concatenate([X, X[::-1]])
    assert near_misses(*passing(back, 0.49), (BOX, BOX), *NONE).size == 2
    hesitating = np.where(np.arange(61) % 5 == 4, 0.7, 0.49)  # for less than the pause
    assert near_misses(*passing(X, hesitating), (BOX, BOX), *NONE).size == 1


def outline(robot, pose):
    """Many points of the outline of a body."""
    corners = np.array(robot.footprint)
    share = np.linspace(0, 1, 60)[:, None, None]
    points = (corners + share * (np.roll(corners, -1, axis=0) - corners)).reshape(-1, 2)
    cosine, sine = np.cos(pose[2]), np.sin(pose[2])
    return points @ np.array([[cosine, sine], [-sine, cosine]]) + pose[:2]


@pytest.mark.parametrize("seed", range(10))
def test_close_is_what_points_of_the_outlines_say(seed):
    draws = np.random.default_rng(seed)
    robots = (BOX, KITE, BOX)
    pose = np.concatenate([np.full((1, 3, 3), 50.0), draws.uniform(-1.5, 1.5, (1, 3, 3))])
    pose[0, :, 0] += 10 * np.arange(3)  # far from one another at first
    level = np.zeros((2, 3), np.int16)
    expected = 0
    for one, other in ((0, 1), (0, 2), (1, 2)):
        first, second = outline(robots[one], pose[1, one]), outline(robots[other], pose[1, other])
        gap = np.hypot(*(first[:, None] - second).reshape(-1, 2).T).min()
        if abs(gap - NEAR_M) < 0.02:
            pytest.skip("too near to the limit for points")
        expected += gap < NEAR_M
    assert near_misses(np.arange(2.0), pose, level, robots, *NONE).size == expected
