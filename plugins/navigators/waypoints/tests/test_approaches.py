"""Robots that stand near the ends of their paths are driven there; the others are left to their controllers."""

import math

import numpy as np
import pytest
from mrpbench_navigators_waypoints import Waypoints
from mrpbench_navigators_waypoints.approaches import Approach

from mrpbench_core.api import Controller, ControllerSession, Surroundings
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.observation import Estimate, FleetObservation, Odometry
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.worlds.world import World

BURGER, WAFFLE = load_robot("turtlebot3_burger"), load_robot("turtlebot3_waffle")
PERIOD = 0.05
ASIDE = [(0, 0), (0.4, 0), (0.4, 0), (0, 0)]
"""The way of a robot that makes room, waits and comes back."""
BEND = [(0, 0), (0.8, 0), (0.8, 0.8)]


class _Stopping(ControllerSession):
    """Drives straight ahead, at most `speed` in m/s, and stands from `short` metres before the end of its path on."""

    def __init__(self, short, speed, free):
        self.short, self.speed, self.free = short, speed, free

    def command(self, observation):
        left = math.dist(observation.path[-1], observation.pose[:2]) - self.short
        return (min(self.speed, max(left, 0.0) / PERIOD), 0.0)

    def is_free(self, poses):
        return np.full(len(poses), self.free)


class _Controller(Controller):
    def __init__(self, short, speed=0.1, free=True):
        self.session = _Stopping(short, speed, free)

    def start(self, robot, world, period):
        return self.session


def drive(controller, points, pose, released, seconds=20, moves=True):
    """The last motion of a Burger in a fleet with a Waffle, moved as commanded or not, and all its recoveries."""
    ends = [np.column_stack([way, np.full(len(way), np.nan)]) for way in (points, [(9, 9), (9, 10)])]
    routes = [Route(waypoint=way, level=np.zeros(len(way)), speed=np.full(len(way) - 1, np.inf)) for way in ends]
    fleet = Fleet(robots=(BURGER, WAFFLE))
    session = Waypoints().start(fleet, World(name="w", levels=()), routes, controller, PERIOD, 0)
    pose, twist, recoveries = np.array([pose, [9, 9, 0]], float), np.zeros((2, 2)), []
    for step in range(round(seconds / PERIOD)):
        seen = FleetObservation(
            estimate=Estimate(pose=pose), odometry=Odometry(pose=pose, twist=twist), level=np.zeros(2), scans=()
        )
        motion = session.step(step * PERIOD, seen, Orders(released=[released, 0]))
        recoveries += [(event.stamp, event.detail) for event in motion.events if event.kind == "recovery"]
        twist = motion.twist * moves
        yaw = pose[:, 2]
        pose = pose + PERIOD * np.column_stack([twist[:, 0] * np.cos(yaw), twist[:, 0] * np.sin(yaw), twist[:, 1]])
    return motion, recoveries


def test_a_robot_that_stops_before_it_has_cleared_a_place_is_driven_on():
    motion, recoveries = drive(_Controller(short=0.05), ASIDE, [0, 0, 0], released=2)
    assert (motion.reached[0], motion.cleared[0]) == (2, 1)
    assert [name for _, name in recoveries] == ["drive_on_heading"]
    assert recoveries[0][0] < 3.5 + 3  # the way of 0.35 m, and two or three looks


def test_a_robot_that_stands_beside_a_bend_turns_to_it_and_drives_there():
    motion, recoveries = drive(_Controller(short=0.12), BEND, [0.82, -0.118, 1.2], released=2)
    assert motion.reached[0] == 1
    assert recoveries[0][1] == "drive_on_heading"


@pytest.mark.parametrize(
    ("controller", "released"),
    [
        (_Controller(short=0.05, speed=0.02), 2),  # which drives slowly
        (_Controller(short=0.3), 2),  # which stands farther away than Nav2's goal tolerance
        (_Controller(short=0.05), 0),  # which waits
        (_Controller(short=0.05), 1),  # which has reached what is released, with the usual tolerance
    ],
)
def test_other_robots_are_left_to_their_controllers(controller, released):
    ahead = [(0, 0), (0.4, 0), (0.8, 0)] if released == 1 else ASIDE
    seconds = 9.5  # before a robot without progress recovers
    assert drive(controller, ahead, [0.1, 0, 0], released, seconds)[1] == []


def test_a_robot_that_something_holds_near_the_end_of_its_path_is_left_to_its_controller():
    assert drive(_Controller(short=0.05, speed=0.2), ASIDE, [0.2, 0, 0], 2, seconds=9.5, moves=False)[1] == []


def test_a_robot_is_driven_to_the_same_end_once_and_then_recovers_in_turn():
    _, recoveries = drive(_Controller(short=0.15, free=False), ASIDE, [0, 0, 0], released=2, seconds=30)
    assert [name for _, name in recoveries][:2] == ["drive_on_heading", "clear"]


class _Room(Surroundings):
    """Free up to x = `wall`."""

    def __init__(self, wall=math.inf):
        self.wall = wall

    def clear(self):
        raise AssertionError("an approach believes what sensors have marked")

    def is_free(self, poses):
        return poses[:, 0] < self.wall

    def heading(self):
        return math.nan


def attempt(place, yaw, wall=math.inf, moves=True):
    """Poses, commands and the outcome of a robot that begins at the origin."""
    session, pose = Approach(place, BURGER, _Room(wall), PERIOD), np.array([0.0, 0.0, yaw])
    poses, commands = [pose], []
    for period in range(1000):
        answer = session.step(period * PERIOD, pose, np.zeros(2))
        if isinstance(answer, bool):
            return np.array(poses), np.array(commands).reshape(-1, 2), answer
        commands.append(answer)
        speed, turn = np.array(answer) * PERIOD * moves
        pose = pose + (speed * math.cos(pose[2]), speed * math.sin(pose[2]), turn)
        poses.append(pose)
    raise AssertionError("never ends")


@pytest.mark.parametrize("yaw", np.linspace(-3, 3, 9))
def test_an_approach_turns_to_its_place_the_shorter_way_and_drives_there(yaw):
    poses, commands, succeeded = attempt((0.12, 0.05), yaw)
    assert succeeded
    assert math.dist(poses[-1, :2], (0.12, 0.05)) <= 0.02
    assert np.ptp(poses[:, 2]) <= math.pi / 2
    assert (np.abs(commands) <= (BURGER.max_speed, 1.0)).all()


def test_an_approach_ends_before_what_is_in_its_way():
    poses, _, succeeded = attempt((0.2, 0.0), 0.0, wall=0.15)
    assert not succeeded
    assert 0.12 < poses[-1, 0] < 0.15


def test_an_approach_that_something_holds_has_failed_after_its_time():
    _, commands, succeeded = attempt((0.2, 0.0), 0.0, moves=False)
    assert not succeeded
    assert len(commands) == pytest.approx(10 / PERIOD, abs=2)
