"""The metric `smoothness` on curves known in closed form."""

import math

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_metrics_standard import Smoothness


@pytest.fixture(scope="session")
def driven(executed):
    def make(time, x, y, yaw):
        run = executed(time, [np.stack([x, y], axis=1)], [[0] * len(time)], [[(0, 0), (1, 0)]])
        truth = np.stack([x, y, yaw], axis=1)[:, None]
        return attrs.evolve(run, channels={**run.channels, "truth": lambda: truth})

    return make


def minimum_jerk(time, length, duration):
    """Flash and Hogan, 1985: the way from rest to rest with least squared jerk, 720 length^2 / duration^5."""
    share = np.clip(time / duration, 0, 1)
    return length * (10 * share**3 - 15 * share**4 + 6 * share**5)


def test_a_circle_has_the_curvature_of_its_radius(driven):
    angle = np.linspace(0, 2 * np.pi, 401)
    values = Smoothness().measure(driven(angle, 2 * np.cos(angle), 2 * np.sin(angle), angle + np.pi / 2))
    for name in ("angle_over_length", "curvature_mean", "curvature_p95"):
        assert values[name] == pytest.approx(0.5, rel=1e-4)


def test_turning_on_the_spot_is_angle_but_no_curvature(driven):
    """2 m straight on with a quarter turn on the spot half way, across the seam of angles."""
    x = np.array([0, 0.5, 1, 1, 1, 1.5, 2])
    yaw = np.array([3, 3, 3, 3 + np.pi / 4, 3 + np.pi / 2, 3 + np.pi / 2, 3 + np.pi / 2])
    values = Smoothness().measure(driven(np.arange(7.0), x, 0 * x, (yaw + np.pi) % (2 * np.pi) - np.pi))
    assert values["angle_over_length"] == pytest.approx(np.pi / 4)
    assert (values["curvature_mean"], values["curvature_p95"]) == (0, 0)


def test_the_smoothest_way_has_the_jerk_of_its_closed_form(driven):
    time = np.linspace(0, 4, 2001)
    x = minimum_jerk(time, 3, 4)
    values = Smoothness(speed=1e-9).measure(driven(time, x, 0 * x, 0 * x))
    assert values["normalised_jerk"] == pytest.approx(math.sqrt(720 / 2), rel=0.01)


def test_a_halt_on_the_way_costs_jerk(driven):
    time = np.linspace(0, 10, 501)
    halting = minimum_jerk(time, 1, 4) + minimum_jerk(time - 6, 1, 4)
    straight = minimum_jerk(time, 2, 10)
    jerk = [Smoothness().measure(driven(time, x, 0 * x, 0 * x))["normalised_jerk"] for x in (halting, straight)]
    assert jerk[0] > 3 * jerk[1]


@settings(deadline=None, max_examples=30)
@given(angle=st.floats(-4, 4), shift=st.floats(-9, 9), scale=st.floats(0.5, 4), pace=st.floats(0.5, 4))
def test_neither_axes_nor_pace_matter_and_curvature_scales_with_size(driven, angle, shift, scale, pace):
    time = np.linspace(0, 6, 121)
    x, y = minimum_jerk(time, 3, 5), np.sin(time) / 2
    yaw = np.arctan2(np.gradient(y), np.gradient(x) + 1e-9)
    cosine, sine = scale * math.cos(angle), scale * math.sin(angle)
    turned = driven(time * pace, cosine * x - sine * y + shift, sine * x + cosine * y - shift, yaw + angle)
    plain = Smoothness(speed=1e-6).measure(driven(time, x, y, yaw))
    other = Smoothness(speed=1e-6).measure(turned)
    assert other["normalised_jerk"] == pytest.approx(plain["normalised_jerk"], rel=1e-5)
    for name in ("angle_over_length", "curvature_mean", "curvature_p95"):
        assert other[name] * scale == pytest.approx(plain[name], rel=1e-6)


def test_a_short_last_step_does_not_make_noise(driven):
    time = np.append(np.linspace(0, 4, 41), 4.0001)
    x = np.append(minimum_jerk(time[:-1], 3, 4), 3.00001)
    rough = Smoothness().measure(driven(time, x, 0 * x, 0 * x))
    assert rough == Smoothness().measure(driven(time[:-1], x[:-1], 0 * x[:-1], 0 * x[:-1]))


def test_robots_that_hardly_drive_are_left_out(driven):
    still = driven(np.arange(5.0), np.full(5, 1.0), np.zeros(5), np.arange(5.0))
    assert set(Smoothness().measure(still).values()) == {None}
