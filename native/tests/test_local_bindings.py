"""Invalid arguments of local navigation raise errors in Python."""

from types import SimpleNamespace

import numpy as np
import pytest
from mrpbench_native.local import Fleet

SQUARE = np.array([(0.1, 0.1), (-0.1, 0.1), (-0.1, -0.1), (0.1, -0.1)])


def fleet(settings=None, critics=(("PathDist", 1.0, {}),)):
    found = Fleet(walls=np.empty((0, 4)), reach=4.0, threads=1)
    settings = {"robot_radius": 0.1} | (settings or {})
    found.add(controller="dwb", settings=settings, footprint=SQUARE, critics=list(critics))
    return found


def command(found, score=None, **changed):
    seen = {
        "now": 0.0,
        "robot": np.zeros(1, np.int64),
        "pose": np.zeros((1, 3)),
        "twist": np.zeros((1, 2)),
        "foot": np.zeros((1, 2)),
        "points": np.array([[1.0, 0.0]]),
        "begin": np.zeros(1, np.int64),
        "end": np.ones(1, np.int64),
        "yaw": np.full(1, np.nan),
        "speed": np.full(1, np.inf),
        "tolerance": 0.1,
    }
    return found.command(SimpleNamespace(**(seen | changed)), score)


def test_a_robot_is_driven_along_its_path():
    assert command(fleet())[0, 0] >= 0
    assert command(fleet({"by_radius": False})).shape == (1, 2)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"robot": np.ones(1, np.int64)}, "no such robot"),
        ({"end": np.full(1, 2)}, "beyond the points"),
        ({"begin": np.full(1, -1)}, "beyond the points"),
        ({"yaw": np.zeros(2)}, "one row of everything"),
    ],
)
def test_invalid_rows_are_refused(changed, message):
    with pytest.raises(ValueError, match=message):
        command(fleet(), **changed)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"simtime": 1.0}, "there is no option 'simtime'"),
        ({"sim_time": 0.0}, "sim_time must be a number from 0.01 to 60, not 0"),
        ({"acc_lim_x": -1.0}, "acc_lim_x must be a number above 0"),
        ({"decel_lim_x": 1.0}, "deceleration limits negative"),
        ({"marking": 1.0}, "marking must be true or false"),
        ({"min_vel_x": 1.0, "max_vel_x": 0.5}, "lowest speed exceeds"),
        ({"vx_samples": 0}, "vx_samples must be a whole number from 1 to 1000"),
        ({"resolution": 0.0}, "resolution"),
        ({"width": 500.0}, "cells"),
        ({"inflation_radius": 99.0}, "inflation radius"),
    ],
)
def test_invalid_settings_are_refused(settings, message):
    with pytest.raises(ValueError, match=message):
        fleet(settings)


def test_critics_and_options_that_do_not_exist_are_refused():
    with pytest.raises(ValueError, match="there is no critic PathDits"):
        fleet(critics=[("PathDits", 1.0, {})])
    with pytest.raises(ValueError, match="PreferForward: there is no option 'penalti'"):
        fleet(critics=[("PreferForward", 1.0, {"penalti": 1.0})])
    with pytest.raises(ValueError, match="aggregation_type must be one of last, sum, product, not 'best'"):
        fleet(critics=[("PathDist", 1.0, {"aggregation_type": "best"})])


def test_controllers_that_do_not_exist_are_refused():
    with pytest.raises(ValueError, match="there is no controller dbw"):
        Fleet(walls=np.empty((0, 4)), reach=4.0, threads=1).add(controller="dbw", settings={}, footprint=SQUARE)


def test_observations_of_the_wrong_type_are_refused():
    with pytest.raises(TypeError, match="pose has the wrong type or shape"):
        command(fleet(), pose=np.zeros((1, 2)))


def test_scans_of_no_robot_are_refused():
    with pytest.raises(ValueError, match="no such robot"):
        fleet().see(0.0, np.ones(1, np.int32), np.zeros((1, 3)), np.ones((1, 8)))
    with pytest.raises(ValueError, match="a scan for each robot"):
        fleet().see(0.0, np.zeros(1, np.int32), np.zeros((2, 3)), np.ones((1, 8)))


def test_exceptions_of_scores_are_raised():
    def score(robot, twist, pose):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        command(fleet(), score=score)
