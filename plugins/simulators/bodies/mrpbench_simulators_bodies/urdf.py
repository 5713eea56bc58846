"""Robots on the wheels of their URDF, as rigid bodies.

Links are solid by their collision shapes; joints other than those of the driven wheels do not move. A driven wheel
touches the floor as a sphere, and everything else with its own shape, which does not turn.
"""

import xml.etree.ElementTree as ET
from pathlib import Path

import attrs
import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.urdf import drive_of, joint_frame, mesh_files, numbers, read_urdf
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel, Urdf
from mrpbench_simulators_bodies.body import RobotBody, Shape, Wheel, hull
from mrpbench_simulators_bodies.links import SHAPES, check_links
from mrpbench_simulators_bodies.meshes import mesh_objects
from mrpbench_simulators_bodies.stance import above_floor, check_stance

_BEYOND = 0.01
"""metres by which a body may stand out beyond the footprint that planners keep free."""
_ONE = (1.0, 1.0, 1.0)


def described_body(robot: RobotModel, urdf: Urdf) -> RobotBody:
    """Read the body of a robot.

    Raises:
        InputError: the URDF or one of its meshes is wrong, or the body is larger than the footprint or does not
            stand on its wheels.
    """
    file = Path(urdf.file)
    description = read_urdf(file)
    drive = drive_of(description, urdf)
    check_links(description, urdf.wheels, file)
    reader = _Reader(description, file, urdf)
    x, y, z = drive.axle
    reader.base[:3, 3] = -x, -y, robot.wheel_radius - z
    body = reader.body(robot.wheel_radius)
    _check_size(body, robot, file)
    check_stance(body, robot, file)
    return attrs.evolve(body, shapes=above_floor(body.shapes))


@attrs.define
class _Mass:
    """Point masses and moments of inertia, added up."""

    mass: float = 0.0
    moment: Float = attrs.field(factory=lambda: np.zeros(3))
    """f8[3] mass times place."""
    inertia: Float = attrs.field(factory=lambda: np.zeros((3, 3)))
    """f8[3,3] about the origin."""

    def add(self, mass: float, place: Float, inertia: Float) -> None:
        self.mass += mass
        self.moment = self.moment + mass * place
        self.inertia = self.inertia + inertia + mass * _steiner(place)

    def about_centre(self) -> tuple[Float, Float]:
        """The centre of mass f8[3], and the inertia f8[3,3] about it."""
        centre = self.moment / self.mass
        return centre, self.inertia - self.mass * _steiner(centre)


