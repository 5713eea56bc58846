"""Scenes of MuJoCo: MJCF, as `mujoco.MjModel.from_xml_path` loads it (mujoco.readthedocs.io, "XML Reference").

Robots have a free joint, two driven wheels with velocity actuators `robot_i_left` and `robot_i_right` (radians per
second), and a site `robot_i_lidar`. Leaves of doors have a joint that is 0 when they are shut.
"""

from xml.etree import ElementTree as ET

import numpy as np
from mrpbench_simulators_bodies.body import MOTOR_LAG, ROTOR, WHEEL_CONTACT

from mrpbench_world.formats.meshes import mesh
from mrpbench_world.formats.xml import numbers, opaque
from mrpbench_world.scene import Scene
from mrpbench_world.solids import BLUE, GREY, LEAF_MASS, STEP_S, WOOD, Leaf, PlacedRobot, Prism


def write_mjcf(scene: Scene) -> str:
    """Return the text of a model."""
    root = ET.Element("mujoco", model=scene.name)
    ET.SubElement(root, "compiler", angle="radian", autolimits="true")
    ET.SubElement(root, "option", timestep=str(STEP_S), integrator="implicitfast")
    ET.SubElement(root, "size", memory="400M")
    asset = ET.SubElement(root, "asset")
    world, actuator = ET.SubElement(root, "worldbody"), ET.SubElement(root, "actuator")
    ET.SubElement(world, "light", pos="0 0 10", dir="-0.5 0.2 -1", directional="true")
    for prism in (*scene.floors, *scene.walls):
        _geom(world, asset, prism, GREY)
    for leaf in scene.leaves:
        _door(world, asset, leaf)
    for robot in scene.robots:
        _robot(world, asset, actuator, robot)
    ET.indent(root)
    return f"{ET.tostring(root, encoding='unicode')}\n"


def _geom(parent: ET.Element, asset: ET.Element, prism: Prism, colour: tuple[float, float, float], **more: str) -> None:
    """A box, or the hull of the corners."""
    if (box := prism.box) is not None:
        middle, sides, yaw = box
        place = {"pos": numbers(*middle), "euler": numbers(0, 0, yaw), "size": numbers(*(sides / 2))}
        ET.SubElement(parent, "geom", {"name": prism.name, "type": "box", "rgba": opaque(colour), **place, **more})
        return
    ET.SubElement(asset, "mesh", name=prism.name, vertex=numbers(*mesh(prism)[0].ravel()))
    ET.SubElement(
        parent, "geom", {"name": prism.name, "type": "mesh", "mesh": prism.name, "rgba": opaque(colour), **more}
    )


def _door(world: ET.Element, asset: ET.Element, leaf: Leaf) -> None:
    body = ET.SubElement(world, "body", name=leaf.name, gravcomp="1")
    joint = {"name": f"{leaf.name}_joint", "damping": "5"}
    axis, upper = leaf.axis
    joint |= {"type": "slide" if leaf.hinge is None else "hinge", "axis": numbers(*axis), "range": numbers(0, upper)}
    if leaf.hinge is not None:
        joint["pos"] = numbers(*leaf.hinge, leaf.prism.bottom)
    ET.SubElement(body, "joint", joint)
    # Leaves hang in their frame: they touch robots, not the floor, walls or each other.
    _geom(body, asset, leaf.prism, WOOD, mass=numbers(LEAF_MASS), contype="2", conaffinity="0")


def _robot(world: ET.Element, asset: ET.Element, actuator: ET.Element, robot: PlacedRobot) -> None:
    model, (x, y, yaw) = robot.model, robot.pose
    place = {"pos": numbers(x, y, robot.elevation), "euler": numbers(0, 0, yaw)}
    body = ET.SubElement(world, "body", {"name": robot.name, **place})
    ET.SubElement(body, "freejoint", name=f"{robot.name}_base")
    rigid = robot.rigid
    moments = numbers(*np.diag(rigid.inertia))
    ET.SubElement(body, "inertial", pos=numbers(*rigid.centre), mass=numbers(rigid.mass), diaginertia=moments)
    glides = {"friction": "0 0 0", "condim": "1", "priority": "1", "contype": "3", "conaffinity": "3"}
    for prism in robot.body():
        named = Prism(name=f"{robot.name}_{prism.name}", base=prism.base, bottom=prism.bottom, top=prism.top)
        _geom(body, asset, named, BLUE, **glides)
    for middle, radius in robot.casters():
        ET.SubElement(body, "geom", {"type": "sphere", "size": numbers(radius), "pos": numbers(*middle)} | glides)
    solref, solimp = (numbers(*values) for values in WHEEL_CONTACT)
    for side, rolling in zip(("left", "right"), rigid.wheels, strict=True):
        wheel = ET.SubElement(body, "body", name=f"{robot.name}_{side}_wheel", pos=numbers(*rolling.place))
        joint = f"{robot.name}_{side}_joint"
        rotor = numbers(ROTOR * model.mass * rolling.radius**2)
        ET.SubElement(wheel, "joint", name=joint, type="hinge", axis="0 1 0", armature=rotor)
        sphere = {"type": "sphere", "size": numbers(rolling.radius), "mass": numbers(rolling.mass)}
        ET.SubElement(wheel, "geom", sphere | {"priority": "1", "solref": solref, "solimp": solimp})
        motor = {"kv": numbers(model.mass / 2 * rolling.radius**2 / MOTOR_LAG)}
        limit = {"forcerange": numbers(-rigid.torque, rigid.torque)}
        ET.SubElement(actuator, "velocity", {"name": f"{robot.name}_{side}", "joint": joint} | motor | limit)
    if model.lidar is not None:
        ET.SubElement(body, "site", name=f"{robot.name}_lidar", pos=numbers(*model.lidar.mount), size="0.01")
