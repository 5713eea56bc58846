"""Rigid bodies move like robots of the kinematic simulator where the two must agree."""

import math
import subprocess
import sys

import attrs
import numpy as np
import pytest
from mrpbench_simulators_pybullet import PyBullet, walls
from mrpbench_tests.fixtures.drive import BURGER, EMPTY, FURNISHED, RASTER, drive

from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet, Lidar
from mrpbench_core.model.execution.state import Inputs
from mrpbench_core.model.worlds.world import Door, Level, World
from mrpbench_core.testing.fixtures.room import PERIOD

pytest.importorskip("pybullet", reason="PyBullet has no wheel for this Python")

MODELS = pytest.mark.parametrize("model", ["wheels", "body"])


def run(simulator, world, robots, starts, command, seconds, **options):
    """States before and after every period, and all scans."""
    return drive(simulator, world, robots, starts, command, round(seconds / PERIOD), **options)


def turned(states):
    """Total angle turned by robot 0."""
    return float(np.unwrap([state.pose[0, 2] for state in states])[-1] - states[0].pose[0, 2])


def travelled(states):
    places = np.array([state.pose[0, :2] for state in states])
    return float(np.hypot(*np.diff(places, axis=0).T).sum())


@MODELS
@pytest.mark.parametrize("name", ["turtlebot3_burger", "turtlebot3_waffle", "agv_600"])
@pytest.mark.parametrize("command", [(0.2, 0.0), (0.0, 1.0), (0.2, 0.5), (0.15, -1.5), (-0.1, 0.3)])
def test_robots_move_as_in_the_kinematic_simulator(model, name, command):
    robot, bullet = load_robot(name), PyBullet(model=model)
    rigid, plane = (run(kind, EMPTY, (robot,), [[1, 2, 0.4]], [command], 8)[0] for kind in (bullet, Kinematic()))
    assert travelled(rigid) == pytest.approx(travelled(plane), rel=0.005, abs=0.005)
    assert turned(rigid) == pytest.approx(turned(plane), rel=0.002, abs=0.002)
    assert np.allclose(rigid[-1].pose[0, :2], plane[-1].pose[0, :2], atol=0.01)
    steady = np.array([state.twist[0] for state in rigid[40:]]).mean(axis=0)
    assert steady == pytest.approx(command, rel=0.005, abs=1e-3)


@pytest.mark.parametrize("name", ["turtlebot3_burger", "turtlebot3_waffle", "agv_600"])
@pytest.mark.parametrize("model", ["wheels", "body"])
def test_steady_speeds_err_by_less_than_a_thousandth(model, name):
    """Speed within 0.1 % and turn rate within 3e-4 rad/s, over 10 s."""
    robot = load_robot(name)
    share = [(1.0, 0.0), (0.9, 0.2), (0.7, -0.6), (-0.5, 0.1), (0.95, 0.9)]
    commands = np.array(share) * (robot.max_speed, min(robot.max_turn_rate, 2.5))
    starts = [[20 * index, 0, 0.4] for index in range(len(share))]
    states, _ = run(PyBullet(model=model), EMPTY, (robot,) * len(share), starts, commands, 12)
    pose = np.array([state.pose for state in states[40:]])
    yaw = np.unwrap(pose[:, :, 2], axis=0)
    step, turn = np.diff(pose[:, :, :2], axis=0), np.diff(yaw, axis=0)
    heading = yaw[:-1] + turn / 2
    ahead = (step[..., 0] * np.cos(heading) + step[..., 1] * np.sin(heading)) / np.sinc(turn / (2 * np.pi))
    seconds = len(step) * PERIOD
    assert np.abs(ahead.sum(axis=0) / seconds / commands[:, 0] - 1).max() < 1e-3
    assert np.abs((yaw[-1] - yaw[0]) / seconds - commands[:, 1]).max() < 3e-4


def test_bodies_drive_the_exact_arcs_of_the_kinematic_simulator():
    def wander(simulator):
        random, starts = np.random.default_rng(3), np.array([[3.0 * robot, 0, robot] for robot in range(5)])
        with simulator.open(EMPTY, Fleet(robots=(BURGER,) * 5), starts, 0, PERIOD) as simulation:
            states = []
            for period in range(600):
                if period % 12 == 0:
                    command = random.uniform([-0.1, -2.0], [0.22, 2.0], (5, 2))
                states.append(simulation.step(Inputs(twist=command)))
        return [np.array([getattr(state, name) for state in states]) for name in ("pose", "twist")]

    (pose, twist), (exact_pose, exact_twist) = wander(PyBullet(model="body")), wander(Kinematic())
    assert np.abs(pose - exact_pose)[..., :2].max() < 1e-6
    assert np.allclose(twist, exact_twist, atol=1e-9)


