"""Files for MuJoCo: they load, robots stand and drive, and doors open."""

import math

import numpy as np
import pytest
from mrpbench_world.formats.mjcf import write_mjcf
from mrpbench_world.scene import robots_of, scene_of

mujoco = pytest.importorskip("mujoco")


@pytest.fixture
def simulation(recording):
    text = write_mjcf(scene_of(recording.context().world, robots_of(recording)))
    model = mujoco.MjModel.from_xml_string(text)
    return model, mujoco.MjData(model)


def test_a_robot_drives_as_fast_as_its_wheels_turn(simulation, recording):
    model, data = simulation
    robot = robots_of(recording)[1]
    base = model.body(robot.name).id
    for side in ("left", "right"):
        data.actuator(f"{robot.name}_{side}").ctrl = 0.2 / robot.model.wheel_radius
    steps = round(1.0 / model.opt.timestep)
    for _ in range(steps):
        mujoco.mj_step(model, data)
    before = data.xpos[base].copy()
    for _ in range(steps):
        mujoco.mj_step(model, data)
    moved = data.xpos[base] - before
    assert moved[0] == pytest.approx(0.2, abs=0.01)
    assert abs(moved[1]) < 0.005
    assert data.xmat[base].reshape(3, 3)[2, 2] > math.cos(math.radians(1))  # it stays upright


def test_robots_that_are_not_driven_stand_still(simulation, recording):
    model, data = simulation
    for _ in range(round(2.0 / model.opt.timestep)):
        mujoco.mj_step(model, data)
    for robot in robots_of(recording):
        here = data.xpos[model.body(robot.name).id]
        np.testing.assert_allclose(here, (*robot.pose[:2], robot.elevation), atol=2e-3)


def test_doors_reach_their_open_leaves(room):
    model = mujoco.MjModel.from_xml_string(write_mjcf(scene_of(room)))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.ncon == 0  # leaves touch neither the floor nor each other
    for name, shut, opened in (("swing", (3.0, 1.45), (3.45, 1.0)), ("slide", (3.0, 2.45), (3.0, 3.35))):
        geom, joint = model.geom(f"L1_{name}_0").id, model.joint(f"L1_{name}_0_joint")
        mujoco.mj_forward(model, data)
        np.testing.assert_allclose(data.geom_xpos[geom][:2], shut, atol=1e-6)
        data.qpos[joint.qposadr[0]] = joint.range[1]
        mujoco.mj_forward(model, data)
        np.testing.assert_allclose(data.geom_xpos[geom][:2], opened, atol=1e-6)
