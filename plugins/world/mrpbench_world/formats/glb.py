"""Scenes as binary glTF 2.0, for Blender, three.js and Foxglove. glTF has y up; robots stand where they begin."""

from pathlib import Path

import numpy as np

from mrpbench_world.formats.libraries import library
from mrpbench_world.formats.meshes import mesh
from mrpbench_world.scene import Scene
from mrpbench_world.solids import BLUE, GREY, WOOD


def write_glb(scene: Scene, file: Path) -> None:
    """Write a scene with one node for each solid and each robot.

    Raises:
        InputError: trimesh is not installed.
    """
    trimesh = library("trimesh", "glb")
    written = trimesh.Scene()
    solids = [*scene.floors, *scene.walls]
    for prism, colour in (*((it, GREY) for it in solids), *((leaf.prism, WOOD) for leaf in scene.leaves)):
        corners, triangles = mesh(prism)
        part = trimesh.Trimesh(corners, triangles, process=False, face_colors=_bytes(colour))
        written.add_geometry(part, node_name=prism.name, geom_name=prism.name)
    for robot in scene.robots:
        x, y, yaw = robot.pose
        placed = np.eye(4)
        placed[:2, :2] = [[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]]
        placed[:3, 3] = x, y, robot.elevation
        for prism in robot.body():
            corners, triangles = mesh(prism)
            part = trimesh.Trimesh(corners, triangles, process=False, face_colors=_bytes(BLUE))
            name = f"{robot.name}_{prism.name}"
            written.add_geometry(part, node_name=name, geom_name=name, transform=placed)
    written.apply_transform(np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], float))
    file.write_bytes(written.export(file_type="glb"))


def _bytes(colour: tuple[float, float, float]) -> tuple[int, ...]:
    """A colour as red, green, blue and alpha from 0 to 255."""
    return (*(min(255, int(256 * value)) for value in colour), 255)
