"""Scales and charts."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.report.html.charts import Curve, intervals, steps
from mrpbench_core.report.html.scales import Scale, spread, tick_text
from mrpbench_core.report.statistics.estimate import IntervalEstimate


@given(st.floats(-1e6, 1e6), st.floats(1e-3, 1e6))
def test_ticks_are_round_few_and_on_the_axis(low, width):
    ticks = Scale(low, low + width, 0, 100).ticks()
    assert 2 <= len(ticks) <= 8
    assert all(low - 1e-6 * width <= tick <= low + width + 1e-6 * width for tick in ticks)


@given(st.floats(1e-6, 1e5), st.floats(1.5, 1e6))
def test_ticks_of_a_logarithmic_axis_are_powers_of_ten(low, factor):
    scale = Scale(*spread([low, low * factor], log=True), 0, 100, log=True)
    ticks = scale.ticks()
    assert 2 <= len(ticks) <= 8
    assert all(np.log10(tick) == pytest.approx(round(np.log10(tick))) for tick in ticks)
    assert 0 <= scale.at(low) <= scale.at(low * factor) <= 100


@given(st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=5))
def test_values_are_within_their_axis(values):
    low, high = spread(values)
    assert low <= min(values)
    assert max(values) <= high
    assert low < high


def test_a_mark_stands_where_its_value_is():
    chart = intervals([("a", 0, IntervalEstimate(0.5, 0.25, 0.75, 8)), ("b", 1, None)], "success", percent=True)
    x = float(re.search(r'cx="([\d.]+)"', chart)[1])
    left, right = map(float, re.search(r'<line x1="([\d.]+)" x2="([\d.]+)" y1="[\d.]+" y2="[\d.]+"/>', chart).groups())
    assert x == pytest.approx((left + right) / 2, abs=0.1)
    assert "a: 50 % [25, 75] n=8" in chart
    assert "no value" in chart


def test_without_values_there_is_no_chart():
    assert intervals([("a", 0, None)], "success", percent=True) == ""
    empty = np.empty(0)
    assert steps([Curve("a", 0, empty, empty)], "x", "y", log_x=True, start=0.0, top=1.0) == ""


def test_long_curves_are_thinned_and_keep_their_end():
    x = np.arange(1.0, 5001.0)
    chart = steps([Curve("a", 0, x, x)], "x", "y", log_x=False, start=0.0, top=None)
    assert chart.count("V") < 500
    assert "up to 5000" in chart


@pytest.mark.parametrize(("value", "words"), [(0, "0"), (0.25, "0.25"), (1e-4, "1e-4"), (1e6, "1e6"), (20.0, "20")])
def test_ticks_are_written_shortly(value, words):
    assert tick_text(value) == words
