import math
from types import SimpleNamespace

import attrs
import numpy as np
import pytest
from mrpbench_navigators_waypoints import Waypoints
from mrpbench_navigators_waypoints.recovery_manager import RecoveryManager, RecoveryOptions
from mrpbench_navigators_waypoints.route_follower import RouteFollower

from mrpbench_core.api import Recovery
from mrpbench_core.api.recovery import RecoverySession
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.execution.route import Route

LIDAR = load_robot("turtlebot3_burger")
BLIND = attrs.evolve(LIDAR, lidar=None)
CONTROLLERS = SimpleNamespace(is_free=lambda robot, poses: np.ones(len(poses), bool))
LINE = [(0.0, 0.0), (0.4, 0.0), (0.8, 0.0), (1.2, 0.0)]


class _Noted(Recovery):
    """Keeps the surroundings that it is given."""

    def __init__(self):
        self.surroundings = None

    def start(self, robot, surroundings, period):
        self.surroundings = surroundings
        return SESSION


class _Session(RecoverySession):
    def step(self, now, pose, twist):
        return True


SESSION = _Session()


def line(points):
    waypoint = np.column_stack([np.array(points), np.full(len(points), math.nan)])
    return Route(waypoint=waypoint, level=np.zeros(len(points)), speed=np.full(len(points) - 1, math.inf))


def around(robot, driven_to, points=LINE, cut=0):
    """The surroundings of a robot that has driven so far along a line, after so many segments of it are cut."""
    follower = RouteFollower([line(points)], Waypoints().arrival_rules, np.array([0.25]))
    for x in np.arange(0, driven_to + 1e-9, 0.02):
        follower.update(np.array([[x, 0.0, 0.0]]), np.zeros((1, 2)), np.array([3], "i4"), np.zeros(1, "i2"))
    if cut:
        follower.adopt([line(points[cut:])], np.array([cut], np.int32))
    pose = np.array([[driven_to, 0.0, 0.0]])
    follower.survey(0.0, pose, np.zeros((1, 2)))
    recovery = _Noted()
    options = RecoveryOptions(recoveries=[recovery], max_recoveries=1, period=0.05)
    manager = RecoveryManager([robot], options, CONTROLLERS, follower)
    assert manager.begin(0, 0.0, pose, [])
    return recovery.surroundings


def free_at(robot, driven_to, points, cut=0):
    """At which `points` x a robot may be that has driven along the line."""
    poses = np.column_stack([points, np.zeros((len(points), 2))])
    return around(robot, driven_to, cut=cut).is_free(poses).tolist()


def test_a_robot_without_a_lidar_backs_up_only_along_the_way_that_it_still_holds():
    assert free_at(BLIND, 0.2, [0.1, 0.0, -0.05]) == [True, True, False]
    assert free_at(BLIND, 0.5, [0.45, 0.4, 0.35]) == [True, True, False]  # another robot may have taken the start
    assert free_at(BLIND, 0.7, [0.65, 0.75]) == [False, True]


@pytest.mark.parametrize("robot", [BLIND, LIDAR])
def test_a_robot_may_stay_where_it_is(robot):
    assert free_at(robot, 0.4, [0.4]) == [True]


def test_a_robot_without_a_lidar_keeps_to_what_is_left_of_its_way_after_a_new_plan():
    assert free_at(BLIND, 0.4, [0.4, 0.35], cut=1) == [True, False]
    assert free_at(LIDAR, 0.4, [0.4, 0.35], cut=1) == [True, True]  # which sees what is behind it


@pytest.mark.parametrize("robot", [BLIND, LIDAR])
@pytest.mark.parametrize(("driven_to", "heading"), [(0.2, 0.0), (0.4, math.pi / 2), (0.36, math.atan2(0.26, 0.04))])
def test_a_recovery_knows_how_the_path_leads_on(robot, driven_to, heading):
    bend = [(0.0, 0.0), (0.4, 0.0), (0.4, 0.4), (0.4, 0.8)]
    assert around(robot, driven_to, bend).heading() == pytest.approx(heading, abs=0.01)


def test_a_robot_at_the_end_of_its_path_has_no_heading_to_turn_to():
    assert math.isnan(around(LIDAR, 1.15).heading())
