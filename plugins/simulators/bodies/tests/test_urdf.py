"""Robots on the wheels of their URDF: a cart of our own with a caster, a mesh, and one wheel mounted in reverse."""

import math
from itertools import combinations
from pathlib import Path

import attrs
import numpy as np
import pytest
from mrpbench_simulators_bodies.scene import body_of
from mrpbench_tests.fixtures.drive import EMPTY
from mrpbench_tests.fixtures.drive import drive as drive_simulator

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.state import Inputs
from mrpbench_core.model.worlds.world import Level, World
from mrpbench_core.testing.fixtures.room import PERIOD

FOLDER = Path(__file__).parent / "robots"
CART = load_robot("cart.yaml", FOLDER)


def drive(simulator, commands, seconds, starts=None, world=EMPTY, robot=CART):
    """Poses f8[T,n,3], twists f8[T,n,2] and contacts of each period."""
    robots = [robot] * len(commands)
    if starts is None:
        starts = [[20.0 * index, 1.0, 0.4] for index in range(len(commands))]
    states, _ = drive_simulator(simulator, world, robots, starts, commands, round(seconds / PERIOD))
    return (
        np.array([state.pose for state in states]),
        np.array([state.twist for state in states]),
        [state.contacts.tolist() for state in states],
    )


def test_steady_speeds_and_turns_err_as_little_as_those_of_robots_without_a_urdf(simulator):
    """Driven straight and turned in place: 0.1 % and 3e-4 rad/s, over 10 s. In tight arcs, twice that."""
    share = [(1.0, 0.0), (-0.7, 0.0), (0.0, 1.0), (0.0, -0.5), (0.9, 0.2), (0.7, -0.6), (0.95, 0.9)]
    commands = np.array(share) * (CART.max_speed, CART.max_turn_rate)
    pose, twist, contacts = drive(simulator, commands, 12)
    pose, twist = pose[40:], twist[40:]
    yaw = np.unwrap(pose[:, :, 2], axis=0)
    step, turn = np.diff(pose[:, :, :2], axis=0), np.diff(yaw, axis=0)
    heading = yaw[:-1] + turn / 2
    ahead = (step[..., 0] * np.cos(heading) + step[..., 1] * np.sin(heading)) / np.sinc(turn / (2 * np.pi))
    seconds = len(step) * PERIOD
    speed, rate = ahead.sum(axis=0) / seconds, (yaw[-1] - yaw[0]) / seconds
    assert np.abs(speed - commands[:, 0]).max() < 1e-3 * CART.max_speed
    assert np.abs(rate - commands[:, 1])[:4].max() < 3e-4
    assert np.abs(rate - commands[:, 1]).max() < 6e-4
    assert np.abs(twist.mean(axis=0) - commands).max() < 1e-3
    assert not any(contacts)


def test_a_robot_turns_about_the_middle_of_its_axle_and_stands_where_it_is_put(simulator):
    """The origin of the URDF's root link, and its centre of mass, lie elsewhere."""
    pose, _, _ = drive(simulator, [[0.0, 1.0], [0.0, 0.0]], 3)
    assert np.allclose(pose[0], [[0, 1, 0.4], [20, 1, 0.4]], atol=1e-6)
    assert np.abs(pose[:, 0, :2] - [0, 1]).max() < 2e-3
    assert np.allclose(pose[:, 1], [20, 1, 0.4], atol=5e-4)


def test_the_origin_of_the_root_link_does_not_matter(simulator, tmp_path):
    """A cart whose URDF counts from its front left corner, on the floor, is the same cart."""
    text = (FOLDER / "cart.urdf").read_text()
    moved = text.replace(
        '<link name="base_link">',
        '<link name="corner"/><joint name="corner_joint" type="fixed"><parent link="corner"/><child link="base_link"/>'
        '<origin xyz="-0.18 -0.13 0.06"/></joint><link name="base_link">',
    )
    (tmp_path / "cart.urdf").write_text(moved)
    (tmp_path / "cap.obj").write_bytes((FOLDER / "cap.obj").read_bytes())
    (tmp_path / "cart.yaml").write_text((FOLDER / "cart.yaml").read_text())
    command = [[0.3, 0.6]]
    same, other = (drive(simulator, command, 5, robot=robot)[0] for robot in (CART, load_robot("cart.yaml", tmp_path)))
    assert np.allclose(same, other, atol=5e-3)


