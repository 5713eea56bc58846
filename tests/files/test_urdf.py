import math
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mrpbench_core.files import urdf
from mrpbench_core.files.codec import decode, encode
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot, robot_reads
from mrpbench_core.model.common.fleet import RobotModel

ROBOT = """\
name: cart
footprint: [[0.3, -0.2], [0.3, 0.2], [-0.3, 0.2], [-0.3, -0.2]]
max_speed: 1
max_turn_rate: 1.5
urdf:
  file: cart.urdf
  wheels: [left, right]
"""
LEFT = '<parent link="axle"/><child link="left_wheel"/><origin xyz="0 0.2 0" rpy="-1.5708 0 0"/><axis xyz="0 0 1"/>'
RIGHT = '<parent link="axle"/><child link="right_wheel"/><origin xyz="0 -0.2 0" rpy="1.5708 0 0"/><axis xyz="0 0 1"/>'
WHEEL = '<inertial><mass value="0.5"/></inertial><collision><geometry><cylinder radius="0.1" length="0.05"/></geometry>'
URDF = f"""\
<robot name="cart">
  <link name="base"><inertial><mass value="9"/></inertial></link>
  <link name="axle"/>
  <joint name="turned" type="fixed"><parent link="base"/><child link="axle"/><origin xyz="0 0 0.1"/></joint>
  <link name="left_wheel">{WHEEL}</collision></link>
  <link name="right_wheel">{WHEEL}</collision></link>
  <joint name="left" type="continuous">{LEFT}</joint>
  <joint name="right" type="continuous">{RIGHT}</joint>
</robot>
"""


def load(folder, urdf=URDF, robot=ROBOT):
    (folder / "cart.yaml").write_text(robot)
    if urdf is not None:
        (folder / "cart.urdf").write_text(urdf)
    return load_robot("cart.yaml", folder)


def test_mass_and_wheels_are_those_of_the_urdf(tmp_path):
    robot = load(tmp_path)
    assert (robot.mass, robot.wheel_radius) == (10, 0.1)
    assert robot.wheel_separation == pytest.approx(0.4)
    assert (robot.urdf.file, robot.urdf.wheels) == (str(tmp_path / "cart.urdf"), ("left", "right"))


def test_a_prefix_need_not_be_declared_and_a_suspension_is_rigid(tmp_path):
    urdf = URDF.replace('<link name="axle"/>', '<link name="axle"/><drake:joint name="turned"/>')
    assert load(tmp_path, urdf.replace('type="fixed"', 'type="prismatic"')).wheel_separation == pytest.approx(0.4)


def test_names_of_links_may_have_quotes_and_brackets(tmp_path):
    robot = load(tmp_path, URDF.replace("left_wheel", "left'][wheel"))
    assert (robot.mass, robot.wheel_radius) == (10, 0.1)


@pytest.mark.parametrize("turn", [0.3, -1.2, math.pi])
def test_fixed_joints_on_the_way_to_a_wheel_are_followed_with_their_turns(tmp_path, turn):
    """An axle that is turned about x and y stays where it is when its wheels' own frames undo the turn."""
    there = f'<origin xyz="0 0 0.1" rpy="0 {turn} 0"/>'
    back = f'<origin xyz="0 0.2 0" rpy="0 {-turn} 0"/><axis xyz="0 1 0"/>'
    urdf = URDF.replace('<origin xyz="0 0 0.1"/>', there)
    urdf = urdf.replace('<origin xyz="0 0.2 0" rpy="-1.5708 0 0"/><axis xyz="0 0 1"/>', back)
    assert load(tmp_path, urdf).wheel_separation == pytest.approx(0.4)


