"""A file with every part of the format, and its relatives of other years and coordinates: loaded, or refused."""

from pathlib import Path

import numpy as np
import pytest
from mrpbench_world.facts import check_world
from mrpbench_worlds_standard.rmf import Rmf

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet, RobotModel

FILE = Path(__file__).parent / "everything.building.yaml"
TEXT = FILE.read_text()


@pytest.fixture(scope="module")
def fleet():
    corners = 0.12 * np.array([[1, 0], [0, 1], [-1, 0], [0, -1]])
    return Fleet(robots=(RobotModel(name="disc", footprint=corners, max_speed=0.2, max_turn_rate=1.0),))


def test_every_part_is_read(fleet):
    world = Rmf(file=FILE).load()
    assert [(level.name, level.elevation) for level in world.levels] == [("G", 0.0), ("1", 3.5), ("attic", 7.0)]
    assert world.levels[0].walls[:4].tolist() == [[0, 0, 16, 0], [16, 0, 16, -8], [16, -8, 0, -8], [0, -8, 0, 0]]
    doors = {door.name: door for door in world.levels[0].doors}
    named = ["hinged", "double_hinged", "sliding", "double_sliding", "telescope"]
    assert {name: door.motion for name, door in doors.items()} == {name: name for name in named} | {
        "7": "double_telescope"
    }
    swing = doors["double_hinged"]
    assert (swing.motion_direction, swing.motion_degrees, swing.right_left_ratio) == (1, 80.0, 1.5)
    assert doors["hinged"].motion_direction == -1
    assert doors["telescope"].motion_axis == "end"
    lanes = world.lanes
    assert [lane.graph for lane in lanes] == [0, 0, 0, 0, 0, 3]
    assert [lane.mutex for lane in lanes] == ["aisle", *[""] * 5]
    assert [lane.orientation for lane in lanes] == ["", "forward", "backward", "", "", ""]
    assert lanes[1].speed_limit == 0.25
    assert lanes[1].door == "double_sliding"
    assert [vertex.name for vertex in world.vertices] == ["305", "42", "pick up", "", "", "upstairs", "305", "pick up"]
    assert world.vertices[1].parameters["merge_radius"] == 0.4
    (lift,) = world.lifts
    assert {world.levels[level].name for level in lift.levels} == {"G", "1"}
    assert [vertex.lift for vertex in world.vertices] == ["", "", "", "hoist", "hoist", "", "", ""]
    assert len(world.levels[0].holes) == len(world.levels[0].floors) == len(world.levels[0].obstacles) == 1
    assert sorted(world.notes) == [
        "human lanes are not supported: 1 left out.",
        "lane of a graph above 8 is left out, as RMF does.",
        "lane with orientation backward is driven forward, like all lanes.",
        "model 'Nobody/KnowsThis' has no known footprint and is not an obstacle (option footprints).",
    ]
    roadmap = Graph().build(world, fleet)
    kinds = {resource.name: resource.kind for resource in roadmap.resources}
    assert kinds == {"aisle": "mutex", "crossing": "mutex", "double_sliding": "door", "hoist": "lift"}
    facts = check_world(world, roadmap, 0.12)
    assert (facts.levels, facts.lifts, facts.doors) == (3, 1, 6)
    assert roadmap.place[[0, 5]].min() >= 0


def test_levels_that_are_drawn_to_another_scale_are_aligned():
    """Level 1 has 25 pixels to the metre where G has 50; both show the lift where it is."""
    world = Rmf(file=FILE).load()
    stops = [(vertex.x, vertex.y) for vertex in world.vertices if vertex.lift]
    assert stops == [pytest.approx((14.0, -2.0)), pytest.approx((14.0, -2.0))]


def test_every_level_is_drawn(tmp_path):
    pytest.importorskip("matplotlib")
    from mrpbench_core.cli.main import main

    assert main(["world", str(FILE), "--render", str(tmp_path / "map.png")]) == 0
    assert {file.name for file in tmp_path.iterdir()} == {"map.png", "map-1.png", "map-attic.png"}


