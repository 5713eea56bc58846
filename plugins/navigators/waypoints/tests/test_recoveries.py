import math

import numpy as np
import pytest
from mrpbench_navigators_waypoints.recoveries.back_up import BackUp
from mrpbench_navigators_waypoints.recoveries.clear import Clear
from mrpbench_navigators_waypoints.recoveries.spin import RotateToPath, Spin
from mrpbench_navigators_waypoints.recoveries.wait import Wait

from mrpbench_core.api import Surroundings
from mrpbench_core.files.robot import load_robot

BURGER = load_robot("turtlebot3_burger")
PERIOD = 0.05


class Room(Surroundings):
    """Free wherever `free` says so; the path leads on at the yaw `ahead`."""

    def __init__(self, free=lambda pose: True, ahead=-2.0):
        self.free, self.ahead, self.cleared = free, ahead, 0

    def clear(self):
        self.cleared += 1

    def is_free(self, poses):
        return np.array([self.free(pose) for pose in poses.tolist()], bool)

    def heading(self):
        return self.ahead


def attempt(recovery, room, moves=True):
    """Poses, commands and the outcome of a robot that does exactly what it is told, or nothing."""
    session, pose = recovery.start(BURGER, room, PERIOD), np.array([1.0, 2.0, 3.0])
    poses, commands = [pose], []
    for period in range(1000):
        answer = session.step(period * PERIOD, pose, np.zeros(2))
        if isinstance(answer, bool):
            return np.array(poses), commands, answer
        commands.append(answer)
        speed, turn = np.array(answer) * PERIOD * moves
        pose = pose + (speed * math.cos(pose[2]), speed * math.sin(pose[2]), turn)
        pose[2] = math.remainder(pose[2], math.tau)
        poses.append(pose)
    raise AssertionError("never ends")


def test_clearing_takes_no_time():
    room = Room()
    assert attempt(Clear(), room)[1:] == ([], True)
    assert room.cleared == 1


def test_waiting_stands_still_for_as_long_as_it_says():
    _, commands, succeeded = attempt(Wait(wait_duration=2.0), Room())
    assert succeeded
    assert set(commands) == {(0.0, 0.0)}
    assert len(commands) == 40


def test_spinning_turns_by_the_angle_within_its_speeds():
    poses, commands, succeeded = attempt(Spin(), Room())
    assert succeeded
    turned = np.diff(np.unwrap(poses[:, 2])).sum()
    assert 1.57 <= turned < 1.57 + PERIOD
    rates = [turn for _, turn in commands]
    assert min(rates) >= 0.4
    assert max(rates) == 1.0
    assert (poses[:, :2] == (1.0, 2.0)).all()


@pytest.mark.parametrize(("ahead", "turn"), [(-2.0, math.tau - 5.0), (2.5, -0.5), (3.2, 0.2)])
def test_a_robot_turns_the_shorter_way_to_its_path(ahead, turn):
    poses, commands, succeeded = attempt(RotateToPath(), Room(ahead=ahead))
    assert succeeded
    over = (np.diff(np.unwrap(poses[:, 2])).sum() - turn) * math.copysign(1, turn)
    assert 0 <= over < PERIOD
    assert all(0.4 <= abs(rate) <= 1.0 for _, rate in commands)
    assert (poses[:, :2] == (1.0, 2.0)).all()


@pytest.mark.parametrize("ahead", [3.05, 2.95, math.nan])
def test_a_robot_that_heads_along_its_path_has_nothing_to_turn_to(ahead):
    assert attempt(RotateToPath(), Room(ahead=ahead))[1:] == ([], False)


def test_backing_up_drives_straight_back():
    poses, commands, succeeded = attempt(BackUp(), Room())
    assert succeeded
    assert set(commands) == {(-0.025, 0.0)}
    gone = poses[-1, :2] - poses[0, :2]
    assert gone @ (math.cos(3.0), math.sin(3.0)) == pytest.approx(-0.15, abs=0.002)


@pytest.mark.parametrize("recovery", [RotateToPath(), Spin(), BackUp()])
def test_nothing_is_tried_where_there_is_no_room(recovery):
    assert attempt(recovery, Room(lambda pose: False))[1:] == ([], False)


def test_backing_up_ends_before_an_obstacle_behind_the_robot():
    poses, _, succeeded = attempt(BackUp(), Room(lambda pose: math.dist(pose[:2], (1, 2)) < 0.1))
    assert not succeeded
    assert math.dist(poses[-1, :2], (1, 2)) < 0.1


@pytest.mark.parametrize("recovery", [RotateToPath(), Spin(), BackUp()])
def test_an_attempt_that_something_holds_has_failed_after_its_time(recovery):
    _, commands, succeeded = attempt(recovery, Room(), moves=False)
    assert not succeeded
    assert len(commands) == pytest.approx(10 / PERIOD, abs=2)
