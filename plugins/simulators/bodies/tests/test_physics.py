"""What holds of rigid bodies in any engine: weight, momentum, energy, walls that hold."""

import math

import attrs
import numpy as np
import pytest
from mrpbench_tests.fixtures.drive import BURGER, EMPTY, FURNISHED, WAFFLE, drive

from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.state import Inputs
from mrpbench_core.model.worlds.world import Level, World
from mrpbench_core.testing.fixtures.room import PERIOD

ROOM = World(name="room", levels=(Level(name="L1", walls=[[0, 0, 3, 0], [3, 0, 3, 3], [3, 3, 0, 3], [0, 3, 0, 0]]),))


def placed(robots):
    return [[0.4 + 0.7 * (i % 4), 0.4 + 0.7 * (i // 4), i] for i in range(robots)]


def test_a_robot_pushes_a_wall_as_hard_as_its_wheels_hold(kind):
    """Rubber on the floor: wheels slip when they push with the weight that they bear, all but what the caster has."""
    states, _ = drive(kind(), FURNISHED, (BURGER,), [[5.6, 3.5, 0]], [[0.22, 0]], 160)
    late = np.array([state.contact_force.sum() for state in states[-60:]])
    assert 0.8 * BURGER.mass * 9.81 < late.mean() < 1.01 * BURGER.mass * 9.81
    assert np.ptp([state.pose[0, 0] for state in states[-60:]]) < 0.002


def test_a_body_that_hits_a_wall_gives_it_its_momentum(kind):
    """Without weight and motors: the impulse of the contact is the change of momentum."""
    with kind(model="body").open(
        FURNISHED, Fleet(robots=(BURGER,)), np.array([[5.85, 3.5, 0.0]]), 0, PERIOD
    ) as simulation:
        engine, impulse = simulation.engine, 0.0
        engine.prepare(np.array([[5.85, 3.5]]))
        engine.move(np.array([[0.2, 0.0, 0.0]]))
        for _ in range(60):
            engine.advance()
            impulse += sum(engine.contacts().values()) * simulation.scene.timestep
        ahead = engine.observe()[1][0, 0]
    assert impulse == pytest.approx(BURGER.mass * (0.2 - ahead), rel=0.02)
    assert abs(ahead) < 0.21


@pytest.mark.parametrize("name", ["turtlebot3_burger", "turtlebot3_waffle", "agv_600"])
def test_no_robot_falls_sinks_jumps_or_leaves_the_room(kind, name):
    robot = load_robot(name)
    size = 8 * robot.radius
    walls = size * np.array([[0, 0, 1, 0], [1, 0, 1, 1], [1, 1, 0, 1], [0, 1, 0, 0]])
    room = World(name="room", levels=(Level(name="L1", walls=walls),))
    starts = [[size * (1 + 2 * (i % 2)) / 4, size * (1 + 2 * (i // 2)) / 4, i] for i in range(4)]
    random = np.random.default_rng(5)
    commands = random.uniform((-0.5, -1), (1, 1), (40, 4, 2)) * (robot.max_speed, robot.max_turn_rate)
    states, _ = drive(kind(), room, (robot,) * 4, starts, lambda period: commands[period // 10], 400)
    pose = np.array([state.pose for state in states])
    assert (pose[:, :, :2] > 0).all()
    assert (pose[:, :, :2] < size).all()
    moved = np.hypot(*np.diff(pose[:, :, :2], axis=0).transpose(2, 0, 1)) / PERIOD
    assert moved.max() < 2 * robot.max_speed
    assert sum(len(state.contacts) for state in states) > 20


def test_robots_of_mujoco_stay_level_on_the_floor():
    kind = pytest.importorskip("mrpbench_simulators_mujoco").MuJoCo
    fleet = Fleet(robots=(BURGER, WAFFLE) * 4)
    random = np.random.default_rng(1)
    with kind().open(ROOM, fleet, np.array(placed(8), float), 0, PERIOD) as simulation:
        for period in range(400):
            if period % 10 == 0:
                command = random.uniform((-0.2, -2), (0.26, 2), (8, 2))
            simulation.step(Inputs(twist=command))
            upright = simulation.engine.tilts()
            assert np.abs(simulation.engine.heights()).max() < 0.01
            assert upright.max() < math.radians(8)


def test_without_friction_and_motors_energy_does_not_grow():
    """Bodies that keep to the plane collide: momentum is conserved while they touch no wall, and energy never grows."""
    kind = pytest.importorskip("mrpbench_simulators_mujoco").MuJoCo
    robots = (attrs.evolve(BURGER, mass=1.0), attrs.evolve(BURGER, mass=3.0))
    starts = np.array([[0, 0, 0], [0.4, 0.02, math.pi]])
    with kind(model="body").open(EMPTY, Fleet(robots=robots), starts, 0, PERIOD) as simulation:
        engine = simulation.engine
        engine.move(np.array([[0.2, 0, 0], [-0.1, 0, 0]]))
        mass = np.array([1.0, 3.0])

        def momentum():
            return mass @ engine.velocities()[:, :2]

        def energy():
            turning = [robot.mass * (robot.footprint**2).sum(axis=1).mean() / 2 for robot in robots]
            velocity = engine.velocities()
            return float(mass @ (velocity[:, :2] ** 2).sum(axis=1) + turning @ velocity[:, 2] ** 2) / 2

        before, last, touched = momentum(), energy(), False
        for _ in range(240):
            engine.advance()
            touched |= bool(engine.contacts())
            assert momentum() == pytest.approx(before, abs=1e-9)
            assert energy() < last * (1 + 1e-3)
            last = min(last, energy())
        assert touched


def test_a_box_on_the_floor_presses_on_it_with_its_weight(kind):
    """A robot that stands: the normal forces of its wheels and casters."""
    with kind().open(EMPTY, Fleet(robots=(BURGER,)), np.zeros((1, 3)), 0, PERIOD) as simulation:
        for _ in range(40):
            simulation.step(Inputs(twist=np.zeros((1, 2))))
        assert simulation.engine.weight() == pytest.approx(BURGER.mass * 9.81, rel=0.02)
