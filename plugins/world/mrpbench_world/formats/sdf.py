"""Worlds of Gazebo: SDF 1.10 (sdformat.org/spec), with the system plugins of Gazebo Harmonic and later.

Walls, obstacles and floors are static models, doors are models whose leaves have a joint, robots have two driven
wheels (`gz-sim-diff-drive-system`), a caster without friction and a lidar (`gpu_lidar`). Robot i has the topics
`/robot_i/cmd_vel`, `/robot_i/odom` and `/robot_i/scan`.
"""

import math
import re
from collections.abc import Iterable
from xml.etree import ElementTree as ET

import numpy as np
from mrpbench_simulators_bodies.body import Wheel

from mrpbench_world.formats.xml import numbers, opaque
from mrpbench_world.scene import Scene
from mrpbench_world.solids import BLUE, GREY, LEAF_MASS, STEP_S, WOOD, Leaf, PlacedRobot, Prism

VERSION = "1.10"
SYSTEMS = (
    ("gz-sim-physics-system", "gz::sim::systems::Physics"),
    ("gz-sim-user-commands-system", "gz::sim::systems::UserCommands"),
    ("gz-sim-scene-broadcaster-system", "gz::sim::systems::SceneBroadcaster"),
    ("gz-sim-sensors-system", "gz::sim::systems::Sensors"),
)


def write_sdf(scene: Scene) -> str:
    """Return the text of a world file."""
    root = ET.Element("sdf", version=VERSION)
    world = ET.SubElement(root, "world", name=scene.name)
    physics = ET.SubElement(world, "physics", name="step", type="ignored")
    _add(physics, "max_step_size", STEP_S)
    _add(physics, "real_time_factor", 1)
    for file, name in SYSTEMS:
        system = ET.SubElement(world, "plugin", filename=file, name=name)
        if file == "gz-sim-sensors-system":
            _add(system, "render_engine", "ogre2")
    light = ET.SubElement(world, "light", name="sun", type="directional")
    _add(light, "pose", numbers(0, 0, 10, 0, 0, 0))
    _add(light, "direction", numbers(-0.5, 0.2, -1))
    _static(world, "floor", scene.floors, GREY)
    _static(world, "walls", scene.walls, GREY)
    for leaf in scene.leaves:
        _door(world, leaf)
    for robot in scene.robots:
        _robot(world, robot)
    ET.indent(root)
    return f'<?xml version="1.0"?>\n{ET.tostring(root, encoding="unicode")}\n'


def _static(world: ET.Element, name: str, prisms: Iterable[Prism], colour: tuple[float, float, float]) -> None:
    model = ET.SubElement(world, "model", name=name)
    _add(model, "static", "true")
    link = ET.SubElement(model, "link", name="link")
    for prism in prisms:
        _shapes(link, prism, colour)


def _shapes(link: ET.Element, prism: Prism, colour: tuple[float, float, float], *, frictionless: bool = False) -> None:
    """Add a prism as collision and visual."""
    for kind in ("collision", "visual"):
        shape = ET.SubElement(link, kind, name=f"{prism.name}_{kind}")
        geometry = ET.Element("geometry")
        if (box := prism.box) is not None:
            middle, sides, yaw = box
            _add(shape, "pose", numbers(*middle, 0, 0, yaw))
            _add(ET.SubElement(geometry, "box"), "size", numbers(*sides))
        else:  # a polyline is extruded from z = 0 of its shape upwards
            _add(shape, "pose", numbers(0, 0, prism.bottom, 0, 0, 0))
            polyline = ET.SubElement(geometry, "polyline")
            for point in (*prism.base, prism.base[0]):
                _add(polyline, "point", numbers(*point))
            _add(polyline, "height", prism.top - prism.bottom)
        shape.append(geometry)
        if kind == "visual":
            _material(shape, colour)
        elif frictionless:
            _without_friction(shape)


def _door(world: ET.Element, leaf: Leaf) -> None:
    """A model of one leaf, whose joint is 0 when it is shut and at its upper limit when it is open."""
    model = ET.SubElement(world, "model", name=leaf.name)
    link = ET.SubElement(model, "link", name="leaf")
    box = leaf.prism.box
    assert box is not None, "leaves are boxes"
    middle, sides, yaw = box
    inertial = ET.SubElement(link, "inertial")
    _add(inertial, "pose", numbers(*middle, 0, 0, yaw))
    squared = sides**2
    _inertia(inertial, LEAF_MASS, LEAF_MASS / 12 * (squared.sum() - squared))
    _add(link, "gravity", "false")
    _shapes(link, leaf.prism, WOOD)
    joint = ET.SubElement(model, "joint", name="joint", type="prismatic" if leaf.hinge is None else "revolute")
    _add(joint, "parent", "world")
    _add(joint, "child", "leaf")
    if leaf.hinge is not None:
        _add(joint, "pose", numbers(*leaf.hinge, leaf.prism.bottom, 0, 0, 0))
    direction, upper = leaf.axis
    axis = ET.SubElement(joint, "axis")
    _add(axis, "xyz", numbers(*direction))
    limit = ET.SubElement(axis, "limit")
    _add(limit, "lower", 0)
    _add(limit, "upper", upper)
    file, name = "gz-sim-joint-position-controller-system", "gz::sim::systems::JointPositionController"
    system = ET.SubElement(model, "plugin", filename=file, name=name)
    _add(system, "joint_name", "joint")
    _add(system, "topic", f"/{re.sub(r'[^A-Za-z0-9_]', '_', leaf.name)}/position")  # topics have no spaces