class _Reader:
    def __init__(self, description: ET.Element, file: Path, urdf: Urdf) -> None:
        self._file, self._wheels = file, urdf.wheels
        self._links = {link.get("name", ""): link for link in description.iterfind("link")}
        self._meshes = mesh_files(description, file)
        joints = list(description.iterfind("joint"))
        self._above = {_name(joint, "child"): joint for joint in joints}
        self._objects: dict[str, list[Float]] = {}
        self.base = np.eye(4)
        """f8[4,4] the pose of the root link in the base frame."""

    def body(self, radius: float) -> RobotBody:
        frames = {name: self._frame(name) for name in self._links}
        wheel_of = {name: self._wheel_above(name) for name in self._links}
        shapes: list[Shape] = []
        rest, turning = _Mass(), {name: _Mass() for name in self._wheels}
        for name, link in self._links.items():
            wheel = wheel_of[name]
            for collision in link.iterfind("collision"):
                shapes += self._shapes(collision, frames[name], wheel or name, wheel is None)
            mass, place, inertia = self._mass(link, frames[name])
            (rest if wheel is None else turning[wheel]).add(mass, place, inertia)
        centre, inertia = rest.about_centre()
        left, right = (self._wheel(name, frames, turning[name], radius) for name in self._wheels)
        return RobotBody(shapes=tuple(shapes), mass=rest.mass, centre=centre, inertia=inertia, wheels=(left, right))

    def _wheel(self, joint: str, frames: dict[str, Float], mass: _Mass, radius: float) -> Wheel:
        child = next(link for link, above in self._above.items() if above.get("name") == joint)
        x, y, z = frames[child][:3, 3].tolist()
        heavy = max(mass.mass, 1e-6)
        about = _Mass(heavy, mass.moment, mass.inertia).about_centre()[1]
        least = 1e-9 + 0.1 * heavy * radius**2
        across, along = max(float(about[0, 0] + about[2, 2]) / 2, least), max(float(about[1, 1]), least)
        return Wheel(place=(x, y, z), radius=radius, mass=heavy, inertia=(across, min(along, 2 * across)))

    def _frame(self, link: str) -> Float:
        """The pose f8[4,4] of a link in the base frame, all joints being at 0."""
        frame = np.eye(4)
        while (joint := self._above.get(link)) is not None:
            frame = joint_frame(joint, self._file) @ frame
            link = _name(joint, "parent")
        placed: Float = self.base @ frame
        return placed

    def _wheel_above(self, link: str) -> str | None:
        """The driven joint that a link turns with."""
        while (joint := self._above.get(link)) is not None:
            if (name := joint.get("name", "")) in self._wheels:
                return name
            link = _name(joint, "parent")
        return None

    def _shapes(self, collision: ET.Element, link: Float, part: str, floor: bool) -> list[Shape]:
        geometry = next(iter(collision.iterfind("geometry/*")))
        frame = link @ joint_frame(collision, self._file)
        if geometry.tag == "mesh":
            scale = numbers(geometry, "scale", _ONE, self._file)
            return [
                Shape(kind="hull", points=hull(points * scale), frame=frame, part=part, touches_floor=floor)
                for points in self._mesh(geometry.get("filename", ""))
            ]
        size: list[float] = []
        for name, count in SHAPES[geometry.tag].items():
            size += numbers(geometry, name, (0.0,) * count, self._file).tolist()
        kind: str = geometry.tag
        return [Shape(kind=kind, size=tuple(size), frame=frame, part=part, touches_floor=floor)]  # type: ignore[arg-type]

    def _mesh(self, name: str) -> list[Float]:
        if name not in self._objects:
            self._objects[name] = mesh_objects(self._meshes[name].resolve())
        return self._objects[name]

    def _mass(self, link: ET.Element, frame: Float) -> tuple[float, Float, Float]:
        """Mass, place f8[3] and inertia f8[3,3] in the base frame."""
        inertial = link.find("inertial")
        if inertial is None:
            return 0.0, np.zeros(3), np.zeros((3, 3))
        placed = frame @ joint_frame(inertial, self._file)
        mass = float(numbers(inertial.find("mass"), "value", (0.0,), self._file)[0])
        entries = {
            name: float(numbers(inertial.find("inertia"), name, (0.0,), self._file)[0])
            for name in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
        }
        inertia = np.array(
            [
                (entries["ixx"], entries["ixy"], entries["ixz"]),
                (entries["ixy"], entries["iyy"], entries["iyz"]),
                (entries["ixz"], entries["iyz"], entries["izz"]),
            ]
        )
        turn = placed[:3, :3]
        return mass, placed[:3, 3], turn @ inertia @ turn.T


def _steiner(place: Float) -> Float:
    """The inertia f8[3,3] of a kilogram at a place f8[3]."""
    apart: Float = (place @ place) * np.eye(3) - np.outer(place, place)
    return apart


def _name(joint: ET.Element, role: str) -> str:
    element = joint.find(role)
    return "" if element is None else element.get("link", "")


def _check_size(body: RobotBody, robot: RobotModel, file: Path) -> None:
    """Refuse a body that stands out beyond an edge of the footprint."""
    along = np.roll(robot.footprint, -1, axis=0) - robot.footprint
    outward = np.column_stack([along[:, 1], -along[:, 0]]) / np.hypot(*along.T)[:, None]
    for shape in body.shapes:
        out = (shape.corners()[:, :2] @ outward.T).max(axis=0) - (robot.footprint @ outward.T).max(axis=0)
        if (worst := float(out.max())) > _BEYOND:
            raise InputError(
                f"{shape.part!r} stands out {worst:.3f} m beyond the footprint of {robot.name}",
                file=file,
                hint="planners rely on it; its origin is midway between the driven wheels",
            )
