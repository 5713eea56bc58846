"""Runs with SLAM, and a corridor that leads around a block, 60 m long at its middle."""

import attrs
import numpy as np
import pytest

from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.common.poses import wrapped
from mrpbench_core.model.execution.observation import Odometry
from mrpbench_core.model.execution.state import Inputs
from mrpbench_core.model.worlds.world import Level, World

PERIOD = 0.1
BURGER = load_robot("turtlebot3_burger")
CORNERS = np.array([(1.0, 1.0), (19.0, 1.0), (19.0, 13.0), (1.0, 13.0)])
"""Of the middle of the corridor, which is 2 m wide: 18 m + 12 m + 18 m + 12 m."""
RECESSES = ((4.0, 0.0), (12.5, 0.0), (20.0, 5.0), (15.0, 14.0), (6.0, 14.0), (0.0, 9.0))
"""Where pillars 0.4 m wide stand out from the outer walls."""


def _world():
    """The corridor."""

    def box(left, bottom, right, top):
        return [
            [left, bottom, right, bottom],
            [right, bottom, right, top],
            [right, top, left, top],
            [left, top, left, bottom],
        ]

    walls = box(0, 0, 20, 14) + box(2, 2, 18, 12)
    walls += [wall for x, y in RECESSES for wall in box(x - 0.2, y - 0.2, x + 0.2, y + 0.2)]
    return World(name="ring", levels=(Level(name="L1", walls=walls),))


def _drive(seed, metres=64.0, lidar=0.01, odometry=0.005, bias=0.002):
    """Truth f8[T,1,3], odometry and scans of a robot that drives around the block, with noise as the engine adds it."""
    random = np.random.default_rng(seed)
    half = BURGER.wheel_separation / 2
    scale = 1 + bias * random.standard_normal(2)
    start = np.array([[1.0, 1.0, 0.0]])
    believed, driven, corner = np.zeros(3), 0.0, 1
    steps = []
    planar = pytest.importorskip("mrpbench_simulators_planar")
    with planar.Planar().open(_world(), Fleet(robots=(BURGER,)), start, 0, PERIOD) as simulation:
        state = simulation.state
        while driven < metres:
            scans = [
                (batch, np.maximum(batch.ranges + random.normal(0, lidar, batch.ranges.shape), 0))
                for batch in simulation.scans()
            ]
            steps.append((state.pose.copy(), believed.copy(), scans))
            bearing = np.arctan2(*(CORNERS[corner] - state.pose[0, :2])[::-1]) - state.pose[0, 2]
            turn = float(wrapped(np.array([bearing]))[0])
            twist = (0.22 if abs(turn) < 0.3 else 0.0, np.clip(2 * turn, -1.0, 1.0))
            before, state = state.pose[0], simulation.step(Inputs(twist=np.array([twist])))
            move = np.hypot(*(state.pose[0] - before)[:2])
            turned = float(wrapped(state.pose[0, 2:] - before[2:])[0])
            wheels = np.array([move - turned * half, move + turned * half])
            wheels = wheels * scale + odometry * np.sqrt(np.abs(wheels)) * random.standard_normal(2)
            heading = believed[2] + (wheels[1] - wheels[0]) / (4 * half)
            believed = believed + [
                wheels.sum() / 2 * np.cos(heading),
                wheels.sum() / 2 * np.sin(heading),
                (wheels[1] - wheels[0]) / (2 * half),
            ]
            driven += move
            if np.hypot(*(CORNERS[corner] - state.pose[0, :2])) < 0.1:
                corner = (corner + 1) % 4
    return steps


def _localized(localizer, steps):
    """Distances f8[T] in metres of the estimates from the truth, and the session."""
    session = localizer.start(Fleet(robots=(BURGER,)), _world(), steps[0][0], 0)
    off = []
    for step, (truth, believed, scans) in enumerate(steps):
        batches = [attrs.evolve(batch, ranges=ranges) for batch, ranges in scans]
        estimate = session.update(step * PERIOD, Odometry(pose=believed[None], twist=np.zeros((1, 2))), batches, None)
        off.append(np.hypot(*(estimate.pose - truth)[0, :2]))
    return np.array(off), session


@pytest.fixture(scope="module", autouse=True)
def _kept(kept_workers):
    """Studies of a module share their worker processes."""


@pytest.fixture(scope="session")
def drive():
    """Return a function that drives a robot around the block."""
    return _drive


@pytest.fixture(scope="session")
def localized():
    """Return a function that localizes the robot of a drive."""
    return _localized
