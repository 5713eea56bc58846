"""Numbers of Nav2's own tests, and the control law of the paper computed again with NumPy."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_controllers_graceful import Graceful
from mrpbench_tests.fixtures.following import NOWHERE, SPRINTER, seen

from mrpbench_core.files.errors import InputError

PLAIN = {"initial_rotation": False, "use_collision_detection": False, "max_lookahead": 9.0}
NAV2 = {"k_phi": 1.0, "k_delta": 10.0, "beta": 0.2, "lambda_": 2.0, "slowdown_radius": 0.1}
NAV2 |= {"v_linear_min": 0.0, "v_linear_max": 1.0, "v_angular_max": 1.0}


def ask(observations, **options):
    session = Graceful(**options).start_fleet((SPRINTER,), NOWHERE, 0.05)
    return session.command(observations)[0], session.explain(0)


def to(x, y, yaw):
    """A path that comes to a pose along it."""
    return [(x - 0.05 * math.cos(yaw), y - 0.05 * math.sin(yaw)), (x, y)]


def polar(pose, target):
    """Distance, and the angles phi and delta of the paper, which refer to the line of sight."""
    dx, dy = target[0] - pose[0], target[1] - pose[1]
    sight = math.atan2(-dy, dx)
    return math.hypot(dx, dy), target[2] + sight, pose[2] + sight


def law(pose, target, k_phi, k_delta, beta, exponent, slowdown, v_min, v_max, w_max, brake=2.5):
    """Speed and turn rate of the paper, with the limits of Nav2."""
    r, phi, delta = polar(pose, target)
    phi, delta = (math.remainder(angle, math.tau) for angle in (phi, delta))
    k = -(k_delta * (delta - math.atan(-k_phi * phi)) + (1 + k_phi / (1 + (k_phi * phi) ** 2)) * math.sin(delta)) / r
    v = min(v_max / (1 + beta * abs(k) ** exponent), v_max * r / slowdown, math.sqrt(2 * r * brake))
    v = min(max(v, v_min), v_max)
    w = min(max(k * v, -w_max), w_max)
    return k, (w / k if w != k * v else v), w


def test_the_oracle_has_the_angles_of_nav2s_tests():
    assert polar((1, 1, -0.2), (3, 4, 0.8)) == pytest.approx((3.6055512, -0.1827937, -1.1827937))


@pytest.mark.parametrize(
    ("target", "curvature", "speed", "turn"),
    [((0.0, 5.0, 0.0), 5.407042, 0.1460446, 0.7896695), ((4.5, -2.17, -0.785), -0.416228, 0.966512, -0.4022844)],
)
def test_the_control_law_has_the_numbers_of_nav2s_tests(target, curvature, speed, turn):
    twist, why = ask(seen(to(*target)), **PLAIN, **NAV2)
    assert why["target"] == pytest.approx(target)
    assert twist == pytest.approx([speed, turn], abs=1e-6)
    assert twist[1] / twist[0] == pytest.approx(curvature, abs=1e-5)


@settings(max_examples=60, deadline=None)
@given(
    st.tuples(st.floats(-3, 3), st.floats(-3, 3), st.floats(-3, 3)),
    st.tuples(st.floats(0.3, 3), st.floats(-3, 3), st.floats(-3, 3)),
)
def test_the_control_law_is_that_of_the_paper_wherever_the_robot_is(pose, target):
    x, y, yaw = pose
    there = (x + target[0], y + target[1], target[2])
    twist, _ = ask(seen(to(*there), pose=pose), **PLAIN)
    _, speed, turn = law(pose, there, 2.0, 1.0, 0.4, 2.0, 1.5, 0.1, 0.5, 1.0)
    if abs(abs(math.remainder(math.atan2(target[1], target[0]) - yaw, math.tau)) - math.pi) < 1e-6:
        return  # straight behind, either side is right
    assert twist == pytest.approx([speed, turn], abs=1e-6)


@settings(max_examples=30, deadline=None)
@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(0.05, 1.0))
def test_speeds_are_within_the_limits(x, y, speed):
    twist, _ = ask(seen(to(x, y, 0.5), speed=speed), **PLAIN)
    assert 0 <= twist[0] <= min(0.5, speed) + 1e-12
    assert abs(twist[1]) <= 1.0 + 1e-12


def test_a_turn_on_the_spot_is_proportional_to_the_angle():
    at_end = [(0.0, 0.0), (0.0, 0.0)]
    assert ask(seen(at_end, yaw=0.5))[0] == pytest.approx([0.0, 0.25])
    assert ask(seen(at_end, yaw=-1.5))[0] == pytest.approx([0.0, -0.75])
    assert ask(seen(at_end, yaw=0.01))[0] == pytest.approx([0.0, 0.25])


def test_it_turns_to_a_new_path_first():
    session = Graceful().start_fleet((SPRINTER,), NOWHERE, 0.05)
    path = [(0.0, 0.0), (-2.0, 2.0)]
    assert session.command(seen(path))[0, 0] == 0
    assert session.command(seen(path, pose=(0.0, 0.0, 2.0)))[0, 0] > 0
    assert session.command(seen(path))[0, 0] > 0  # not again


def test_it_aims_at_the_farthest_target_to_which_the_way_is_free():
    session = Graceful().start_fleet((SPRINTER,), NOWHERE, 0.05)
    path = [(0.0, 0.0), (5.0, 0.0)]
    session.command(seen(path, ranges=3.0))
    assert 0.9 < session.explain(0)["target"][0] <= 1.0
    session.command(seen(path, ranges=0.8, now=1.0))
    assert 0.1 < session.explain(0)["target"][0] < 0.75
    assert np.isnan(session.command(seen(path, ranges=0.24, now=2.0))).all()
    assert session.failure_reason(0)


def test_a_nav2_file_is_read():
    block = {"plugin": Graceful.nav2_plugin, "k_phi": 3.0, "lambda": 3.0, "v_linear_max": 0.4, "min_lookahead": 0.25}
    values = Graceful(FollowPath=block).settings(SPRINTER, 0.05).values
    assert (values["k_phi"], values["v_linear_max"], values["lambda_"]) == (3.0, 0.4, 3.0)
    assert Graceful(lambda_=2.5, FollowPath=block).settings(SPRINTER, 0.05).values["lambda_"] == 2.5
    humble = {"motion_target_dist": 0.6, "initial_rotation_min_angle": 0.5, "final_rotation": True}
    values = Graceful(FollowPath=humble).settings(SPRINTER, 0.05).values
    assert (values["max_lookahead"], values["initial_rotation_tolerance"]) == (0.6, 0.5)
    with pytest.raises(InputError, match="final_rotation: must be true"):
        Graceful(FollowPath={"final_rotation": False})
    with pytest.raises(InputError, match="unknown parameter 'k_phy'"):
        Graceful(FollowPath={"k_phy": 0.5})
