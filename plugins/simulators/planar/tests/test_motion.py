"""Motion and contacts agree with the simulators that have the same rules and other code."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_simulators_planar import Planar
from mrpbench_tests.fixtures.drive import BURGER, EMPTY, FURNISHED, STARTS, WAFFLE, drive

from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.worlds.solids import segments
from mrpbench_core.testing.fixtures.room import PERIOD

TOLERANCE = 1e-4
"""metres: the overlap that contacts may leave."""


def wander(period):
    """Commands for six robots that change every second."""
    return np.random.default_rng(period // 20).uniform([-0.1, -2.0], [0.22, 2.0], (6, 2))


def poses(states):
    return np.array([state.pose for state in states])


@pytest.mark.parametrize("command", [(0.2, 0.0), (0.0, 1.0), (0.2, 0.5), (0.15, -1.5), (-0.1, 0.3), (5.0, -9.0)])
def test_a_free_robot_moves_as_in_the_kinematic_simulator(command):
    ours, theirs = (
        drive(kind, EMPTY, (BURGER, WAFFLE), [[1, 2, 0.4], [5, 5, -3]], [command] * 2, 400)[0]
        for kind in (Planar(), Kinematic())
    )
    assert np.allclose(poses(ours), poses(theirs), rtol=0, atol=1e-11)
    assert np.allclose([state.twist for state in ours], [state.twist for state in theirs], rtol=0, atol=1e-12)


def test_robots_that_touch_walls_and_each_other_move_as_in_the_kinematic_simulator():
    """Rounding errors grow where many robots push each other; a minute with hundreds of contacts shows by how much."""
    robots = (BURGER,) * 4 + (WAFFLE,) * 2
    starts = [[1, 1, 0.3], [1.3, 1.1, 2], [1.2, 1.4, -1], [0.3, 0.3, 3], [2.5, 1, -2.5], [2, 0.5, 1]]
    (ours, _), (theirs, _) = (drive(kind, FURNISHED, robots, starts, wander, 1200) for kind in (Planar(), Kinematic()))
    touched = sum(len(state.contacts) for state in theirs)
    assert touched > 300
    assert [state.contacts.tolist() for state in ours] == [state.contacts.tolist() for state in theirs]
    assert np.abs(poses(ours) - poses(theirs))[..., :2].max() < 1e-6
    assert np.allclose([state.twist for state in ours], [state.twist for state in theirs], rtol=0, atol=1e-4)


def test_a_mover_that_walks_through_pushes_as_in_the_kinematic_simulator():
    def place(period):
        return np.array([[-1 + 0.02 * period, 0.1, 0.4, 0]])

    starts, command = [[0, 0, 0], [0.3, 0.05, 2]], [[0.1, 0]] * 2
    ours, theirs = (
        drive(kind, EMPTY, (BURGER,) * 2, starts, command, 100, movers=(0.3,), place=place)[0]
        for kind in (Planar(), Kinematic())
    )
    assert np.allclose(poses(ours), poses(theirs), rtol=0, atol=1e-9)
    assert [state.contacts.tolist() for state in ours] == [state.contacts.tolist() for state in theirs]
    assert sum([0, 1] in state.contacts.tolist() for state in theirs) > 5
    assert sum([0, 2] in state.contacts.tolist() for state in theirs) > 5


def test_a_robot_beside_a_wall_that_runs_into_a_mover_stays_as_in_the_kinematic_simulator():
    radius = BURGER.radius
    starts, command = [[1.0, radius + 0.055, 0.0]], [[0.2, 0]]
    person = np.array([[1.6, radius + 0.155, 0, 0]])  # it would deflect the robot into the wall, which is 5 cm thick
    ours, theirs = (
        drive(kind, FURNISHED, (BURGER,), starts, command, 60, movers=(0.25,), place=lambda _: person)[0]
        for kind in (Planar(), Kinematic())
    )
    touched = [tuple(pair) for state in theirs for pair in state.contacts.tolist()]
    assert set(touched) == {(0, 1)}
    assert [state.contacts.tolist() for state in ours] == [state.contacts.tolist() for state in theirs]
    assert np.allclose(poses(ours), poses(theirs), rtol=0, atol=1e-9)
    assert 1.2 < poses(ours)[-1, 0, 0] < 1.6 - radius


@pytest.mark.parametrize("command", [(0.2, 0.0), (0.2, 0.5), (0.15, -1.5)])
def test_driven_wheels_in_pybullet_come_within_a_centimetre(command):
    pytest.importorskip("pybullet", reason="PyBullet has no wheel for this Python")
    rigid = pytest.importorskip("mrpbench_simulators_pybullet").PyBullet()
    ours, theirs = (
        poses(drive(kind, EMPTY, (BURGER,), [[1, 2, 0.4]], [command], 160)[0])[:, 0] for kind in (Planar(), rigid)
    )
    assert np.hypot(*(ours - theirs)[:, :2].T).max() < 0.01
    assert np.abs(np.unwrap(ours[:, 2]) - np.unwrap(theirs[:, 2])).max() < 0.01


commands = st.lists(st.tuples(st.floats(-1, 1), st.floats(-4, 4)), min_size=6, max_size=6)


@settings(deadline=None, max_examples=40)
@given(st.lists(commands, min_size=1, max_size=4), st.floats(0, 0.3), st.floats(0, 0.5))
def test_robots_overlap_nothing_under_any_commands(plan, slip, noise):
    robots = (BURGER,) * 5 + (attrs.evolve(WAFFLE, max_speed=2.0),)
    simulator = Planar(slip=slip, actuation_noise=noise)
    states, _ = drive(simulator, FURNISHED, robots, STARTS, lambda period: plan[period // 25 % len(plan)], 100, seed=3)
    radii, outline = np.array([robot.radius for robot in robots]), segments(FURNISHED)
    first, second = np.triu_indices(6, 1)
    for state in states:
        place = state.pose[:, :2]
        apart = np.hypot(*(place[first] - place[second]).T)
        assert (apart >= radii[first] + radii[second] - TOLERANCE).all()
        assert (place > 0.05).all()
        assert (place < (5.95, 4.95)).all()
        gap = point_segment_distance(place[:, None], outline[:, :2], outline[:, 2:]).min(axis=1)
        assert (gap >= radii - TOLERANCE).all()
        walls = {(robot, -1) for robot, other in state.contacts.tolist() if other == -1}
        assert {(robot, -1) for robot in np.flatnonzero(gap < radii - 1e-8).tolist()} <= walls


def test_a_fast_robot_does_not_pass_through_a_wall():
    fast = attrs.evolve(BURGER, max_speed=20.0, acceleration=1000.0)
    states, _ = drive(Planar(), FURNISHED, (fast,), [[1, 1, 0]], [[20, 0]], 20)
    assert states[-1].pose[0, 0] < 2.95


def test_without_slip_and_noise_the_seed_does_not_matter():
    one, two = (drive(Planar(), EMPTY, (BURGER,), [[0, 0, 0]], [[0.2, 0.3]], 50, seed=seed)[0] for seed in (1, 2))
    assert np.array_equal(poses(one), poses(two))


@pytest.mark.parametrize("options", [{"slip": 0.05}, {"actuation_noise": 0.1}])
def test_slip_and_noise_follow_seed_and_robot(options):
    def final(seed, robots=3):
        starts = [[0, 2 * robot, 0] for robot in range(robots)]
        command = [[0.2, 0.1]] * robots
        states, _ = drive(Planar(**options), EMPTY, (BURGER,) * robots, starts, command, 100, seed=seed)
        return states[-1].pose - starts

    once = final(1)
    assert np.array_equal(once, final(1))
    assert np.array_equal(once, final(1, robots=7)[:3])
    assert not np.isclose(once, final(2)).any()
    assert len(np.unique(once[:, 0])) == 3


def test_a_negative_seed_is_a_seed():
    states, _ = drive(Planar(slip=0.1), EMPTY, (BURGER,), [[0, 0, 0]], [[0.2, 0]], 20, seed=-1)
    assert 0.1 < states[-1].pose[0, 0] < 0.2


def test_slipping_wheels_report_the_speed_over_ground():
    states, _ = drive(Planar(slip=0.2), EMPTY, (BURGER,), [[0, 0, 0]], [[0.2, 0]], 100)
    steps = np.hypot(*np.diff(poses(states)[:, 0, :2], axis=0).T)
    speeds = np.array([state.twist[0, 0] for state in states[1:]])
    assert np.allclose(steps[10:] / PERIOD, speeds[10:], rtol=1e-3)
    assert speeds[10:].mean() == pytest.approx(0.2 * 0.8, rel=0.05)


def test_no_robots_are_fine():
    states, scans = drive(Planar(), FURNISHED, (), np.empty((0, 3)), np.empty((0, 2)), 3)
    assert states[-1].pose.shape == (0, 3)
    assert not scans
