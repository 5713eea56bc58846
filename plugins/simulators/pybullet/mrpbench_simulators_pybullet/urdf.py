"""A robot as its URDF describes it, on wheels that drive as accurately as those of robots without a URDF.

PyBullet loads a copy of the URDF in which each driven wheel touches the floor as a sphere of its radius: a cylinder's
contact wanders over its width, and turns err by a percent. The wheel's own shape meets everything but the floor.
Everything else that touches the floor, such as casters, has no friction. Visual shapes are removed, joints that are not
driven are fixed, and links without mass get a mass close to zero, since PyBullet would give them a kilogram, or fix the
robot to the world. PyBullet fails silently, so the URDF is checked before, and its shapes are counted after.
"""

import tempfile
import xml.etree.ElementTree as ET
from copy import deepcopy
from pathlib import Path

import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.urdf import DifferentialDrive, drive_of, mesh_files, read_urdf
from mrpbench_core.model.common.fleet import RobotModel, Urdf
from mrpbench_simulators_pybullet.bullet import Bullet, Group
from mrpbench_simulators_pybullet.links import check_links
from mrpbench_simulators_pybullet.meshes import readable_mesh
from mrpbench_simulators_pybullet.wheeled_body import Transform, WheeledBody

_GUARD = "guard of "
"""Prefix of the name of a link that has the shape of a wheel."""
_BEYOND = 0.01
"""metres by which a body may stand out beyond the footprint that planners keep free."""
_UPRIGHT = (0.0, 0.0, 0.0, 1.0)
_NO_MASS = {
    "mass": {"value": "1e-6"},
    "inertia": {"ixx": "1e-9", "iyy": "1e-9", "izz": "1e-9", "ixy": "0", "ixz": "0", "iyz": "0"},
}


def load_described(bullet: Bullet, robot: RobotModel, urdf: Urdf, x: float, y: float, yaw: float) -> WheeledBody:
    """Put a robot on the floor.

    Raises:
        InputError: PyBullet cannot load the URDF, or the body is larger than the footprint.
    """
    file = Path(urdf.file)
    description = read_urdf(file)
    drive = drive_of(description, urdf)
    check_links(description, urdf.wheels, file)
    with tempfile.TemporaryDirectory() as folder:
        _prepare(description, file, urdf, robot.wheel_radius, Path(folder))
        copy = Path(folder) / "robot.urdf"
        ET.ElementTree(description).write(copy, encoding="utf-8")
        try:
            body: int = bullet.loadURDF(str(copy))
        except bullet.module.error:
            raise InputError("PyBullet cannot load this URDF", file=file) from None
    about = [bullet.getJointInfo(body, index) for index in range(bullet.getNumJoints(body))]
    joints = {entry[1].decode(): entry[0] for entry in about}
    wheels = (joints[urdf.wheels[0]], joints[urdf.wheels[1]])
    root = bullet.getBodyInfo(body)[0].decode()
    links = {root: -1} | {entry[12].decode(): entry[0] for entry in about}
    _count_shapes(bullet, body, links, description, file)
    links = {name: link for name, link in links.items() if link not in wheels}
    _set_contacts(bullet, body, links, wheels)
    driven = WheeledBody(body=body, joints=wheels, signs=drive.signs, base=_base(bullet, body, robot, drive))
    _put(bullet, driven, 0.0, 0.0, 0.0)
    _check_size(bullet, body, links, robot, file)
    _put(bullet, driven, x, y, yaw)
    return driven


def _prepare(description: ET.Element, file: Path, urdf: Urdf, radius: float, folder: Path) -> None:
    """Change the URDF for PyBullet; `folder` keeps files that it names."""
    description.set("name", "robot")
    meshes = mesh_files(description, file)
    ready = {name: str(readable_mesh(mesh.resolve(), folder)) for name, mesh in meshes.items()}
    for mesh in description.iterfind("link/collision/geometry/mesh"):
        mesh.set("filename", ready[mesh.get("filename", "")])
    links = {link.get("name"): link for link in description.iterfind("link")}
    joints = {joint.get("name"): joint for joint in description.iterfind("joint")}
    for link in links.values():
        for look in link.findall("visual"):
            link.remove(look)
        _complete_mass(link)
    for name, joint in joints.items():
        if name not in urdf.wheels:
            joint.set("type", "fixed")
            continue
        child = joint.find("child")
        assert child is not None
        wheel = links[child.get("link")]
        _guard(description, wheel, joint)
        shape = ET.SubElement(ET.SubElement(wheel, "collision"), "geometry")
        ET.SubElement(shape, "sphere", radius=repr(radius))


