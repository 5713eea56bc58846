"""The saturation rate of queues whose capacity is known."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_analysis.saturation import TOLERANCE, Verdict, growth, next_rate, saturation

SERVICE_S = 30.0
"""A robot that shuttles between two places: it does two tasks a minute."""


def shuttle(rate, seed, duration=36000.0):
    """The share of tasks that pile up if they arrive at random, `rate` a minute, and are done in order."""
    rng = np.random.default_rng(seed)
    release = np.cumsum(rng.exponential(60 / rate, int(2 * rate * duration / 60)))
    release = release[release < duration]
    done, free = [], 0.0
    for at in release:
        free = max(at, free) + SERVICE_S
        done.append(free)
    grid = np.linspace(0, duration, 1001)
    waiting = np.searchsorted(release, grid) - np.searchsorted(done, grid)
    return float(np.polyfit(grid, waiting, 1)[0] * duration / len(release))


def search(judge, first, resolution):
    verdicts = {}
    while (rate := next_rate(verdicts, first, resolution)) is not None:
        assert rate not in verdicts
        verdicts[rate] = judge(rate)
    return verdicts


@pytest.mark.parametrize("first", [0.3, 2, 9])
def test_a_shuttle_saturates_at_one_over_its_time_per_task(first):
    verdicts = search(lambda rate: growth([shuttle(rate, seed) for seed in range(5)]).verdict, first, 0.02)
    low, high = saturation(verdicts)
    truth = 60 / SERVICE_S / (1 - TOLERANCE)
    assert low < truth < high
    assert high / low < 1.15


@given(st.floats(0.1, 10), st.floats(1.0, 1.5), st.floats(0.01, 0.5))
def test_the_search_closes_in_on_what_is_not_shown(capacity, gap, resolution):
    def judge(rate):
        if rate < capacity:
            return Verdict.BOUNDED
        return Verdict.GROWS if rate > capacity * gap else Verdict.NOT_SHOWN

    verdicts = search(judge, 1.0, resolution)
    low, high = saturation(verdicts)
    assert low < capacity
    assert high > capacity * gap
    steps = [(near, far) for near, far in pairwise(sorted(verdicts)) if low <= near and far <= high]
    assert all(far <= near * (1 + resolution) for near, far in (steps[0], steps[-1]))


@pytest.mark.parametrize(("found", "ends"), [(Verdict.GROWS, (None, 1 / 64)), (Verdict.BOUNDED, (64, None))])
def test_a_search_without_an_end_stops(found, ends):
    assert saturation(search(lambda rate: found, 1.0, 0.1)) == ends


def test_rates_are_judged_by_limits_of_the_mean():
    assert growth([0.01, 0.02]).verdict is Verdict.BOUNDED
    assert growth([0.3, 0.31]).verdict is Verdict.GROWS
    spread = growth([0.0, 0.2])
    assert spread.verdict is Verdict.NOT_SHOWN
    assert spread.high - spread.mean == pytest.approx(6.3138 * math.sqrt(0.02) / math.sqrt(2), rel=1e-4)
