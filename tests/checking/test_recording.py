"""A sound recording has no faults; each kind of damage is found and named."""

import numpy as np
import pytest

from mrpbench_core.checking.recording import check_recording
from mrpbench_core.model.common.fleet import Fleet, RobotModel

ROBOT = RobotModel(name="r", footprint=[[0.1, 0.1], [-0.1, 0.1], [0, -0.1]], max_speed=0.5, max_turn_rate=1)
FLEET = Fleet(robots=(ROBOT, ROBOT))


@pytest.fixture
def channels():
    """Robot 0 drives 1 m along x in 4 s and completes two segments; robot 1 stands."""
    time = np.arange(5.0)
    truth = np.zeros((5, 2, 3))
    truth[:, 0, 0] = time / 4
    truth[:, 1, 1] = 1.0
    reached = np.array([[0, 0], [0, 0], [1, 0], [1, 0], [2, 0]], "i4")
    return {
        "time": time,
        "truth": truth,
        "truth_twist": np.zeros((5, 2, 2)),
        "estimate": truth.copy(),
        "odometry": np.zeros((5, 2, 5)),
        "command": np.zeros((5, 2, 2)),
        "level": np.zeros((5, 2), "i2"),
        "released": np.array([[1, 0], [2, 0], [2, 0], [2, 0], [2, 0]], "i4"),
        "reached": reached,
        "cleared": np.array([[0, 0], [1, 0], [2, 0], [2, 0], [2, 0]], "i4"),
        "mode": np.zeros((5, 2), "u1"),
        "contact_time": np.array([1.0, 1.0]),
        "contact": np.array([[0, 1], [1, -1]], "i4"),
        "trajectory_time": np.array([1.0, 1.0, 2.0]),
        "trajectory_robot": np.array([1, 1, 0], "i4"),
        "trajectory_chosen": np.array([1, 0, 1], "u1"),
        "trajectory_cost": np.array([2.0, np.inf, np.nan]),
        "trajectory_pose": np.zeros((3, 16, 3), "f4"),
        "critic_time": np.array([1.0]),
        "critic_robot": np.array([1], "i4"),
        "critic_name": np.array(["PathDist"]),
        "critic_score": np.array([2.0]),
        "map_time": np.array([0.0, 4.0]),
        "map_robot": np.array([0, 1], "i4"),
        "map_corner": np.array([[0.0, 1.6], [-1.6, 0.0]]),
        "map_side": np.array([0.05, 0.05]),
        "map_cells": np.zeros((2, 32, 32), "i1"),
        "event_time": np.array([2.5]),
        "event_kind": np.array(["recovery"]),
        "event_robot": np.array([-1], "i4"),
        "event_detail": np.array([""]),
    }


def test_a_sound_recording_has_no_faults(channels):
    assert check_recording(channels, FLEET) == []
    assert check_recording({"time": np.array([0.0])}, FLEET) == []
    del channels["contact"], channels["contact_time"]
    assert check_recording(channels, FLEET) == []


def put(channel, where, value):
    def damage(channels):
        channels[channel][where] = value

    return damage


def drop(channel):
    return lambda channels: channels.pop(channel)


def shorten(channel):
    def damage(channels):
        channels[channel] = channels[channel][:-1]

    return damage


@pytest.mark.parametrize(
    ("damage", "fault"),
    [
        (drop("time"), "has no channel time"),
        (drop("contact"), "has no channel contact"),
        (drop("event_time"), "has no channel event_time"),
        (shorten("truth"), "truth has shape (4, 2, 3) instead of (5, 2, 3)"),
        (shorten("event_robot"), "event_robot has shape (0,) instead of (1,)"),
        (drop("trajectory_cost"), "has no channel trajectory_cost"),
        (drop("critic_name"), "has no channel critic_name"),
        (put("trajectory_robot", 1, 2), "trajectory_robot names a robot that does not exist"),
        (put("critic_robot", 0, -1), "critic_robot names a robot that does not exist"),
        (put("trajectory_chosen", 0, 2), "trajectory_chosen is neither 0 nor 1"),
        (put("trajectory_cost", 0, -np.inf), "trajectory_cost is -inf"),
        (put("trajectory_pose", (0, 3, 1), np.nan), "trajectory_pose is not finite"),
        (put("critic_score", 0, np.inf), "critic_score is not finite"),
        (lambda it: it.update(trajectory_pose=np.zeros((3, 0, 3))), "trajectory_pose has no poses"),
        (
            lambda it: it.update(trajectory_pose=np.zeros((3, 4, 2))),
            "trajectory_pose has shape (3, 4, 2) instead of (3, -2, 3)",
        ),
        (drop("map_side"), "has no channel map_side"),
        (put("map_robot", 1, 2), "map_robot names a robot that does not exist"),
        (put("map_corner", (0, 1), np.nan), "map_corner is not finite"),
        (put("map_side", 0, 0.0), "map_side is not above 0"),
        (lambda it: it.update(map_cells=np.zeros((2, 32), "i1")), "map_cells has shape (2, 32) instead of (2, -2, -2)"),
        (put("time", 3, 2.0), "time does not increase after 2 s"),
        (put("time", 4, np.nan), "time is not finite"),
        (put("contact_time", 1, 0.5), "contact_time decreases after 1 s"),
        (put("truth", (2, 1, 2), np.nan), "robot 1 has no finite truth at 2 s"),
        (put("command", (0, 0, 0), np.nan), "robot 0 has no finite command at 0 s"),
        (put("odometry", (0, 0, 0), 1e12), "odometry is not finite"),
        (put("level", (0, 0), -1), "level is negative"),
        (put("released", (4, 0), 1), "robot 0: released decreases at 4 s"),
        (put("reached", (0, 1), 1), "robot 1 reached a segment at 0 s that was not released"),
        (put("cleared", (0, 0), 2), "robot 0 cleared a segment at 0 s that it had not reached"),
        (put("contact", (0, 1), 2), "contact names a robot that does not exist, or a robot touching itself"),
        (put("contact", (0, 1), 0), "contact names a robot that does not exist, or a robot touching itself"),
        (put("event_robot", 0, 2), "event_robot names a robot that does not exist"),
        (put("truth", (2, 1, 1), 1.8), "robot 1 moves at 2 s faster than its speed limit allows"),
    ],
)
def test_damage_is_named(channels, damage, fault):
    damage(channels)
    assert fault in check_recording(channels, FLEET)


def test_a_short_push_is_not_a_jump(channels):
    channels["truth"][2:, 1, 1] += 0.7
    assert check_recording(channels, FLEET) == []


def test_a_new_plan_does_not_take_back_released_segments(channels):
    channels["released"][3:, 0] = 1
    channels["reached"][3:, 0] = 1
    channels["event_kind"] = np.array(["replan"])
    assert check_recording(channels, FLEET) == ["robot 0: released decreases at 3 s"]
