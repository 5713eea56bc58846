"""The rigid-body simulator, held against the kinematic one of the core where the two must agree."""

import math
import subprocess
import sys

import attrs
import numpy as np
import pytest
from mrpbench_simulators_pybullet import PyBullet, walls

from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.execution import Inputs
from mrpbench_core.model.fleet import Fleet, Lidar
from mrpbench_core.model.occupancy import Occupancy
from mrpbench_core.model.world import Level, Obstacle, World

pytest.importorskip("pybullet", reason="PyBullet has no wheel for this Python")

PERIOD = 0.05
BURGER = load_robot("turtlebot3_burger")
EMPTY = World(name="empty", levels=(Level(name="L1"),))
ROOM = World(
    name="room",
    levels=(
        Level(
            name="L1",
            walls=[[0, 0, 6, 0], [6, 0, 6, 5], [6, 5, 0, 5], [0, 5, 0, 0], [3, 0, 3, 2], [3, 2, 4, 2.5]],
            obstacles=(Obstacle(name="crate", polygon=[[1, 3], [1.6, 3.2], [1.2, 3.8]]),),
        ),
    ),
)
RASTER = World(
    name="raster",
    levels=(Level(name="L1", occupancy=Occupancy(blocked=np.arange(70).reshape(7, 10) % 6 == 5, cell_size=0.7)),),
)


def run(simulator, world, robots, starts, command, seconds, movers=(), place=None):
    """States before and after every period, and all scans."""
    with simulator.open(world, Fleet(robots=robots), np.array(starts, float), 0, PERIOD, movers) as simulation:
        states, scans = [simulation.state], [*simulation.scans()]
        for _ in range(round(seconds / PERIOD)):
            states.append(simulation.step(Inputs(twist=np.array(command, float), movers=place)))
            scans += simulation.scans()
    return states, scans


def turned(states):
    """Total angle turned by robot 0."""
    return float(np.unwrap([state.pose[0, 2] for state in states])[-1] - states[0].pose[0, 2])


def travelled(states):
    places = np.array([state.pose[0, :2] for state in states])
    return float(np.hypot(*np.diff(places, axis=0).T).sum())


@pytest.mark.parametrize("name", ["turtlebot3_burger", "turtlebot3_waffle"])
@pytest.mark.parametrize("command", [(0.2, 0.0), (0.0, 1.0), (0.2, 0.5), (0.15, -1.5), (-0.1, 0.3)])
def test_wheels_do_what_the_kinematic_simulator_does(name, command):
    robot = load_robot(name)
    rigid, plane = (run(kind, EMPTY, (robot,), [[1, 2, 0.4]], [command], 8)[0] for kind in (PyBullet(), Kinematic()))
    assert travelled(rigid) == pytest.approx(travelled(plane), rel=0.005, abs=0.005)
    assert turned(rigid) == pytest.approx(turned(plane), rel=0.002, abs=0.002)
    assert np.allclose(rigid[-1].pose[0, :2], plane[-1].pose[0, :2], atol=0.01)
    steady = np.array([state.twist[0] for state in rigid[40:]]).mean(axis=0)
    assert steady == pytest.approx(command, rel=0.005, abs=1e-3)


def test_a_standing_robot_stands():
    states, _ = run(PyBullet(), EMPTY, (BURGER,), [[1, 2, 0.5]], [[0, 0]], 5)
    assert np.allclose(states[-1].pose, [[1, 2, 0.5]], atol=1e-4)
    assert not any(len(state.contacts) for state in states)


def test_a_longer_timestep_gives_nearly_the_same_motion():
    fine, coarse = (
        run(PyBullet(timestep=step), EMPTY, (BURGER,), [[0, 0, 0]], [[0.2, 0.5]], 6)[0][-1].pose[0]
        for step in (1 / 240, 1 / 100)
    )
    assert np.allclose(fine, coarse, atol=0.02)


@pytest.mark.parametrize("world", [ROOM, RASTER], ids=["walls", "raster"])
def test_lidars_of_both_simulators_agree(world):
    starts = [[1, 1, 0.3], [2.3, 1.7, 2], [4.4, 1, -1], [5, 4, 3], [2.5, 4.2, -2.5], [1.75, 1.2, 1]]
    if world is RASTER:  # in the middle of free cells
        free = world.levels[0].occupancy.centres(np.argwhere(~world.levels[0].occupancy.blocked))
        starts = [[x, y, x + y] for x, y in free[::10]]
    command = np.zeros((len(starts), 2))
    (_, rigid), (_, plane) = (
        run(kind, world, (BURGER,) * len(starts), starts, command, 0.2) for kind in (PyBullet(), Kinematic())
    )
    assert [(a.stamp, a.robot.tolist()) for a in rigid] == [(b.stamp, b.robot.tolist()) for b in plane]
    a, b = (np.concatenate([batch.ranges for batch in scans]) for scans in (rigid, plane))
    same = np.isclose(a, b, rtol=0, atol=0.01)  # inf equals inf
    assert same.mean() >= 0.99
    assert 0.3 < np.isfinite(a).mean() < 1


