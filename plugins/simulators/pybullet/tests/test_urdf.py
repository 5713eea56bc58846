"""Robots on the wheels of their URDF: a cart of our own with a caster, a mesh, and one wheel mounted in reverse."""

import math
from pathlib import Path

import attrs
import numpy as np
import pytest
from mrpbench_simulators_pybullet import PyBullet

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.state import Inputs
from mrpbench_core.model.worlds.world import Level, World
from mrpbench_core.testing.fixtures.drive import EMPTY
from mrpbench_core.testing.fixtures.drive import drive as drive_simulator
from mrpbench_core.testing.fixtures.room import PERIOD

pytest.importorskip("pybullet", reason="PyBullet has no wheel for this Python")

FOLDER = Path(__file__).parent / "robots"
CART = load_robot("cart.yaml", FOLDER)


def drive(commands, seconds, starts=None, world=EMPTY, robot=CART):
    """Poses f8[T,n,3], twists f8[T,n,2] and contacts of each period."""
    robots = [robot] * len(commands)
    if starts is None:
        starts = [[20.0 * index, 1.0, 0.4] for index in range(len(commands))]
    states, _ = drive_simulator(PyBullet(), world, robots, starts, commands, round(seconds / PERIOD))
    return (
        np.array([state.pose for state in states]),
        np.array([state.twist for state in states]),
        [state.contacts.tolist() for state in states],
    )


def test_steady_speeds_and_turns_err_as_little_as_those_of_robots_without_a_urdf():
    """Driven straight and turned in place: 0.1 % and 3e-4 rad/s, over 10 s. In tight arcs, twice that."""
    share = [(1.0, 0.0), (-0.7, 0.0), (0.0, 1.0), (0.0, -0.5), (0.9, 0.2), (0.7, -0.6), (0.95, 0.9)]
    commands = np.array(share) * (CART.max_speed, CART.max_turn_rate)
    pose, twist, contacts = drive(commands, 12)
    pose, twist = pose[40:], twist[40:]
    yaw = np.unwrap(pose[:, :, 2], axis=0)
    step, turn = np.diff(pose[:, :, :2], axis=0), np.diff(yaw, axis=0)
    heading = yaw[:-1] + turn / 2
    ahead = (step[..., 0] * np.cos(heading) + step[..., 1] * np.sin(heading)) / np.sinc(turn / (2 * np.pi))
    seconds = len(step) * PERIOD
    speed, rate = ahead.sum(axis=0) / seconds, (yaw[-1] - yaw[0]) / seconds
    assert np.abs(speed - commands[:, 0]).max() < 1e-3 * CART.max_speed
    assert np.abs(rate - commands[:, 1])[:4].max() < 3e-4
    assert np.abs(rate - commands[:, 1]).max() < 6e-4
    assert np.abs(twist.mean(axis=0) - commands).max() < 1e-3
    assert not any(contacts)


def test_a_robot_turns_about_the_middle_of_its_axle_and_stands_where_it_is_put():
    """The origin of the URDF's root link, and its centre of mass, lie elsewhere."""
    pose, _, _ = drive([[0.0, 1.0], [0.0, 0.0]], 3)
    assert np.allclose(pose[0], [[0, 1, 0.4], [20, 1, 0.4]], atol=1e-6)
    assert np.abs(pose[:, 0, :2] - [0, 1]).max() < 2e-3
    assert np.allclose(pose[:, 1], [20, 1, 0.4], atol=5e-4)


def test_the_origin_of_the_root_link_does_not_matter(tmp_path):
    """A cart whose URDF counts from its front left corner, on the floor, is the same cart."""
    text = (FOLDER / "cart.urdf").read_text()
    moved = text.replace(
        '<link name="base_link">',
        '<link name="corner"/><joint name="corner_joint" type="fixed"><parent link="corner"/><child link="base_link"/>'
        '<origin xyz="-0.18 -0.13 0.06"/></joint><link name="base_link">',
    )
    (tmp_path / "cart.urdf").write_text(moved)
    (tmp_path / "cap.obj").write_bytes((FOLDER / "cap.obj").read_bytes())
    (tmp_path / "cart.yaml").write_text((FOLDER / "cart.yaml").read_text())
    command = [[0.3, 0.6]]
    same, other = (drive(command, 5, robot=robot)[0] for robot in (CART, load_robot("cart.yaml", tmp_path)))
    assert np.allclose(same, other, atol=5e-3)


def test_wheels_that_stand_out_and_parts_above_the_body_touch_walls():
    """The wheels' outer faces lie 0.165 m beside the middle, the body's sides 0.13 m; the front is 0.18 m ahead."""
    ahead = World(name="wall", levels=(Level(name="L1", walls=[[1.0, -2, 1.0, 2]]),))
    thickness = 0.05
    pose, twist, contacts = drive([[0.3, 0.0]], 4, [[0, 0, 0]], ahead)
    assert contacts[-1] == [[0, -1]]
    assert pose[-1, 0, 0] == pytest.approx(1 - thickness - 0.18, abs=0.01)
    assert abs(twist[-1, 0, 0]) < 0.02
    for gap, touches in ((0.155, True), (0.175, False)):
        beside = World(name="wall", levels=(Level(name="L1", walls=[[0.6, gap + thickness, 2.0, gap + thickness]]),))
        _, _, contacts = drive([[0.3, 0.0]], 4, [[0, 0, 0]], beside)
        assert any(contacts) == touches


def test_robots_of_both_sorts_meet():
    fleet = Fleet(robots=(CART, load_robot("turtlebot3_burger")))
    with PyBullet().open(EMPTY, fleet, np.array([[0, 0, 0], [0.8, 0, math.pi]]), 0, PERIOD) as simulation:
        for _ in range(60):
            state = simulation.step(Inputs(twist=np.array([[0.2, 0.0], [0.2, 0.0]])))
    assert state.contacts.tolist() == [[0, 1]]


def test_two_runs_agree_to_the_last_bit():
    random = np.random.default_rng(3).uniform(-1, 1, (40, 2))

    def wander():
        with PyBullet().open(EMPTY, Fleet(robots=(CART,)), np.zeros((1, 3)), 0, PERIOD) as simulation:
            return [simulation.step(Inputs(twist=command[None])).pose.tobytes() for command in random]

    assert wander() == wander()


def test_a_body_larger_than_the_footprint_is_refused():
    narrow = attrs.evolve(CART, footprint=CART.footprint * (1.0, 0.8))
    with pytest.raises(InputError, match=r"'\w+_wheel_joint' stands out 0\.03\d m beyond the footprint"):
        drive([[0, 0]], 0, robot=narrow)
    short = attrs.evolve(CART, footprint=CART.footprint * (0.5, 1.0))
    with pytest.raises(InputError, match=r"'base_link' stands out 0\.\d+ m beyond the footprint of cart"):
        drive([[0, 0]], 0, robot=short)


def test_a_mesh_that_is_none_is_one_line(tmp_path):
    for name in ("cart.yaml", "cart.urdf"):
        (tmp_path / name).write_text((FOLDER / name).read_text().replace("cap.obj", "cap.xyz"))
    (tmp_path / "cap.xyz").write_text("nothing")
    robot = load_robot("cart.yaml", tmp_path)
    with pytest.raises(InputError, match=r"cart\.urdf: PyBullet cannot load this URDF \(meshes must be"):
        drive([[0, 0]], 0, robot=robot)
