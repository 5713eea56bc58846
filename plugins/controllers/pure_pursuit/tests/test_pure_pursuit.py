import math

import attrs
import numpy as np
import pytest
from mrpbench_controllers_pure_pursuit import PurePursuit

from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.execution.observation import Observation
from mrpbench_core.model.worlds.world import World

BURGER = load_robot("turtlebot3_burger")
WORLD = World(name="w", levels=())
PERIOD = 0.05


def command(path, pose=(0, 0, 0), twist=(0.22, 0), **options):
    seen = {key: options.pop(key) for key in ("yaw", "speed") if key in options}
    session = PurePursuit(**options).start(BURGER, WORLD, PERIOD)
    return session.command(
        Observation(now=0, pose=np.array(pose, float), twist=np.array(twist, float), path=np.array(path, float), **seen)
    )


def test_a_robot_on_its_path_drives_straight_at_its_highest_speed():
    assert command([(0, 0), (5, 0)]) == pytest.approx((0.22, 0))


def test_speed_is_limited_by_option_robot_and_path():
    assert command([(0, 0), (5, 0)], twist=(0.1, 0), desired_linear_vel=0.1)[0] == pytest.approx(0.1)
    assert command([(0, 0), (5, 0)], desired_linear_vel=9.0)[0] == pytest.approx(0.22)
    assert command([(0, 0), (5, 0)], twist=(0.15, 0), speed=0.15)[0] == pytest.approx(0.15)


def test_commands_change_no_faster_than_the_robot_can():
    assert command([(0, 0), (5, 0)], twist=(0, 0))[0] == pytest.approx(2.5 * PERIOD)
    slow = attrs.evolve(BURGER, turn_acceleration=0.1)
    session = PurePursuit().start(slow, WORLD, PERIOD)
    seen = Observation(now=0, pose=np.array([0, 0.1, 0]), twist=np.array([0.2, 0.0]), path=np.array([[0, 0], [5.0, 0]]))
    assert abs(session.command(seen)[1]) == pytest.approx(0.1 * PERIOD)


def test_the_arc_leads_through_the_point_that_is_chased():
    speed, turn = command([(0, 0.05), (5, 0.05)], twist=(0.22, 0.35), lookahead_dist=0.25)
    curvature = 2 * 0.05 / 0.25**2
    assert turn / speed == pytest.approx(curvature, rel=1e-6)


def test_a_robot_next_to_its_path_steers_back_to_it():
    assert command([(0, 0), (5, 0)], pose=(0, 0.05, 0))[1] < 0
    assert command([(0, 0), (5, 0)], pose=(0, -0.05, 0))[1] > 0


def test_a_path_that_leads_elsewhere_is_turned_to_on_the_spot():
    speed, turn = command([(0, 0), (0, 5)], twist=(0, 0))
    assert speed == 0
    assert turn == pytest.approx(1.8)
    assert command([(0, 0), (0, -5)], twist=(0, 0))[1] == pytest.approx(-1.8)
    assert command([(0, 0), (0, 5)], twist=(0, 0), use_rotate_to_heading=False)[0] > 0


def test_turning_goes_on_until_the_heading_is_nearly_right():
    session = PurePursuit().start(BURGER, WORLD, PERIOD)

    def at(yaw):
        path, twist = np.array([[0, 0], [5.0, 0]]), np.zeros(2)
        return session.command(Observation(now=0, pose=np.array([0, 0, yaw]), twist=twist, path=path))

    assert at(-0.5)[0] > 0
    assert at(-1.0)[0] == 0
    assert at(-0.5)[0] == 0
    assert at(-0.05)[0] > 0


def test_tight_turns_are_taken_slowly():
    fast = command([(0, 0.01), (5, 0.01)])[0]
    slow = command([(0, 0.12), (5, 0.12)], regulated_linear_scaling_min_radius=2.0, twist=(0.12, 0))[0]
    floor = command([(0, 0.12), (5, 0.12)], regulated_linear_scaling_min_radius=9.0, twist=(0.12, 0))[0]
    assert fast == pytest.approx(0.22)
    assert slow < 0.2
    assert floor == pytest.approx(0.1)


def test_at_the_end_the_robot_stands_or_turns_to_the_yaw_that_is_wanted():
    assert command([(1, 0), (1, 0)], pose=(1, 0.01, 0.3), twist=(0, 0)) == pytest.approx((0, 0))
    assert command([(1, 0), (1, 0)], pose=(1, 0.01, 0.3), twist=(0, 0), yaw=1.3)[1] > 0.5
    assert command([(1, 0), (1, 0)], pose=(1, 0.01, 0.3), twist=(0, 0), yaw=-2.0)[1] < -0.5


def test_a_robot_pushed_away_from_the_end_drives_back():
    assert command([(1, 0), (1, 0)], pose=(0.7, 0, 0), twist=(0, 0))[0] > 0
    assert command([(1, 0), (1, 0)], pose=(1.3, 0, math.pi), twist=(0, 0))[0] > 0
    assert command([(1, 0), (1, 0)], pose=(1.3, 0, 0), twist=(0, 0)) == pytest.approx((0, 1.8), abs=1e-6)


@pytest.mark.parametrize(
    "wrong", [{"lookahead_dist": 0}, {"desired_linear_vel": -1}, {"rotate_to_heading_angular_vel": 0}]
)
def test_options_that_make_no_sense_are_refused(wrong):
    with pytest.raises(ValueError, match="must be"):
        PurePursuit(**wrong)
