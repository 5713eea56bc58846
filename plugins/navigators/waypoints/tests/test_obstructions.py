"""What is in the way of a robot is named."""

import numpy as np
import pytest
from mrpbench_navigators_waypoints.obstructions import obstruction

from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import Level, World

FLEET = Fleet(robots=(load_robot("turtlebot3_burger"),) * 3)
WALLED = World(name="wall", levels=(Level(name="L1", walls=[[1.0, -9.0, 1.0, 9.0]]), Level(name="L2")))
PATH = np.array([[0.5, 0.0], [0.5, 2.0]])


def _named(others, level=(0, 0, 0), start=(0.0, 0.0, 0.0), path=PATH):
    pose = np.array([start, *others], float)
    return obstruction(FLEET, WALLED, 0, pose, np.array(level, np.int16), path)


@pytest.mark.parametrize(
    ("others", "named"),
    [
        ([(0.5, 0.1, 0.0), (-1.0, 0.0, 0.0)], "robot_1 in the way"),
        ([(0.5, 0.3, 0.0), (0.3, 0.2, 0.0)], "robot_2 in the way"),
        ([(-0.3, 0.0, 0.0), (0.3, 0.3, 0.0)], ""),
        ([(0.5, 1.0, 0.0), (-1.0, 0.0, 0.0)], ""),
    ],
)
def test_robots_on_the_path_ahead_are_named(others, named):
    assert _named(others) == named


def test_robots_on_other_levels_are_not_in_the_way():
    assert _named([(0.3, 0.0, 0.0), (0.5, 0.0, 0.0)], level=(0, 1, 1)) == ""


@pytest.mark.parametrize(("level", "named"), [(0, "wall or obstacle in the way"), (1, "")])
def test_walls_of_the_level_are_named(level, named):
    far = [(-5.0, 0.0, 0.0), (-5.0, 1.0, 0.0)]
    assert _named(far, level=(level,) * 3, start=(0.7, 0.0, 0.0), path=np.array([[2.0, 0.0]])) == named


def test_what_is_beyond_the_end_of_the_path_is_not_in_the_way():
    assert _named([(0.5, 0.0, 0.0), (-5.0, 0.0, 0.0)], path=np.array([[0.1, 0.0]])) == ""
