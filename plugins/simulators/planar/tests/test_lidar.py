"""Lidar ranges agree with those of the kinematic simulator, which tests every beam against everything near."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_native.sim import Caster
from mrpbench_simulators_planar import Planar
from mrpbench_tests.fixtures.drive import BURGER, EMPTY, FURNISHED, RASTER, STARTS, WAFFLE, drive

from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.builtin.simulators.lidar import scan
from mrpbench_core.model.common.fleet import Lidar
from mrpbench_core.model.worlds.solids import segments, wall_boxes


def both(world, robots, starts, periods=8, **options):
    """Ranges of all scans by both simulators, which must agree on which robot scans when."""
    command = np.zeros((len(starts), 2))
    (_, ours), (_, theirs) = (
        drive(kind, world, robots, starts, command, periods, **options) for kind in (Planar(), Kinematic())
    )
    assert [(a.stamp, a.robot.tolist()) for a in ours] == [(b.stamp, b.robot.tolist()) for b in theirs]
    return tuple(np.concatenate([batch.ranges.ravel() for batch in scans]) for scans in (ours, theirs))


@pytest.mark.parametrize("world", [FURNISHED, RASTER], ids=["walls", "raster"])
def test_ranges_are_those_of_the_kinematic_simulator(world):
    starts = STARTS
    if world is RASTER:  # in the middle of free cells
        free = world.levels[0].occupancy.centres(np.argwhere(~world.levels[0].occupancy.blocked))
        starts = [[x, y, x + y] for x, y in free[::6]]
    robots = (BURGER, attrs.evolve(WAFFLE, lidar=Lidar(beams=1000, range=8.0, rate=10))) * (len(starts) // 2)
    ours, theirs = both(world, robots, starts[: len(robots)])
    assert np.array_equal(np.isinf(ours), np.isinf(theirs))
    seen = np.isfinite(theirs)
    assert np.abs(ours[seen] - theirs[seen]).max() < 1e-9
    assert 0.3 < seen.mean() < 1


def test_movers_are_seen_once_they_are_somewhere():
    place = np.array([[1.0, 0.2, 0, 0], [-1.5, 1.0, 0, 0]])
    ours, theirs = both(EMPTY, (BURGER,), [[0, 0, 0.2]], movers=(0.3, 0.25), place=place)
    assert np.allclose(ours, theirs, rtol=0, atol=1e-9)
    assert np.isinf(ours[:360]).all()
    assert np.isfinite(ours[360:]).any()


def test_robots_see_each_other_as_discs():
    _, scans = drive(Planar(), EMPTY, (BURGER,) * 2, [[0, 0, 0], [1, 0, 2]], np.zeros((2, 2)), 0)
    assert scans[0].ranges[0, 0] == pytest.approx(1 + 0.032 - BURGER.radius)
    assert np.isinf(scans[0].ranges[0, 90])


coordinate = st.floats(-4, 4).map(lambda value: round(value, 3))
"""Millimetres make parallel, touching and coinciding things likely."""


@settings(deadline=None, max_examples=150)
@given(
    st.lists(st.tuples(coordinate, coordinate, coordinate, coordinate), max_size=12),
    st.lists(st.tuples(coordinate, coordinate, st.floats(0.05, 0.5)), max_size=5),
    st.tuples(coordinate, coordinate, st.floats(-7, 7)),
    st.sampled_from([1, 2, 5, 24, 360, 2000]),
    st.tuples(st.floats(-0.2, 0.2), st.floats(-0.2, 0.2)),
    st.sampled_from([1.0, 3.5, 20.0]),
)
def test_neighbouring_beams_have_almost_equal_ranges(lines, discs, pose, beams, mount, reach):
    """A beam that grazes an end or an edge may have the range of its neighbour: rounding decides what it meets."""
    outline = wall_boxes(np.array(lines).reshape(-1, 4), 0.1)
    discs, pose = np.array(discs, float).reshape(-1, 3), np.array(pose)
    lidar = Lidar(beams=beams, range=reach, min_range=0.1, mount=(*mount, 0.2))
    caster = Caster(segments=outline, lidar=lidar)
    radius = np.concatenate([[0.1], discs[:, 2]])
    found = caster.scan(np.zeros(1, np.int32), pose[None], np.ascontiguousarray(discs[:, :2]), radius)[0]
    # The sensor stays where it is while the beams turn by a hair.
    base = pose[:2] + rotated(mount, pose[2])
    near = []
    for hair in (-1e-8, 0.0, 1e-8):
        yaw = pose[2] + hair
        there = np.array([*(base - rotated(mount, yaw)), yaw])
        near.append(scan(lidar, there, outline, discs[:, :2], discs[:, 2]))
    low, high = np.min(near, axis=0), np.max(near, axis=0)
    slack = 1e-9 + np.where(np.isfinite(high), high, 0.0) * 1e-9
    assert ((found >= low - slack) & (found <= high + slack)).all()
    both_hit = np.isfinite(found) & np.isfinite(high)
    off, same_thing = np.abs(found[both_hit] - near[1][both_hit]), high[both_hit] - low[both_hit] < 1e-6
    assert off[same_thing].max(initial=0.0) < 1e-9


def rotated(mount, yaw):
    cosine, sine = np.cos(yaw), np.sin(yaw)
    return np.array([cosine * mount[0] - sine * mount[1], sine * mount[0] + cosine * mount[1]])


def test_a_scan_does_not_depend_on_which_others_are_taken_with_it():
    caster = Caster(segments=segments(FURNISHED), lidar=BURGER.lidar)
    pose, radius, movers = np.array(STARTS, float), np.full(6, BURGER.radius), np.empty((0, 2))
    together = caster.scan(np.arange(6, dtype=np.int32), pose, movers, radius)
    parts = [caster.scan(np.array(part, np.int32), pose, movers, radius) for part in ([0, 1], [2], [3, 4, 5])]
    assert np.array_equal(together, np.concatenate(parts))
