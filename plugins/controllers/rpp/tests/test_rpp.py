"""Numbers of Nav2's own tests, and formulas of the paper computed again with NumPy."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_controllers_rpp import Rpp
from mrpbench_tests.fixtures.following import NOWHERE, SPRINTER, seen

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot

PERIOD = 0.05


def ask(observations, **options):
    session = Rpp(**options).start_fleet((SPRINTER,), NOWHERE, PERIOD)
    return session.command(observations)[0], session.explain(0)


def curved(curvature, lookahead=0.6):
    """A straight path to the point at the lookahead distance that gives a curvature."""
    y = curvature * lookahead**2 / 2
    return [(0.0, 0.0), (math.sqrt(lookahead**2 - y**2), y)]


@pytest.mark.parametrize(("speed", "distance"), [(10.0, 0.9), (0.35, 0.525), (0.0, 0.3)])
def test_the_lookahead_distance_scales_with_the_speed(speed, distance):
    path = [(0.0, 0.0), (9.0, 0.0)]
    _, why = ask(seen(path, twist=(speed, 0.0)), use_velocity_scaled_lookahead_dist=True)
    assert why["carrot"] == pytest.approx([distance, 0.0])


@pytest.mark.parametrize(("point", "turns"), [((0.5, 0.25), False), ((0.5, 1.0), True)])
def test_it_turns_on_the_spot_to_a_point_far_off_the_heading(point, turns):
    (ahead, turn), _ = ask(seen([(0.0, 0.0), point]))
    assert (ahead == 0) == turns
    assert turn > 0


@pytest.mark.parametrize(
    ("angle", "rate", "expected"), [(0.4, 1.75, 1.6), (0.4, 0.0, 0.16), (0.4, 1.0, 1.16), (-0.4, 1.0, 0.84)]
)
def test_turns_on_the_spot_accelerate_and_stop_in_time(angle, rate, expected):
    (ahead, turn), _ = ask(seen([(0.0, 0.0), (0.0, 0.0)], twist=(0.0, rate), yaw=angle))
    assert ahead == 0
    assert turn == pytest.approx(expected)


@pytest.mark.parametrize(("curvature", "speed"), [(0.5, 0.5), (0.7407, 0.5), (1.5, 0.5 / 1.5 / 0.9), (2.3, 0.25)])
def test_tight_turns_are_driven_slowly(curvature, speed):
    (ahead, turn), why = ask(seen(curved(curvature)), approach_velocity_scaling_dist=1e-6)
    assert why["curvature"] == pytest.approx([curvature])
    assert ahead == pytest.approx(speed)
    assert turn == pytest.approx(speed * curvature)


def test_the_end_of_the_path_is_approached_slowly():
    assert ask(seen([(0.0, 0.0), (0.06, 0.0)]))[0][0] == pytest.approx(0.05)
    assert ask(seen([(0.0, 0.0), (0.3, 0.0)]))[0][0] == pytest.approx(0.25)
    assert ask(seen([(0.0, 0.0), (0.04, 0.0)]))[0].tolist() == [0.0, 0.0]


def test_the_point_ahead_may_lie_beyond_the_end_of_the_path():
    along = [(float(x), 0.0) for x in range(10)]
    assert ask(seen(along), lookahead_dist=3.8)[1]["carrot"] == pytest.approx([3.8, 0.0])
    beyond = {"lookahead_dist": 10.0, "interpolate_curvature_after_goal": True}
    assert ask(seen([(2.0, 0.0), (3.0, 0.0)]), **beyond)[1]["carrot"] == pytest.approx([12.0, 0.0])
    assert ask(seen([(2.0, 0.0), (3.0, 0.0)]), lookahead_dist=10.0)[1]["carrot"] == pytest.approx([3.0, 0.0])


def test_the_curvature_is_that_of_the_circle_through_the_point():
    _, why = ask(seen([(0.0, 0.0), (1.0, 0.5)]), lookahead_dist=math.hypot(1.0, 0.5))
    assert why["curvature"] == pytest.approx([0.8])


def by_cost(cost, inscribed, speed=0.5, scaling=3.0, reach=0.6, gain=1.0):
    """Speed near obstacles, by the formula of the paper."""
    distance = inscribed + math.log(253 / cost) / scaling
    return speed * gain * distance / reach if distance < reach else speed


def test_it_slows_down_near_obstacles():
    assert by_cost(100, 0.22) == pytest.approx(0.4412, abs=1e-4)
    session = Rpp(use_collision_detection=False).start_fleet((SPRINTER,), NOWHERE, PERIOD)
    speeds = set()
    for step, ranges in enumerate((0.3, 0.35, 0.4, 0.5)):
        (ahead, _) = session.command(seen([(0.0, 0.0), (9.0, 0.0)], ranges=ranges, now=float(step)))[0]
        costs, x, y, inscribed = session.costmap(0)
        cost = costs[int((0 - y) / 0.05 + 1e-9), int((0 - x) / 0.05 + 1e-9)]
        if cost:
            assert ahead == pytest.approx(max(0.25, by_cost(cost, inscribed)))
            speeds.add(ahead)
        session.clear(0)
    assert len(speeds) > 1


def test_nothing_is_commanded_that_soon_leads_to_a_collision():
    session = Rpp().start_fleet((SPRINTER,), NOWHERE, PERIOD)
    path = [(0.0, 0.0), (9.0, 0.0)]
    assert session.command(seen(path, ranges=0.55)).tolist()[0] == pytest.approx([math.nan] * 2, nan_ok=True)
    assert "collision" in session.failure_reason(0)
    assert session.command(seen(path, ranges=3.0, now=1.0))[0, 0] > 0


@settings(max_examples=30, deadline=None)
@given(st.floats(-3, 3), st.floats(-5, 5), st.floats(-5, 5), st.floats(-0.7, 0.7), st.floats(0.2, 3.0), st.booleans())
def test_commands_do_not_depend_on_where_the_path_is(yaw, x, y, bearing, length, window):
    def at(px, py):
        return (x + math.cos(yaw) * px - math.sin(yaw) * py, y + math.sin(yaw) * px + math.cos(yaw) * py)

    points = [(0.0, 0.0), (length * math.cos(bearing), length * math.sin(bearing))]
    here, _ = ask(seen(points), use_dynamic_window=window)
    there, _ = ask(seen([at(*p) for p in points], pose=(x, y, yaw)), use_dynamic_window=window)
    assert there == pytest.approx(here, abs=1e-9)


@settings(max_examples=20, deadline=None)
@given(st.lists(st.tuples(st.floats(0.06, 2.0), st.floats(-1.5, 1.5)), min_size=2, max_size=30))
def test_the_dynamic_window_never_exceeds_accelerations(points):
    session = Rpp(use_dynamic_window=True, use_rotate_to_heading=False).start_fleet((SPRINTER,), NOWHERE, PERIOD)
    last = np.zeros(2)
    for step, point in enumerate(points):
        twist = session.command(seen([(0.0, 0.0), point], now=step * PERIOD, twist=tuple(last)))[0]
        assert (np.abs(twist - last) <= np.array([2.5, 3.2]) * PERIOD + 1e-9).all()
        assert 0 <= twist[0] <= 0.5
        last = twist


def test_the_dynamic_window_keeps_the_curvature_when_it_can():
    session = Rpp(use_dynamic_window=True).start_fleet((SPRINTER,), NOWHERE, PERIOD)
    for step in range(20):
        ahead, turn = session.command(seen(curved(0.8) + [(3.0, 2.0)], now=step * PERIOD))[0]
        assert turn == pytest.approx(0.8 * ahead)
    assert ahead == pytest.approx(0.5)


def test_a_nav2_file_is_read(tmp_path):
    block = {
        "plugin": Rpp.nav2_plugin,
        "desired_linear_vel": 0.4,
        "lookahead_dist": 0.5,
        "transform_tolerance": 0.1,
        "use_interpolation": False,
    }
    values = Rpp(FollowPath=block).settings(SPRINTER, PERIOD).values
    assert (values["max_linear_vel"], values["lookahead_dist"]) == (0.4, 0.5)
    assert Rpp().settings(load_robot("turtlebot3_burger"), PERIOD).values["max_linear_vel"] == 0.22
    with pytest.raises(InputError, match="unknown parameter 'lookahead_dst'"):
        Rpp(FollowPath={"lookahead_dst": 0.5})
    with pytest.raises(InputError, match="is not nav2_regulated"):
        Rpp(FollowPath={"plugin": "dwb_core::DWBLocalPlanner"})


@pytest.mark.parametrize("name", ["min_linear_vel", "min_angular_vel"])
def test_a_dynamic_window_without_zero_is_refused(name):
    """Turning for good, the check for collisions along the arc took minutes."""
    with pytest.raises(ValueError, match=f"'{name}' must be <= 0"):
        Rpp(**{name: 0.5})


def test_options_that_exclude_each_other_are_refused():
    with pytest.raises(InputError, match="allow_reversing excludes use_rotate_to_heading"):
        Rpp(allow_reversing=True).start_fleet((SPRINTER,), NOWHERE, PERIOD)