def _guard(description: ET.Element, wheel: ET.Element, joint: ET.Element) -> None:
    """Move the shapes of a wheel to a link of their own that does not turn with it."""
    shapes = wheel.findall("collision")
    name = f"{_GUARD}{joint.get('name')}"
    guard = ET.SubElement(description, "link", name=name)
    for shape in shapes:
        wheel.remove(shape)
        guard.append(shape)
    _complete_mass(guard)
    fixed = deepcopy(joint)
    child = fixed.find("child")
    assert child is not None
    fixed.set("name", name)
    fixed.set("type", "fixed")
    child.set("link", name)
    description.append(fixed)


def _complete_mass(link: ET.Element) -> None:
    """Give a link without mass or inertia negligible ones."""
    inertial = link.find("inertial")
    inertial = ET.SubElement(link, "inertial") if inertial is None else inertial
    for name, values in _NO_MASS.items():
        part = inertial.find(name)
        part = ET.SubElement(inertial, name) if part is None else part
        for key, value in values.items():
            if key not in part.attrib or (key == "value" and not float(part.attrib[key])):
                part.set(key, value)


def _count_shapes(bullet: Bullet, body: int, links: dict[str, int], description: ET.Element, file: Path) -> None:
    for link in description.iterfind("link"):
        name = link.get("name", "")
        wanted, found = len(link.findall("collision")), len(bullet.getCollisionShapeData(body, links[name]))
        if found != wanted:
            raise InputError(
                f"PyBullet reads {found} of the {wanted} collision shapes of {name.removeprefix(_GUARD)!r}",
                file=file,
                hint="save its meshes as .obj or .stl",
            )


def _set_contacts(bullet: Bullet, body: int, links: dict[str, int], wheels: tuple[int, int]) -> None:
    common = {"restitution": 0, "linearDamping": 0, "angularDamping": 0, "jointDamping": 0}
    for wheel in wheels:
        bullet.assign(body, wheel, Group.WHEELS)
        bullet.changeDynamics(body, wheel, lateralFriction=1, **common)
    for name, link in links.items():
        bullet.assign(body, link, Group.GUARDS if name.startswith(_GUARD) else Group.BODIES)
        bullet.changeDynamics(body, link, lateralFriction=0, contactProcessingThreshold=0, **common)


def _base(bullet: Bullet, body: int, robot: RobotModel, drive: DifferentialDrive) -> Transform:
    """The robot's base frame, on the floor below the middle of the axle, seen from the root link's centre of mass."""
    x, y, z = drive.axle
    centre = bullet.getDynamicsInfo(body, -1)[3:5]
    base: Transform = bullet.multiplyTransforms(
        *bullet.invertTransform(*centre), (x, y, z - robot.wheel_radius), _UPRIGHT
    )
    return base


def _put(bullet: Bullet, driven: WheeledBody, x: float, y: float, yaw: float) -> None:
    assert driven.base is not None
    upright = bullet.getQuaternionFromEuler((0.0, 0.0, yaw))
    there = bullet.multiplyTransforms((x, y, 0.0), upright, *bullet.invertTransform(*driven.base))
    bullet.resetBasePositionAndOrientation(driven.body, *there)


def _check_size(bullet: Bullet, body: int, links: dict[str, int], robot: RobotModel, file: Path) -> None:
    """Refuse a body, with its base frame at the origin, that stands out beyond an edge of the footprint."""
    names = {link: name for name, link in links.items()}
    along = np.roll(robot.footprint, -1, axis=0) - robot.footprint
    for x, y in (np.column_stack([along[:, 1], -along[:, 0]]) / np.hypot(*along.T)[:, None]).tolist():
        limit = float((robot.footprint @ (x, y)).max()) + _BEYOND
        shape = bullet.createCollisionShape(bullet.module.GEOM_PLANE, planeNormal=(-x, -y, 0.0))
        plane = bullet.createMultiBody(baseCollisionShapeIndex=shape, basePosition=(limit * x, limit * y, 0.0))
        for point in bullet.getClosestPoints(body, plane, 0.0):
            if point[3] in names:
                part = names[point[3]].removeprefix(_GUARD)
                out = f"{part!r} stands out {_BEYOND - point[8]:.3f} m beyond the footprint"
                raise InputError(f"{out} of {robot.name}", file=file, hint="planners rely on the footprint")
        bullet.removeBody(plane)