def test_an_origin_turns_about_fixed_axes_first_by_roll_then_pitch_then_yaw():
    turns = (0.4, -0.9, 2.0)
    joint = ET.fromstring(f'<joint><origin xyz="1 2 3" rpy="{turns[0]} {turns[1]} {turns[2]}"/></joint>')
    frame = urdf.joint_frame(joint, Path("cart.urdf"))
    np.testing.assert_allclose(frame[:3, :3], Rotation.from_euler("xyz", turns).as_matrix(), atol=1e-12)
    assert frame[:, 3].tolist() == [1, 2, 3, 1]


def test_the_radius_of_a_wheel_that_is_a_mesh_stands_in_the_robots_file(tmp_path):
    (tmp_path / "tyre.stl").write_text("solid")
    urdf = URDF.replace('<cylinder radius="0.1" length="0.05"/>', '<mesh filename="tyre.stl"/>')
    with pytest.raises(InputError, match="wheel_radius is missing: the wheels of the URDF are not spheres"):
        load(tmp_path, urdf)
    robot = load(tmp_path, urdf, ROBOT + "wheel_radius: 0.12\n")
    assert (robot.wheel_radius, robot.wheel_separation) == (0.12, pytest.approx(0.4))


def test_a_package_is_found_above_the_urdf(tmp_path):
    urdf = tmp_path / "ws" / "cart_description" / "urdf"
    mesh = tmp_path / "ws" / "cart_description" / "meshes" / "hull.stl"
    urdf.mkdir(parents=True)
    mesh.parent.mkdir()
    mesh.write_text("solid")
    hull = '<collision><geometry><mesh filename="package://cart_description/meshes/hull.stl"/></geometry></collision>'
    load(urdf, URDF.replace('<link name="axle"/>', f'<link name="axle">{hull}</link>'))
    assert robot_reads(urdf / "cart.yaml") == (urdf / "cart.urdf", mesh)


def test_a_robot_without_a_urdf_and_one_with_mistakes_read_nothing_else(tmp_path):
    load(tmp_path, robot=ROBOT.partition("urdf:")[0])
    assert robot_reads(tmp_path / "cart.yaml") == ()
    (tmp_path / "cart.yaml").write_text(ROBOT.replace("left", "lft"))
    assert robot_reads(tmp_path / "cart.yaml") == ()


def test_recordings_do_not_tell_where_a_urdf_lies(tmp_path):
    robot, kept = load(tmp_path), {}

    def keep(array):
        kept["array"] = array
        return "array"

    data = encode(robot, keep)
    assert "urdf" not in data
    again = decode(data, RobotModel, kept.get)
    assert again.urdf is None
    assert (again.mass, again.wheel_radius) == (robot.mass, robot.wheel_radius)
    assert np.array_equal(again.footprint, robot.footprint)


