"""Files of glTF: closed meshes, y up."""

import numpy as np
import pytest
from mrpbench_world.formats.glb import write_glb
from mrpbench_world.scene import robots_of, scene_of

trimesh = pytest.importorskip("trimesh")


def test_meshes_are_closed_and_as_large_as_the_world(recording, tmp_path):
    world, robots = recording.context().world, robots_of(recording)
    scene = scene_of(world, robots)
    write_glb(scene, tmp_path / "run.glb")
    read = trimesh.load(tmp_path / "run.glb")
    assert len(read.geometry) == len(scene.walls) + len(scene.floors) + len(scene.leaves) + sum(
        len(robot.body()) for robot in robots
    )
    assert all(part.is_watertight and part.volume > 0 for part in read.geometry.values())
    low, high = read.bounds
    assert (low[1], high[1]) == pytest.approx((-0.1, 2.5))  # from below the floor to the top of walls
    solid = np.vstack([prism.base for prism in (*scene.floors, *scene.walls)])
    assert (low[0], high[0]) == pytest.approx((solid[:, 0].min(), solid[:, 0].max()))
    assert (-high[2], -low[2]) == pytest.approx((solid[:, 1].min(), solid[:, 1].max()))