def test_wheels_that_stand_out_and_parts_above_the_body_touch_walls(simulator):
    """The wheels' outer faces lie 0.165 m beside the middle, the body's sides 0.13 m; the front is 0.18 m ahead."""
    ahead = World(name="wall", levels=(Level(name="L1", walls=[[1.0, -2, 1.0, 2]]),))
    thickness = 0.05
    pose, twist, contacts = drive(simulator, [[0.3, 0.0]], 4, [[0, 0, 0]], ahead)
    assert contacts[-1] == [[0, -1]]
    assert pose[-1, 0, 0] == pytest.approx(1 - thickness - 0.18, abs=0.01)
    assert abs(twist[-20:, 0, 0].mean()) < 0.02
    for gap, touches in ((0.155, True), (0.175, False)):
        beside = World(name="wall", levels=(Level(name="L1", walls=[[0.6, gap + thickness, 2.0, gap + thickness]]),))
        _, _, contacts = drive(simulator, [[0.3, 0.0]], 4, [[0, 0, 0]], beside)
        assert any(contacts) == touches


def test_robots_of_both_sorts_meet(simulator):
    fleet = Fleet(robots=(CART, load_robot("turtlebot3_burger")))
    with simulator.open(EMPTY, fleet, np.array([[0, 0, 0], [0.8, 0, math.pi]]), 0, PERIOD) as simulation:
        for _ in range(60):
            state = simulation.step(Inputs(twist=np.array([[0.2, 0.0], [0.2, 0.0]])))
    assert state.contacts.tolist() == [[0, 1]]


def test_two_runs_agree_to_the_last_bit(simulator):
    random = np.random.default_rng(3).uniform(-1, 1, (40, 2))

    def wander():
        with simulator.open(EMPTY, Fleet(robots=(CART,)), np.zeros((1, 3)), 0, PERIOD) as simulation:
            return [simulation.step(Inputs(twist=command[None])).pose.tobytes() for command in random]

    assert wander() == wander()


def test_a_body_larger_than_the_footprint_is_refused():
    narrow = attrs.evolve(CART, footprint=CART.footprint * (1.0, 0.8))
    with pytest.raises(InputError, match=r"'\w+_wheel_joint' stands out 0\.029 m beyond the footprint"):
        body_of(narrow)
    short = attrs.evolve(CART, footprint=CART.footprint * (0.5, 1.0))
    with pytest.raises(InputError, match=r"'base_link' stands out 0\.\d+ m beyond the footprint of cart"):
        body_of(short)


BODY = '<box size="0.40 0.26 0.12"/>'
CORNERS = np.array([(x, y, z) for x in (-0.2, 0.2) for y in (-0.13, 0.13) for z in (-0.06, 0.06)])
TRIANGLES = CORNERS[list(combinations(range(8), 3))]
"""Triangles whose convex hull is the body; 24 of them lie on its faces."""


WORLD = '<link name="world"/><joint name="j" type="fixed"><parent link="world"/><child link="base_link"/></joint>'


def changed(folder, *changes):
    """The cart with changes (old, new) of its URDF."""
    text = (FOLDER / "cart.urdf").read_text()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    (folder / "cart.urdf").write_text(text)
    for name in ("cap.obj", "cart.yaml"):
        (folder / name).write_bytes((FOLDER / name).read_bytes())
    return load_robot("cart.yaml", folder)


def stl(header=b"", after=b""):
    records = b"".join(bytes(12) + corners.astype("<f4").tobytes() + bytes(2) for corners in TRIANGLES)
    return header.ljust(80) + len(TRIANGLES).to_bytes(4, "little") + records + after