def test_large_worlds_are_several_meshes_that_act_as_one(monkeypatch):
    command = [[0.2, 0.0]]
    (whole, seen), (parts, seen_in_parts) = (
        (monkeypatch.setattr(walls, "_SEGMENTS", size), run(PyBullet(), ROOM, (BURGER,), [[5.6, 3.5, 0]], command, 3))[
            1
        ]
        for size in (10_000, 7)
    )
    assert np.allclose(seen[0].ranges, seen_in_parts[0].ranges)
    assert whole[-1].contacts.tolist() == parts[-1].contacts.tolist() == [[0, -1]]


def test_robots_see_each_other_as_discs():
    _, scans = run(PyBullet(), EMPTY, (BURGER,) * 2, [[0, 0, 0], [1, 0, 2]], np.zeros((2, 2)), 0)
    assert scans[0].ranges[0, 0] == pytest.approx(1 + 0.032 - BURGER.radius, abs=0.005)
    assert np.isfinite(scans[0].ranges[0]).mean() == pytest.approx(math.asin(BURGER.radius / 1.032) / math.pi, abs=0.01)


def test_more_beams_than_one_call_can_take():
    lidar = Lidar(beams=20_000, range=9.0, mount=(0, 0, 0.2))
    _, scans = run(PyBullet(), ROOM, (attrs.evolve(BURGER, lidar=lidar),), [[1, 1, 0]], [[0, 0]], 0)
    assert scans[0].ranges.shape == (1, 20_000)
    assert np.isfinite(scans[0].ranges).all()


def test_a_robot_touches_a_wall_with_its_front_and_says_so():
    states, _ = run(PyBullet(), ROOM, (BURGER,), [[5.5, 3.5, 0]], [[0.2, 0]], 6)
    assert states[-1].contacts.tolist() == [[0, -1]]
    assert states[-1].pose[0, 0] + 0.038 == pytest.approx(6 - 0.05, abs=0.005)
    assert abs(states[-1].twist[0, 0]) < 0.02
    untouched = next(index for index, state in enumerate(states) if len(state.contacts))
    assert pytest.approx(untouched * PERIOD, abs=0.2) == (6 - 0.05 - 0.038 - 5.5) / 0.2


def test_robots_that_meet_report_the_pair_once():
    states, _ = run(PyBullet(), EMPTY, (BURGER,) * 3, [[0.6, 0, math.pi], [5, 5, 0], [0, 0, 0]], [[0.2, 0]] * 3, 3)
    assert [0, 2] in states[-1].contacts.tolist()
    assert not any([1, other] in state.contacts.tolist() for state in states for other in (-1, 0, 2))
    assert len(np.unique(states[-1].contacts, axis=0)) == len(states[-1].contacts)


def test_a_mover_is_seen_touched_and_not_pushed():
    states, scans = run(
        PyBullet(), EMPTY, (BURGER,), [[0, 0, 0]], [[0.2, 0]], 4, movers=(0.3,), place=np.array([[0.8, 0, 0, 0]])
    )
    assert states[-1].contacts.tolist() == [[0, -1]]
    assert states[-1].pose[0, 0] == pytest.approx(0.8 - 0.3 - 0.038, abs=0.005)
    assert np.isinf(scans[0].ranges).all()
    assert scans[1].ranges[0, 0] == pytest.approx(0.8 - 0.3 + 0.032 - 0.04, abs=0.01)


def test_closing_twice_is_fine_and_two_worlds_do_not_mix():
    fleet, start = Fleet(robots=(BURGER,)), np.zeros((1, 3))
    first, second = (PyBullet().open(EMPTY, fleet, start, 0, PERIOD) for _ in range(2))
    first.step(Inputs(twist=np.array([[0.2, 0.0]])))
    assert second.state.pose.tolist() == start.tolist()
    first.close()
    first.close()
    assert second.step(Inputs(twist=np.array([[0.2, 0.0]]))).pose[0, 0] > 0
    second.close()


SCRIPT = """
import hashlib, numpy as np
from mrpbench_simulators_pybullet import PyBullet
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.execution import Inputs
from mrpbench_core.model.fleet import Fleet
from mrpbench_core.model.world import Level, World
room = World(name="room", levels=(Level(name="L1", walls=[[0, 0, 2, 0], [2, 0, 2, 2], [2, 2, 0, 2], [0, 2, 0, 0]]),))
starts = np.array([[x, y, x + y] for x in (0.4, 1.0, 1.6) for y in (0.4, 1.0, 1.6)])
random, digest = np.random.default_rng(7), hashlib.sha256()
with PyBullet().open(room, Fleet(robots=(load_robot("turtlebot3_burger"),) * 9), starts, 0, 0.05) as simulation:
    contacts = 0
    for period in range(100):
        state = simulation.step(Inputs(twist=random.uniform(-1, 1, (9, 2))))
        contacts += len(state.contacts)
        digest.update(state.pose.tobytes() + state.twist.tobytes() + state.contacts.tobytes())
        for batch in simulation.scans():
            digest.update(batch.ranges.tobytes())
assert contacts
print(digest.hexdigest())
"""


def test_two_processes_agree_to_the_last_bit_and_print_nothing_of_their_own():
    def output():
        done = subprocess.run([sys.executable, "-c", SCRIPT], check=True, capture_output=True, text=True)
        assert not done.stderr
        return done.stdout

    first = output()
    assert len(first.strip()) == 64
    assert first == output()
