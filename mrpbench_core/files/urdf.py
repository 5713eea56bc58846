"""Read robots with two driven wheels from URDF files, with one line for each error.

Only wheels, masses and collision shapes of the format (wiki.ros.org/urdf/XML) are read.
"""

import math
import xml.etree.ElementTree as ET
from pathlib import Path

import attrs
import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.files.text import position, read_text
from mrpbench_core.files.xml import line_of, parse_xml
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Urdf

JOINTS = ("fixed", "continuous", "revolute", "prismatic", "floating", "planar")
_RIGID = ("fixed", "prismatic")
"""Types of joints between the body and a driven wheel: a suspension is rigid."""
_ALIGNED = 0.999
"""Least cosine of the angle between the axis of a wheel and the y axis of the robot."""
_SAME = 1e-3
"""Largest offset of the wheels from a common axle, metres."""


@attrs.frozen(kw_only=True)
class DifferentialDrive:
    """The driven wheels, in the frame of the root link: x forward, y left, z up."""

    axle: tuple[float, float, float]
    """The middle of the axle, metres."""
    separation: float
    radius: float | None
    """None if the wheels have no collision shape, or a mesh."""
    signs: tuple[int, int]
    """1 if a positive speed of the joint drives forward, -1 if backward; left, then right."""
    mass: float
    """Mass of all links, kilogram."""


def read_urdf(file: Path) -> ET.Element:
    """Read the element `robot` of a URDF.

    Raises:
        InputError: it cannot be read, or is not a URDF.
    """
    text = read_text(file)
    robot = parse_xml(text, file, "a URDF")
    if robot.tag != "robot":
        raise InputError(f"is not a URDF: its root is {robot.tag!r} instead of 'robot'", file=file)
    if "xacro" in text and any("xacro" in element.tag for element in robot.iter()):
        where = position(text, text.index("<xacro"))[0] if "<xacro" in text else None
        raise InputError("is xacro", file=file, line=where, hint="expand it first: xacro FILE > robot.urdf")
    _check_tree(robot, file)
    return robot


def _check_tree(robot: ET.Element, file: Path) -> None:
    """Check that the joints make one tree of the links."""
    links, joints = (_named(robot, tag, file) for tag in ("link", "joint"))
    above: dict[str, ET.Element] = {}
    for name, joint in joints.items():
        if joint.get("type") not in JOINTS:
            kinds = f"types: {', '.join(JOINTS)}"
            raise _error(f"the joint {name!r} has the type {joint.get('type', '')!r}", file, joint, kinds)
        for role in ("parent", "child"):
            if (link := _link(joint, role)) not in links:
                hint = did_you_mean(link, links, f"links: {', '.join(links)}")
                raise _error(f"the {role} of the joint {name!r} is {link!r}, not a link", file, joint, hint)
        first = above.setdefault(link, joint)
        if first is not joint:
            raise _error(f"the joints {first.get('name')!r} and {name!r} have one child, {link!r}", file, joint)
    roots = [link for link in links if link not in above]
    if len(roots) > 1:
        listed = ", ".join(map(repr, roots))
        raise InputError(f"has {len(roots)} root links, {listed}", file=file, hint="joints should connect all links")
    rooted = set(roots)
    for link in links:
        way: set[str] = set()
        while link not in rooted:
            if link in way:
                raise _error(f"the joint {above[link].get('name')!r} is its own ancestor", file, above[link])
            way.add(link)
            link = _link(above[link], "parent")
        rooted |= way


def _named(robot: ET.Element, tag: str, file: Path) -> dict[str, ET.Element]:
    """Return the elements with a tag by their names."""
    elements: dict[str, ET.Element] = {}
    for element in robot.iterfind(tag):
        name = element.get("name", "")
        if not name or name in elements:
            raise _error(f"has two {tag}s {name!r}" if name else f"has a {tag} without a name", file, element)
        elements[name] = element
    return elements


def mesh_files(robot: ET.Element, file: Path) -> dict[str, Path]:
    """Return the file of each collision mesh, by its name in the URDF.

    Names are relative to the URDF. `package://NAME/...` is searched in every folder above the URDF that is
    called NAME or has a subfolder NAME.

    Raises:
        InputError: a file is missing.
    """
    meshes = {}
    for mesh in robot.iterfind("link/collision/geometry/mesh"):
        name = mesh.get("filename", "")
        places = _places(name, file)
        existing = [place for place in places if place.is_file()]
        if not existing:
            raise _error(f"the mesh {name!r} is missing", file, mesh, f"looked for {places[-1]}")
        meshes[name] = existing[0]
    return meshes


def _places(name: str, file: Path) -> list[Path]:
    if not name.startswith("package://"):
        return [file.parent / name.removeprefix("file://")]
    package, _, rest = name.removeprefix("package://").partition("/")
    above = file.resolve().parents
    return [folder / package / rest for folder in above] + [folder / rest for folder in above if folder.name == package]