def stl_text():
    facets = [
        "facet normal 0 0 0\n outer loop\n"
        + "".join(f"  vertex {x:e} {y:e} {z:e}\n" for x, y, z in corners)
        + " endloop\nendfacet\n"
        for corners in TRIANGLES
    ]
    return ("solid body\n" + "".join(facets) + "endsolid body\n").encode()


def obj():
    lines = [f"v {x} {y} {z}" for x, y, z in CORNERS]
    lines += [f"f {a + 1}//1 {b - 8} {c + 1}" for a, b, c in combinations(range(8), 3)]
    return "\n".join(lines).encode()


def dae(primitive="triangles"):
    indices = " ".join(str(corner) for corners in combinations(range(8), 3) for corner in corners)
    return f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
      <library_geometries><geometry id="g"><mesh>
        <source id="p"><float_array id="a" count="24">{" ".join(map(str, CORNERS.ravel()))}</float_array>
          <technique_common><accessor source="#a" count="8" stride="3"/></technique_common></source>
        <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
        <{primitive} count="56"><input semantic="VERTEX" source="#v" offset="0"/><p>{indices}</p></{primitive}>
      </mesh></geometry></library_geometries>
      <library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene>
      </library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>""".encode()


MOVED = b"""<node id="n"><translate>0 0 7</translate><rotate>0 0 1 90</rotate><scale>0.5 1 1</scale></node>
  <node id="m"><matrix>0 1 0 0  -1 0 0 0  0 0 1 0  0 0 0 1</matrix><rotate>0 0 2 90</rotate>"""
"""Transforms of nodes; those of the second, which has the body, cancel one another."""


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("body.stl", stl()),
        ("body.STL", stl(b"solid by an exporter")),
        ("body.stl", stl(after=b"colours")),
        ("body.stl", stl_text()),
        ("body.Stl", stl_text().upper().replace(b"\n", b"\r\n")),
        ("body.obj", obj()),
        ("body.dae", dae()),
        ("body.DAE", dae("polylist").replace(b"<node>", MOVED)),
    ],
)
def test_a_mesh_of_any_kind_is_solid(simulator, tmp_path, name, content):
    (tmp_path / name).write_bytes(content)
    robot = changed(tmp_path, (BODY, f'<mesh filename="{name}" scale="-1 1 1"/>'))
    ahead = World(name="wall", levels=(Level(name="L1", walls=[[0.5, -2, 0.5, 2]]),))
    pose, _, contacts = drive(simulator, [[0.4, 0.0]], 2, [[0, 0, 0]], ahead, robot)
    assert contacts[-1] == [[0, -1]]
    assert pose[-1, 0, 0] == pytest.approx(0.5 - 0.05 - 0.18, abs=0.01)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("body.xyz", b"nothing", r"body\.xyz: this mesh cannot be read \(meshes must be \.obj, \.stl or \.dae\)"),
        ("body.stl", b"", r"body\.stl: is not an STL"),
        ("body.stl", stl()[:200], "is not an STL"),
        ("body.stl", bytes(84), "is not an STL"),
        ("body.stl", b"solid nothing\nendsolid", "has no triangles"),
        ("body.stl", stl_text().replace(b"vertex 2.0", b"vertex x2.0", 1), "vertex that is not three finite numbers"),
        ("body.stl", stl().replace(CORNERS[:1].astype("<f4").tobytes(), b"\xff" * 12), "not three finite numbers"),
        ("body.obj", obj().partition(b"f ")[0], r"body\.obj: has no faces"),
        ("body.obj", obj() + b"\nf 1 2 9", "a face has the vertex '9' of 8"),
        ("body.obj", obj() + b"\nf 1 2 0", "a face has the vertex '0' of 8"),
        ("body.dae", b"<COLLADA/>", r"body\.dae: has no triangles"),
        ("body.dae", dae()[:-9], "is not XML"),
        ("body.dae", dae("lines"), "has no triangles"),
        ("body.dae", dae().replace(b'id="p"', b'id="q"'), "has nothing with the id 'p'"),
        ("body.dae", dae().replace(b"<p>", b"<p>8 "), "a face has a corner beyond its 8 points"),
        ("body.dae", dae().replace(b"<p>", b"<p>x "), "has 'x 0 1 2 .*' instead of finite numbers"),
        ("body.dae", dae().replace(b"POSITION", b"COLOR"), "has faces without positions"),
        ("body.dae", dae().replace(b"instance_geometry", b"instance_camera"), "has no triangles"),
    ],
)
def test_a_mesh_that_cannot_be_read_is_one_line(tmp_path, name, content, message):
    (tmp_path / name).write_bytes(content)
    robot = changed(tmp_path, (BODY, f'<mesh filename="{name}"/>'))
    with pytest.raises(InputError, match=message) as caught:
        body_of(robot)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (BODY, "", r"cart\.urdf:10: a collision of the link 'base_link' has no shape \(shapes: box, sphere"),
        (BODY, '<ellipsoid size="1 1 1"/>', "has the shape 'ellipsoid'"),
        (BODY, "<box/>", "the size of a box of the link 'base_link' is not positive"),
        (BODY, '<box size="0.4 0.2"/>', "size='0.4 0.2' of a 'box' must be 3 numbers"),
        (BODY, '<box size="0.4,0.2,0.1"/>', "must be 3 numbers"),
        (BODY, '<box size="0.4 -0.2 0.1"/>', "the size of a box of the link 'base_link' is not positive"),
        (BODY, '<cylinder radius="0.1"/>', "the length of a cylinder of the link 'base_link' is not positive"),
        ("0.001 0.001 0.001", "0.001", "scale='0.001' of a 'mesh' must be 3 numbers"),
        ("0.001 0.001 0.001", "0.001 0 0.001", "the scale of a mesh of the link 'cap' is 0"),
        ("-0.02 0 0.03", "-0.02 0", "xyz='-0.02 0' of a 'origin' must be 3 numbers"),
        ('rpy="0 0 0.3"', 'rpy="x"', "rpy='x' of a 'origin' must be 3 numbers"),
        ('mass value="0.6"', 'mass value="-0.6"', "the mass of the link 'left_wheel' is negative"),
        ('mass value="8"', 'mass value="0"', "only its driven wheels have mass"),
        ('ixx="0.08"', 'ixx="light"', "ixx='light' of a 'inertia' must be a number"),
    ],
)
def test_a_wrong_value_is_one_line(tmp_path, old, new, message):
    with pytest.raises(InputError, match=message):
        body_of(changed(tmp_path, (old, new)))


SUSPENSION = """<link name="strut"/>
  <joint name="suspension" type="prismatic"><parent link="base_link"/><child link="strut"/></joint>
  <joint name="left_wheel_joint" type="continuous">"""


@pytest.mark.parametrize(
    "change",
    [
        ('name="cart"', ""),
        ('<link name="caster">', '<drake:member link="cap"/><link name="caster">'),
        ('<joint name="left_wheel_joint" type="continuous">', SUSPENSION),
        ("left_wheel", "left'][wheel"),
        ('<joint name="caster_joint" type="fixed">', '<joint name="caster_joint" type="floating">'),
        ('<joint name="cap_joint" type="fixed">', '<joint name="cap_joint" type="revolute">'),
        ('ixy="0" ixz="0" iyz="0"', ""),
        (
            '<link name="base_link">',
            WORLD.replace("/>", "><inertial><mass value='0'/></inertial></link>", 1) + '<link name="base_link">',
        ),
        ('<link name="base_link">', f'{WORLD}<link name="base_link">'),
    ],
)
def test_what_is_sound_in_other_urdfs_drives(simulator, tmp_path, change):
    changes = [change, ('child link="left_wheel"', 'child link="left\'][wheel"')][: 2 if "][" in change[1] else 1]
    pose, _, _ = drive(simulator, [[0.4, 0.0]], 2, [[0, 0, 0]], robot=changed(tmp_path, *changes))
    assert pose[-1, 0, 0] == pytest.approx(0.8 - 0.4**2 / 2, abs=0.02)


HIGH = ("-0.02 0 0.03", "-0.02 0 0.15")
"""Lifts the body of the cart, so that only its caster is near the floor."""


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (
            [("-0.16 0 -0.029", "-0.16 0 -0.045")],
            r"'caster' reaches 0\.015 m into the floor \(with all other joints at",
        ),
        ([HIGH, ("-0.16 0 -0.029", "-0.16 0 0.1")], r"nothing behind the axle is near the floor, .* \(add the coll"),
        ([HIGH, ('"-0.02 0 0.02"', '"0.02 0 0.02"')], "nothing in front of the axle is near the floor"),
        ([HIGH, ('"-0.02 0 0.02"', '"-0.004 0 0.02"')], "nothing in front of the axle is near the floor"),
    ],
)
def test_a_robot_that_does_not_stand_on_its_wheels_is_refused(tmp_path, changes, message):
    body_of(changed(tmp_path, HIGH))
    with pytest.raises(InputError, match=message):
        body_of(changed(tmp_path, *changes))


def test_a_wheel_radius_that_is_not_that_of_the_wheels_mesh_is_refused(tmp_path):
    """The wheel is a box that reaches 0.06 m down from its axle."""
    wheel, mesh = '<cylinder radius="0.06" length="0.03"/>', '<mesh filename="wheel.obj" scale="0.3 0.4615 0.2"/>'
    (tmp_path / "wheel.obj").write_bytes(obj())
    (tmp_path / "cap.obj").write_bytes((FOLDER / "cap.obj").read_bytes())
    (tmp_path / "cart.urdf").write_text((FOLDER / "cart.urdf").read_text().replace(wheel, mesh))
    robot = (FOLDER / "cart.yaml").read_text()
    (tmp_path / "cart.yaml").write_text(robot + "wheel_radius: 0.063\n")
    body_of(load_robot("cart.yaml", tmp_path))
    (tmp_path / "cart.yaml").write_text(robot + "wheel_radius: 0.1\n")
    with pytest.raises(InputError, match=r"'left_wheel_joint' reaches 0\.06 m down .*, but wheel_radius is 0\.1 "):
        body_of(load_robot("cart.yaml", tmp_path))


@pytest.mark.parametrize("shape", ["box", "mesh"])
@pytest.mark.parametrize("lower", [0.03, 0.035])
def test_wheels_bear_the_weight_of_a_body_that_is_drawn_down_to_the_floor(simulator, tmp_path, lower, shape):
    """Its bottom is level with the floor, or 5 mm beneath it, as in the URDFs of sold robots."""
    (tmp_path / "body.obj").write_bytes(obj())
    changes = [("-0.02 0 0.03", f"-0.02 0 {0.03 - lower}"), (BODY, '<mesh filename="body.obj"/>')]
    robot = changed(tmp_path, *changes[: 1 if shape == "box" else 2])
    pose, _, _ = drive(simulator, [[0.4, 0.8]], 4, [[0, 0, 0]], robot=robot)
    turned = np.unwrap(pose[:, 0, 2])
    assert (turned[-1] - turned[-21]) / (20 * PERIOD) == pytest.approx(0.8, abs=0.01)


@pytest.mark.parametrize("name", ["07-urdf-two-roots-segv/u14.yaml", "08-urdf-ascii-stl/u07b.yaml"])
def test_urdfs_that_crashed_or_stood_drive_or_are_refused(simulator, shared_data, name):
    file = shared_data / "cases" / name
    if name.startswith("07"):
        with pytest.raises(InputError, match=r"u14\.urdf: has 2 root links, 'base_link', 'world'"):
            load_robot(file.name, file.parent)
        return
    pose, _, _ = drive(simulator, [[0.4, 0.0]], 2, [[0, 0, 0]], robot=load_robot(file.name, file.parent))
    assert pose[-1, 0, 0] > 0.6
