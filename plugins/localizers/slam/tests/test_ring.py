"""A corridor that leads around a block: the loop of 60 m closes where it began."""

import numpy as np
import pytest
from mrpbench_localizers_slam import Slam


@pytest.fixture(scope="module")
def noisy(drive):
    """A drive whose odometry errs three times as much as the noise of the benchmark says."""
    return drive(seed=6, odometry=0.015, bias=0.02)


@pytest.fixture(scope="module")
def plain(drive):
    return drive(seed=1)


def test_the_error_at_the_end_of_a_loop_is_small_and_odometry_alone_drifts(localized, plain):
    off, session = localized(Slam(), plain)
    assert off[-1] < 0.1
    assert session._robots.loops(0) > 0
    drifted, _ = localized(Slam(use_scan_matching=False), plain)
    assert drifted[-1] > 1


def test_closing_the_loop_takes_away_the_drift_of_matching(localized, noisy):
    closed, session = localized(Slam(), noisy)
    open_, _ = localized(Slam(do_loop_closing=False), noisy)
    assert session._robots.loops(0) > 0
    assert closed[-1] < 0.3
    assert closed[-1] < 0.6 * open_[-1]


def test_the_same_scans_give_the_same_bits(localized, plain):
    _, one = localized(Slam(), plain[:1000])
    _, other = localized(Slam(), plain[:1000])
    assert np.array_equal(one._robots.scan_poses(0), other._robots.scan_poses(0))
    for mine, theirs in zip(one._robots.changed_tiles(0), other._robots.changed_tiles(0), strict=True):
        assert np.array_equal(mine, theirs)