@pytest.mark.parametrize(
    ("old", "new"),
    [
        pytest.param("name: everything\n", "building_name: everything\n", id="name of the first editors"),
        pytest.param("coordinate_system: reference_image\n", "", id="before there were coordinate systems"),
        pytest.param("map_version: 2\n", "", id="without a version"),
        pytest.param(
            "graphs:\n  0: {name: carts}\n  3: {name: cleaners}\n", "graphs:\n  {}\n", id="graphs without names"
        ),
        pytest.param("enable: 1", "enable: 0", id="crowd switched off"),
        pytest.param("\n", "\r\n", id="Windows line ends"),
        pytest.param("    layers: {}\n", "    layers:\n      {}\n", id="braces on a line of their own"),
        pytest.param("[0, 0, 1, 0.5]", "blue", id="colours by name"),
    ],
)
def test_relatives_load_alike(tmp_path, old, new):
    file = tmp_path / "everything.building.yaml"
    assert old in TEXT
    file.write_bytes(TEXT.replace(old, new).encode())
    world, known = Rmf(file=file).load(), Rmf(file=FILE).load()
    assert world.name == "everything"
    assert (world.vertices, world.lanes, world.lifts) == (known.vertices, known.lanes, known.lifts)


@pytest.mark.parametrize("system", ["cartesian_meters", "wgs84"])
def test_metres_and_degrees_load_and_make_a_grid(tmp_path, fleet, system):
    """A yard of 20 m by 12 m."""
    x, y, unit = 0.0, 0.0, 1.0
    more = ""
    if system == "wgs84":
        pytest.importorskip("pyproj")
        x, y, unit = 103.78, 1.3, 1 / 111_000
        more = (
            "parameters: {generate_crs: [1, EPSG:3414], suggested_offset_x: [3, 22000], suggested_offset_y: [3, 31500]}"
        )
    corners = [(x + unit * dx, y + unit * dy) for dx, dy in ((0, 0), (20, 0), (20, 12), (0, 12), (3, 6), (17, 6))]
    vertices = "\n".join(f"    - [{a!r}, {b!r}, 0, v{index}]" for index, (a, b) in enumerate(corners))
    file = tmp_path / "yard.building.yaml"
    file.write_text(
        f"name: yard\ncoordinate_system: {system}\n{more}\nlevels:\n  L1:\n    vertices:\n{vertices}\n"
        "    walls: [[0, 1], [1, 2], [2, 3], [3, 0]]\n    lanes: [[4, 5, {bidirectional: [4, true]}]]\n"
    )
    world = Rmf(file=file).load()
    roadmap = GridRoadmap().build(world, fleet)
    assert 1200 < len(roadmap.position) < 1500  # 20 m x 12 m in cells of 0.4 m
    start, end = world.vertices
    assert end.x - start.x == pytest.approx(14, rel=0.02)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("coordinate_system: reference_image", "coordinate_system: web_mercator", ":2:20: coordinate_system"),
        ("level_doors:\n      1: [front]", "level_doors:\n      2: [front]", "no level '2'"),
        ("G: [front]", "G: [back]", "opens the door 'back' on level 'G'"),
        ("width: 1.6", "width: 0", "width should be positive"),
        ("[16, 17, {bidirectional: [4, true], demo", "[16, 99, {bidirectional: [4, true], demo", "lane to vertex 99"),
        ("reference_floor_name: G", "reference_floor_name: [G]", "should be text"),
        ("elevation: 3.5", "elevation: high", "should be a number"),
    ],
)
def test_a_mistake_is_one_line_with_its_place(tmp_path, old, new, message):
    file = tmp_path / "everything.building.yaml"
    assert old in TEXT
    file.write_text(TEXT.replace(old, new, 1))
    with pytest.raises(InputError) as caught:
        Rmf(file=file).load()
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith(f"{file}:")