@pytest.mark.parametrize(
    ("urdf", "message"),
    [
        (None, r"cart\.urdf: no such file"),
        (URDF.replace("</robot>", ""), r"cart\.urdf:10:1: is not XML: no element found$"),
        ("<sdf/>", "is not a URDF: its root is 'sdf'"),
        ('<!DOCTYPE robot [<!ENTITY a "b">]>' + URDF, "has a DOCTYPE"),
        (
            URDF.replace('<link name="axle"/>', '<xacro:axle xmlns:xacro="http://www.ros.org/wiki/xacro"/>'),
            r"cart\.urdf:3: is xacro \(expand it first",
        ),
        (URDF.replace('name="left"', 'name="lef"'), r"has no joint 'left' \(did you mean 'lef'\?\)"),
        (URDF.replace('name="left"', 'name="port"'), r"has no joint 'left' \(continuous joints: port, right\)"),
        (
            URDF.replace('"left" type="continuous"', '"left" type="revolute"'),
            r"cart\.urdf:7: the wheel joint 'left' is 'revolute' instead of 'continuous' \(a driven wheel turns",
        ),
        (
            URDF.replace('type="fixed"', 'type="revolute"'),
            r"cart\.urdf:4: a driven wheel is attached to the joint 'turned', which moves \(steered wheels and",
        ),
        (
            URDF.replace('<parent link="base"/>', '<parent link="left_wheel"/>'),
            "the joint '(turned|left)' is its own ancestor",
        ),
        (
            URDF.replace('"axle"/>', '"axle"/><link name="world"/>', 1),
            "has 2 root links, 'base', 'world' .joints should",
        ),
        (URDF.replace('"axle"/>', '"axle"/><link name="axle"/>', 1), "has two links 'axle'"),
        (URDF.replace('"turned"', '"left"'), "has two joints 'left'"),
        (URDF.replace(' name="turned"', ""), "has a joint without a name"),
        (URDF.replace('"fixed"', '"weld"'), r"the joint 'turned' has the type 'weld' \(types: fixed, continuous"),
        (URDF.replace(' type="fixed"', ""), "the joint 'turned' has the type ''"),
        (
            URDF.replace('parent link="base"', 'parent link="bse"'),
            r"'turned' is 'bse', not a link \(did you mean 'base'",
        ),
        (URDF.replace('<child link="axle"/>', ""), "the child of the joint 'turned' is '', not a link"),
        (
            URDF.replace('child link="right_wheel"', 'child link="left_wheel"'),
            "the joints 'left' and 'right' have one child, 'left_wheel'",
        ),
        (URDF.replace('rpy="-1.5708 0 0"', ""), r"'left' turns about \(0, 0, 1\)"),
        (URDF.replace('<axis xyz="0 0 1"/>', '<axis xyz="0 0 0"/>'), r"'left' turns about \(0, 0, 0\)"),
        (URDF.replace("0 0.2 0", "0 -0.3 0"), "'left' is not to the left of 'right'"),
        (URDF.replace("0 0.2 0", "0.1 0.2 0"), "the wheels left and right are not on one axle"),
        (URDF.replace('radius="0.1"', 'radius="0.2"', 1), "have different sizes"),
        (
            URDF.replace('radius="0.1"', 'radius="wide"', 1),
            r"cart\.urdf:5: radius='wide' of a 'cylinder' must be a",
        ),
        (URDF.replace('xyz="0 0 0.1"', 'xyz="$(arg x) 0 0"'), r"must be 3 numbers \(expand it with xacro\)"),
        (URDF.replace('xyz="0 0.2 0"', 'xyz="0 0.2"'), "xyz='0 0.2' of a 'origin' must be 3 numbers"),
        (URDF.replace('value="9"', 'value="0"').replace('value="0.5"', 'value="0"'), "its links have no mass"),
        (
            URDF.replace('<cylinder radius="0.1" length="0.05"/>', '<mesh filename="tyre.stl"/>'),
            r"the mesh 'tyre\.stl' is missing \(looked for .*tyre\.stl\)",
        ),
    ],
)
def test_a_mistake_in_a_urdf_is_one_line(tmp_path, urdf, message):
    with pytest.raises(InputError, match=message) as caught:
        load(tmp_path, urdf)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("robot", "line", "message"),
    [
        (ROBOT + "mass: 3\n", 8, r"the URDF already gives mass = 10 \(remove it here\)"),
        (ROBOT + "wheel_radius: 0.2\n", 8, "the URDF already gives wheel_radius = 0.1"),
        (ROBOT.replace("[left, right]", "left"), 7, "must be the joints of two wheels"),
        (ROBOT.replace("wheels: [left, right]", ""), 6, "wheels is missing"),
        (ROBOT.replace("file: cart.urdf", "file: 3"), 6, "must be a file's name"),
        (ROBOT.replace("file", "fil"), 6, r"unknown key 'fil' \(did you mean 'file'\?\)"),
        (ROBOT.partition("urdf:")[0] + "urdf: cart.urdf\n", 5, "must be a mapping"),
    ],
)
def test_a_mistake_about_a_urdf_says_where(tmp_path, robot, line, message):
    with pytest.raises(InputError, match=message) as caught:
        load(tmp_path, robot=robot)
    assert caught.value.line == line