def drive_of(robot: ET.Element, urdf: Urdf) -> DifferentialDrive:
    """Return the driven wheels that `urdf` names.

    Raises:
        InputError: there are no such joints, or they do not form a differential drive.
    """
    file = Path(urdf.file)
    joints = {joint.get("name", ""): joint for joint in robot.iterfind("joint")}
    above = {_link(joint, "child"): joint for joint in joints.values()}
    places, signs, radii = [], [], []
    for name in urdf.wheels:
        if name not in joints:
            turning = [other for other, joint in joints.items() if joint.get("type") == "continuous"]
            hint = did_you_mean(name, joints, f"continuous joints: {', '.join(turning) or 'none'}")
            raise InputError(f"has no joint {name!r}", file=file, hint=hint)
        joint = joints[name]
        if joint.get("type") != "continuous":
            wrong = f"the wheel joint {name!r} is {joint.get('type')!r} instead of 'continuous'"
            raise _error(wrong, file, joint, "a driven wheel turns without limits")
        frame = _frame(joint, above, file)
        axis = frame[:3, :3] @ numbers(joint.find("axis"), "xyz", (1.0, 0.0, 0.0), file)
        if abs(axis[1]) < _ALIGNED * np.linalg.norm(axis) or not axis.any():
            turn = ", ".join(f"{value:.2g}" for value in axis)
            wrong = f"the wheel joint {name!r} turns about ({turn}) of the root link, not about its y axis"
            raise _error(wrong, file, joint, "the root link should have x forward and y left")
        places.append(frame[:3, 3])
        signs.append(1 if axis[1] > 0 else -1)
        radii.append(_radius(robot, _link(joint, "child"), file))
    left, right = places
    if left[1] - right[1] < _SAME:
        raise InputError(f"{urdf.wheels[0]!r} is not to the left of {urdf.wheels[1]!r}", file=file)
    if abs(left[0] - right[0]) > _SAME or abs(left[2] - right[2]) > _SAME:
        raise InputError(f"the wheels {' and '.join(urdf.wheels)} are not on one axle", file=file)
    if len(set(radii)) > 1:
        raise InputError(f"the wheels {' and '.join(urdf.wheels)} have different sizes", file=file)
    mass = sum(float(numbers(link, "value", (0.0,), file)[0]) for link in robot.iterfind("link/inertial/mass"))
    if mass <= 0:
        raise InputError("its links have no mass", file=file)
    middle = ((left + right) / 2).tolist()
    return DifferentialDrive(
        axle=(middle[0], middle[1], middle[2]),
        separation=float(left[1] - right[1]),
        radius=radii[0],
        signs=(signs[0], signs[1]),
        mass=mass,
    )


def _frame(joint: ET.Element, above: dict[str, ET.Element], file: Path) -> Float:
    """The pose f8[4,4] of a joint in the frame of the root link."""
    frame = joint_frame(joint, file)
    while (upper := above.get(_link(joint, "parent"))) is not None:
        joint = upper
        if joint.get("type") not in _RIGID:
            wrong = f"a driven wheel is attached to the joint {joint.get('name')!r}, which moves"
            raise _error(wrong, file, joint, "steered wheels and legs with wheels are not simulated")
        frame = joint_frame(joint, file) @ frame
    return frame


def joint_frame(element: ET.Element, file: Path) -> Float:
    """Return the pose f8[4,4] that the `origin` of a joint, a collision or an inertial gives."""
    origin = element.find("origin")
    roll, pitch, yaw = numbers(origin, "rpy", (0.0, 0.0, 0.0), file).tolist()
    frame = np.eye(4)
    about_x = np.array([[1, 0, 0], [0, math.cos(roll), -math.sin(roll)], [0, math.sin(roll), math.cos(roll)]])
    about_y = np.array([[math.cos(pitch), 0, math.sin(pitch)], [0, 1, 0], [-math.sin(pitch), 0, math.cos(pitch)]])
    about_z = np.array([[math.cos(yaw), -math.sin(yaw), 0], [math.sin(yaw), math.cos(yaw), 0], [0, 0, 1]])
    frame[:3, :3] = about_z @ about_y @ about_x
    frame[:3, 3] = numbers(origin, "xyz", (0.0, 0.0, 0.0), file)
    return frame


def _radius(robot: ET.Element, link: str, file: Path) -> float | None:
    named = (it for it in robot.iterfind("link") if it.get("name") == link)  # no predicate takes all names
    for shape in (shape for it in named for shape in it.iterfind("collision/geometry/*")):
        if shape.tag in ("sphere", "cylinder"):
            return float(numbers(shape, "radius", (0.0,), file)[0])
    return None


def _link(joint: ET.Element, role: str) -> str:
    element = joint.find(role)
    return "" if element is None else element.get("link", "")


def numbers(element: ET.Element | None, name: str, default: tuple[float, ...], file: Path) -> Float:
    """Return an attribute that has as many finite numbers as `default`."""
    text = None if element is None else element.get(name)
    if text is None or element is None:
        return np.array(default)
    try:
        values = np.array(text.split(), float)
    except ValueError:
        values = np.empty(0)
    if len(values) != len(default) or not np.isfinite(values).all():
        wanted = "a number" if len(default) == 1 else f"{len(default)} numbers"
        hint = "expand it with xacro" if "$" in text else None
        raise _error(f"{name}={text!r} of a {element.tag!r} must be {wanted}", file, element, hint)
    return values


def _error(message: str, file: Path, element: ET.Element, hint: str | None = None) -> InputError:
    return InputError(message, file=file, line=line_of(element), hint=hint)