def _robot(world: ET.Element, robot: PlacedRobot) -> None:
    model, at = robot.model, robot.pose
    element = ET.SubElement(world, "model", name=robot.name)
    _add(element, "pose", numbers(at[0], at[1], robot.elevation, 0, 0, at[2]))
    base = ET.SubElement(element, "link", name="base_footprint")
    rigid = robot.rigid
    inertial = ET.SubElement(base, "inertial")
    _add(inertial, "pose", numbers(*rigid.centre, 0, 0, 0))
    _inertia(inertial, rigid.mass, np.diag(rigid.inertia))
    for prism in robot.body():
        _shapes(base, prism, BLUE, frictionless=True)
    for number, (middle, radius) in enumerate(robot.casters()):
        shape = ET.SubElement(base, "collision", name=f"caster_{number}_collision")
        _add(shape, "pose", numbers(*middle, 0, 0, 0))
        _add(ET.SubElement(ET.SubElement(shape, "geometry"), "sphere"), "radius", radius)
        _without_friction(shape)
    for side, wheel in zip(("left", "right"), rigid.wheels, strict=True):
        _wheel(element, side, wheel)
    if model.lidar is not None:
        _lidar(base, robot)
    drive = ET.SubElement(element, "plugin", filename="gz-sim-diff-drive-system", name="gz::sim::systems::DiffDrive")
    for key, value in (
        ("left_joint", "left_wheel_joint"),
        ("right_joint", "right_wheel_joint"),
        ("wheel_separation", model.wheel_separation),
        ("wheel_radius", model.wheel_radius),
        ("max_linear_velocity", model.max_speed),
        ("max_angular_velocity", model.max_turn_rate),
        ("max_linear_acceleration", model.acceleration),
        ("max_angular_acceleration", model.turn_acceleration),
        ("topic", f"/{robot.name}/cmd_vel"),
        ("odom_topic", f"/{robot.name}/odom"),
        ("frame_id", f"{robot.name}/odom"),
        ("child_frame_id", f"{robot.name}/base_footprint"),
    ):
        _add(drive, key, value)


def _wheel(model: ET.Element, side: str, wheel: Wheel) -> None:
    name = f"{side}_wheel"
    link = ET.SubElement(model, "link", name=name)
    _add(link, "pose", numbers(*wheel.place, -math.pi / 2, 0, 0))  # its z axis is the axle, to the left
    across, about = wheel.inertia
    _inertia(ET.SubElement(link, "inertial"), wheel.mass, (across, across, about))
    for kind in ("collision", "visual"):
        shape = ET.SubElement(link, kind, name=f"{name}_{kind}")
        _add(ET.SubElement(ET.SubElement(shape, "geometry"), "sphere"), "radius", wheel.radius)
    joint = ET.SubElement(model, "joint", name=f"{name}_joint", type="revolute")
    _add(joint, "parent", "base_footprint")
    _add(joint, "child", name)
    _add(ET.SubElement(joint, "axis"), "xyz", numbers(0, 0, 1))


def _lidar(link: ET.Element, robot: PlacedRobot) -> None:
    lidar = robot.model.lidar
    assert lidar is not None
    sensor = ET.SubElement(link, "sensor", name="lidar", type="gpu_lidar")
    _add(sensor, "pose", numbers(*lidar.mount, 0, 0, 0))
    _add(sensor, "topic", f"/{robot.name}/scan")
    _add(sensor, "gz_frame_id", f"{robot.name}/base_scan")
    _add(sensor, "update_rate", lidar.rate)
    element = ET.SubElement(sensor, "lidar")
    horizontal = ET.SubElement(ET.SubElement(element, "scan"), "horizontal")
    _add(horizontal, "samples", lidar.beams)
    _add(horizontal, "resolution", 1)
    _add(horizontal, "min_angle", 0)
    _add(horizontal, "max_angle", 2 * math.pi * (1 - 1 / lidar.beams))
    distance = ET.SubElement(element, "range")
    _add(distance, "min", lidar.min_range)
    _add(distance, "max", lidar.range)
    _add(sensor, "always_on", "true")


def _inertia(inertial: ET.Element, mass: float, moments: Iterable[float]) -> None:
    _add(inertial, "mass", mass)
    inertia = ET.SubElement(inertial, "inertia")
    for name, value in zip(("ixx", "iyy", "izz"), moments, strict=True):
        _add(inertia, name, value)


def _material(visual: ET.Element, colour: tuple[float, float, float]) -> None:
    material = ET.SubElement(visual, "material")
    _add(material, "ambient", opaque(colour))
    _add(material, "diffuse", opaque(colour))


def _without_friction(shape: ET.Element) -> None:
    ode = ET.SubElement(ET.SubElement(ET.SubElement(shape, "surface"), "friction"), "ode")
    _add(ode, "mu", 0)
    _add(ode, "mu2", 0)


def _add(parent: ET.Element, tag: str, value: str | float) -> None:
    ET.SubElement(parent, tag).text = value if isinstance(value, str) else numbers(value)