def test_bodies_that_jostle_stay_in_the_plane():
    random, starts = np.random.default_rng(5), [[0.4 + 0.35 * (i % 3), 0.4 + 0.35 * (i // 3), i] for i in range(9)]
    room = World(
        name="room", levels=(Level(name="L1", walls=[[0, 0, 2, 0], [2, 0, 2, 2], [2, 2, 0, 2], [0, 2, 0, 0]]),)
    )
    fleet = Fleet(robots=(BURGER,) * 9)
    with PyBullet(model="body").open(room, fleet, np.array(starts, float), 0, PERIOD) as simulation:
        touched = 0
        for period in range(600):
            if period % 20 == 0:
                command = random.uniform([-0.2, -2.0], [0.22, 2.0], (9, 2))
            state = simulation.step(Inputs(twist=command))
            touched += len(state.contacts)
            for body in simulation.engine.bodies:
                (x, y, z), (qx, qy, _, _) = simulation.engine.bullet.getBasePositionAndOrientation(body)
                assert abs(z) < 1e-3
                assert abs(qx) + abs(qy) < 1e-3
                assert 0 < x < 2
                assert 0 < y < 2
    assert touched > 200


def test_a_standing_robot_stands():
    states, _ = run(PyBullet(), EMPTY, (BURGER,), [[1, 2, 0.5]], [[0, 0]], 5)
    assert np.allclose(states[-1].pose, [[1, 2, 0.5]], atol=1e-4)
    assert not any(len(state.contacts) for state in states)


def test_ray_tests_and_the_native_caster_see_the_same():
    starts = [[1, 1, 0.3], [2.3, 1.7, 2], [4.4, 1, -1], [5, 4, 3], [2.5, 4.2, -2.5], [1.75, 1.2, 1]]
    place, command = np.array([[3.5, 3.5, 0, 0], [4.5, 2.5, 0.1, 0]]), np.tile((0.1, 0.4), (6, 1))
    door = Door(name="door", start=(4.0, 2.5), end=(5.9, 2.5), motion="hinged")
    world = attrs.evolve(FURNISHED, levels=(attrs.evolve(FURNISHED.levels[0], doors=(door,)),))
    (_, rays), (_, cast) = (
        run(PyBullet(lidar=kind), world, (BURGER,) * 6, starts, command, 2, movers=(0.2, 0.3), place=place)
        for kind in ("pybullet", "native")
    )
    assert [(a.stamp, a.robot.tolist()) for a in rays] == [(b.stamp, b.robot.tolist()) for b in cast]
    a, b = (np.concatenate([batch.ranges for batch in scans]) for scans in (rays, cast))
    assert len(a) > 50
    assert np.isclose(a, b, rtol=0, atol=0.002).mean() > 0.99  # inf equals inf; an edge may be just missed
    assert 0.5 < np.isfinite(a).mean() < 1


def test_a_longer_timestep_gives_nearly_the_same_motion():
    fine, coarse = (
        run(PyBullet(timestep=step), EMPTY, (BURGER,), [[0, 0, 0]], [[0.2, 0.5]], 6)[0][-1].pose[0]
        for step in (1 / 240, 1 / 100)
    )
    assert np.allclose(fine, coarse, atol=0.02)


@pytest.mark.parametrize("world", [FURNISHED, RASTER], ids=["walls", "raster"])
@pytest.mark.parametrize("lidar", ["pybullet", "native"])
def test_lidars_of_both_simulators_agree(world, lidar):
    starts = [[1, 1, 0.3]]  # alone, for other robots are discs in one and shapes in the other
    if world is RASTER:  # in the middle of free cells
        free = world.levels[0].occupancy.centres(np.argwhere(~world.levels[0].occupancy.blocked))
        starts = [[x, y, x + y] for x, y in free[::10]]
    command = np.zeros((len(starts), 2))
    (_, rigid), (_, plane) = (
        run(kind, world, (BURGER,) * len(starts), starts, command, 0.2) for kind in (PyBullet(lidar=lidar), Kinematic())
    )
    assert [(a.stamp, a.robot.tolist()) for a in rigid] == [(b.stamp, b.robot.tolist()) for b in plane]
    a, b = (np.concatenate([batch.ranges for batch in scans]) for scans in (rigid, plane))
    same = np.isclose(a, b, rtol=0, atol=0.01)  # inf equals inf
    assert same.mean() >= 0.99
    assert 0.3 < np.isfinite(a).mean() < 1


def test_large_worlds_are_several_meshes_that_act_as_one(monkeypatch):
    command = [[0.2, 0.0]]
    (whole, seen), (parts, seen_in_parts) = (
        (
            monkeypatch.setattr(walls, "_SEGMENTS", size),
            run(PyBullet(lidar="pybullet"), FURNISHED, (BURGER,), [[5.6, 3.5, 0]], command, 3),
        )[1]
        for size in (10_000, 7)
    )
    assert np.allclose(seen[0].ranges, seen_in_parts[0].ranges)
    assert whole[-1].contacts.tolist() == parts[-1].contacts.tolist() == [[0, -1]]


def test_robots_see_the_outlines_of_each_other():
    _, scans = run(PyBullet(lidar="pybullet"), EMPTY, (BURGER,) * 2, [[0, 0, 0], [1, 0, math.pi]], np.zeros((2, 2)), 0)
    assert scans[0].ranges[0, 0] == pytest.approx(1 + 0.032 - 0.038, abs=0.002)
    assert np.isfinite(scans[0].ranges[0]).mean() == pytest.approx(math.atan(0.089 / 1.0) / math.pi, abs=0.01)


def test_more_beams_than_one_call_can_take():
    robot = attrs.evolve(BURGER, lidar=Lidar(beams=20_000, range=9.0, mount=(0, 0, 0.2)))
    _, scans = run(PyBullet(lidar="pybullet"), FURNISHED, (robot,), [[1, 1, 0]], [[0, 0]], 0)
    assert scans[0].ranges.shape == (1, 20_000)
    assert np.isfinite(scans[0].ranges).all()


@MODELS
def test_a_robot_touches_a_wall_with_its_front_and_says_so(model):
    states, _ = run(PyBullet(model=model), FURNISHED, (BURGER,), [[5.5, 3.5, 0]], [[0.2, 0]], 6)
    assert states[-1].contacts.tolist() == [[0, -1]]
    assert states[-1].pose[0, 0] + 0.038 == pytest.approx(6 - 0.05, abs=0.005)
    assert abs(states[-1].twist[0, 0]) < 0.02
    untouched = next(index for index, state in enumerate(states) if len(state.contacts))
    assert pytest.approx(untouched * PERIOD, abs=0.2) == (6 - 0.05 - 0.038 - 5.5) / 0.2


@MODELS
def test_robots_that_meet_report_the_pair_once(model):
    states, _ = run(
        PyBullet(model=model), EMPTY, (BURGER,) * 3, [[0.6, 0, math.pi], [5, 5, 0], [0, 0, 0]], [[0.2, 0]] * 3, 3
    )
    assert [0, 2] in states[-1].contacts.tolist()
    assert not any([1, other] in state.contacts.tolist() for state in states for other in (-1, 0, 2))
    assert len(np.unique(states[-1].contacts, axis=0)) == len(states[-1].contacts)


@MODELS
@pytest.mark.parametrize("lidar", ["pybullet", "native"])
def test_a_mover_is_seen_touched_and_not_pushed(model, lidar):
    states, scans = run(
        PyBullet(model=model, lidar=lidar),
        EMPTY,
        (BURGER,),
        [[0, 0, 0]],
        [[0.2, 0]],
        4,
        movers=(0.3,),
        place=np.array([[0.8, 0, 0, 0]]),
    )
    assert states[-1].contacts.tolist() == [[0, 1]]
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
from mrpbench_core.model.execution.state import Inputs
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import Level, World
room = World(name="room", levels=(Level(name="L1", walls=[[0, 0, 2, 0], [2, 0, 2, 2], [2, 2, 0, 2], [0, 2, 0, 0]]),))
starts = np.array([[x, y, x + y] for x in (0.4, 1.0, 1.6) for y in (0.4, 1.0, 1.6)])
random, digest = np.random.default_rng(7), hashlib.sha256()
fleet = Fleet(robots=(load_robot("turtlebot3_burger"),) * 9)
with PyBullet(model=MODEL, lidar=LIDAR).open(room, fleet, starts, 0, 0.05) as simulation:
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


@pytest.mark.parametrize(("model", "lidar"), [("wheels", "native"), ("body", "native"), ("wheels", "pybullet")])
def test_two_processes_agree_to_the_last_bit_and_print_nothing_of_their_own(model, lidar):
    script = SCRIPT.replace("MODEL", repr(model)).replace("LIDAR", repr(lidar))

    def output():
        done = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True)
        assert not done.stderr
        return done.stdout

    first = output()
    assert len(first.strip()) == 64
    assert first == output()
