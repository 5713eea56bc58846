import re
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mrpbench_worlds_standard.rmf import Rmf

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.geometry import segment_distance

BUILDING = """\
name: hut
levels:
  L1:
    elevation: 0
    measurements:
      - [0, 1, {distance: [3, 5]}]
    vertices:
      - [0, 0, 0, ""]
      - [100, 0, 0, ""]
      - [0, 100, 0, north, {is_charger: [4, true]}]
      - [50, 100, 0, 12]
      - [60, 40, 0, ""]
      - [60, 20, 0, ""]
    walls:
      - [0, 1, {alpha: [3, 1]}]
    doors:
      - [4, 5, {name: [1, gate], type: [1, hinged]}]
    lanes:
      - [3, 2, {bidirectional: [4, true], graph_idx: [2, 1], speed_limit: [3, 0.4]}]
      - [2, 3, {graph_idx: [2, 0], orientation: [1, forward], mutex: [1, m]}]
      - [3, 1, {graph_idx: [2, 0]}]
"""


def write(tmp_path: Path, text: str = BUILDING) -> Path:
    file = tmp_path / "hut.building.yaml"
    file.write_text(text)
    return file


def load(tmp_path, text=BUILDING, **options):
    return Rmf(file=write(tmp_path, text), **options).load()


def failure(tmp_path, old, new, text=BUILDING, **options) -> str:
    assert old in text
    with pytest.raises(InputError) as caught:
        load(tmp_path, text.replace(old, new), **options)
    return str(caught.value).removeprefix(f"{tmp_path}/")


def test_pixels_become_metres_with_y_up(tmp_path):
    world = load(tmp_path)
    assert world.levels[0].walls.tolist() == [[0, 0, 5, 0]]
    assert [(vertex.x, vertex.y) for vertex in world.vertices[:2]] == [(0, -5), (2.5, -5)]


def test_scale_is_the_mean_over_measurements(tmp_path):
    text = BUILDING.replace("distance: [3, 5]}]", "distance: [3, 5]}]\n      - [0, 2, {distance: [3, 15]}]")
    world = load(tmp_path, text)
    assert world.levels[0].walls.tolist() == [[0, 0, 10, 0]]
    assert any("measurements disagree" in note for note in world.notes)


def test_a_level_with_neither_drawing_nor_measurements_has_the_scale_of_the_editors_sheet(tmp_path):
    world = load(tmp_path, BUILDING.replace("    measurements:\n      - [0, 1, {distance: [3, 5]}]\n", ""))
    assert world.levels[0].walls.tolist() == [[0, 0, 5, 0]]
    assert any("0.05 m per pixel" in note for note in world.notes)


def test_cartesian_meters_are_taken_as_they_stand(tmp_path):
    text = "coordinate_system: cartesian_meters\n" + BUILDING
    assert (load(tmp_path, text).vertices[0].x, load(tmp_path, text).vertices[0].y) == (0, 100)


def test_vertices_come_graph_by_graph_in_order_of_first_use(tmp_path):
    world = load(tmp_path)
    assert [vertex.name for vertex in world.vertices] == ["north", "12", "", "12", "north"]
    assert [(lane.start, lane.end, lane.graph) for lane in world.lanes] == [(0, 1, 0), (1, 2, 0), (3, 4, 1)]


def test_lanes_keep_their_parameters(tmp_path):
    one_way, _, two_way = load(tmp_path).lanes
    assert (one_way.bidirectional, one_way.orientation, one_way.mutex, one_way.speed_limit) == (
        False,
        "forward",
        "m",
        0,
    )
    assert (two_way.bidirectional, two_way.speed_limit) == (True, 0.4)


def test_vertex_parameters_are_kept(tmp_path):
    assert load(tmp_path).vertices[0].parameters == {"is_charger": True}


@pytest.mark.parametrize("name", ["1.10", "007", "1E3", "on", "2024-10-05", "0x1F", "1_000", "True", "10:30", "-0"])
def test_names_keep_the_spelling_of_the_file(tmp_path, name):
    text = BUILDING.replace("L1:", f"{name}:").replace("north", name).replace("gate", name).replace("hut", name)
    world = load(tmp_path, text.replace("mutex: [1, m]", f"mutex: [1, {name}]"), level=name)
    assert (world.name, world.levels[0].name, world.levels[0].doors[0].name) == (name,) * 3
    assert {vertex.name for vertex in world.vertices} == {name, "12", ""}
    assert {lane.mutex for lane in world.lanes} == {name, ""}


def test_a_lane_names_the_door_it_passes(tmp_path):
    world = load(tmp_path, BUILDING.replace("[3, 1, {", "[3, 5, {"))
    assert world.levels[0].doors[0].name == "gate"
    assert world.levels[0].doors[0].motion == "hinged"
    assert [lane.door for lane in world.lanes] == ["", "gate", ""]


def test_open_doors_leave_free_doorways(tmp_path):
    text = BUILDING.replace("[3, 1, {", "[3, 5, {")
    operated, free = load(tmp_path, text), load(tmp_path, text, doors="open")
    assert free.levels[0].doors == ()
    assert [lane.door for lane in free.lanes] == ["", "", ""]
    assert (free.vertices, free.levels[0].walls.tolist()) == (operated.vertices, operated.levels[0].walls.tolist())


def test_unknown_parts_are_noted(tmp_path):
    text = BUILDING.replace("alpha: [3, 1]", "alpha: [3, 1], colour: [1, red], odd: [9, 1]") + (
        "    models: [{model_name: Throne, x: 1, y: 1}, {model_name: Throne, x: 2, y: 2}]\n"
        "    human_lanes: [1, 2, 3]\n    smell: 1\n  L2: {}\n"
    )
    notes = load(tmp_path, text, level="L1").notes
    expected = ("'colour'", "unknown type 9", "'Throne' has no known footprint", "(2 times)", ": 3 left out", "'smell'")
    for part in (*expected, "not 'L2'"):
        assert any(part in note for note in notes), part


def test_a_map_that_is_understood_has_no_notes(tmp_path):
    assert load(tmp_path).notes == ()


def test_all_levels_are_loaded_the_reference_level_first(tmp_path):
    text = BUILDING.replace("  L1:", "  L0: {elevation: -3}\n  L1:")
    world = load(tmp_path, text)
    assert [(level.name, level.elevation) for level in world.levels] == [("L0", -3), ("L1", 0)]
    assert {vertex.level for vertex in world.vertices} == {1}
    world = load(tmp_path, text + "reference_level_name: L1\n")
    assert [level.name for level in world.levels] == ["L1", "L0"]
    assert {vertex.level for vertex in world.vertices} == {0}


def test_one_level_can_be_chosen(tmp_path):
    text = BUILDING.replace("  L1:", "  L0: {}\n  L1:")
    world = load(tmp_path, text, level="L1")
    assert [level.name for level in world.levels] == ["L1"]
    assert {vertex.level for vertex in world.vertices} == {0}


def test_a_lane_from_a_vertex_to_itself_is_left_out(tmp_path):
    whole, world = (load(tmp_path, text) for text in (BUILDING, BUILDING.replace("- [3, 1, {", "- [3, 3, {")))
    assert len(world.lanes) == len(whole.lanes) - 1
    assert set(world.notes) - set(whole.notes) == {"lane from a vertex to itself is left out."}


def test_floors_and_holes_are_kept(tmp_path):
    text = BUILDING + "    floors: [{vertices: [0, 1, 2], parameters: {}}]\n    holes: [{vertices: [0, 2, 3]}]\n"
    (level,) = load(tmp_path, text).levels
    assert [area.polygon.tolist() for area in level.floors] == [[[0, 0], [5, 0], [0, -5]]]
    assert [area.polygon.tolist() for area in level.holes] == [[[0, 0], [0, -5], [2.5, -5]]]
    assert "hole to vertex 9" in failure(tmp_path, "[0, 2, 3]", "[0, 2, 9]", text)
    world = load(tmp_path, text.replace("[0, 1, 2], p", "[0, 1], p"))
    assert world.levels[0].floors == ()
    assert world.notes == ("floor with fewer than three vertices is left out.",)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[3, 1, {", "[3, 77, {", "hut.building.yaml:21:13: lane to vertex 77, but the level's vertices are 0 to 5"),
        ("- [0, 1, {alpha", "- [0, -1, {alpha", "hut.building.yaml:15:13: wall to vertex -1"),
        ("- [4, 5, {name", "- [4, 6, {name", "hut.building.yaml:17:13: door to vertex 6"),
        ("- [3, 1, {graph_idx: [2, 0]}]", "- [3]", "hut.building.yaml:21:9: should have at least 2 values"),
        ("[100, 0, 0", "[wide, 0, 0", "hut.building.yaml:9:10: should be a number within ±1e+09, not 'wide'"),
        ("[100, 0, 0", "[.nan, 0, 0", "hut.building.yaml:9:10: should be a number"),
        ("[3, 0.4]", "[3, fast]", "'speed_limit' should be a double [3, …], not 'fast'"),
        ("[4, true], graph", "[4, maybe], graph", "'bidirectional' should be a bool [4, …]"),
        ("[3, 0.4]", "0.4", "should be a sequence, not 0.4"),
        ("[3, 0.4]", "[3]", "lane parameter 'speed_limit' should be [type, value]"),
        ("graph_idx: [2, 1]", "graph_idx: [2, -1]", "hut.building.yaml:19:9: lane of graph -1"),
        ("[0, 1, {distance", "[0, 0, {distance", "hut.building.yaml:6:9: measurement of zero length"),
        ("distance: [3, 5]", "distance: [3, 0]", "hut.building.yaml:6:9: measurement without a positive distance"),
        (
            "    measurements:\n      - [0, 1, {distance: [3, 5]}]\n",
            "    drawing: {filename: hut.png}\n",
            "hut.building.yaml:3:3: the level has no measurements",
        ),
        ("name: hut", "coordinate_system: web_mercator", "1:20: coordinate_system 'web_mercator' is not supported"),
        ("name: hut", "coordinate_system: polar", "'polar' is unknown"),
        ("name: hut", "reference_level_name: L7", "hut.building.yaml:1:23: no level 'L7' (levels: L1)"),
        ("levels:", "floors:", "hut.building.yaml:1:1: has no levels"),
    ],
)
def test_a_mistake_is_named_with_its_line(tmp_path, old, new, message):
    assert message in failure(tmp_path, old, new)


def test_an_unknown_level_lists_those_there_are(tmp_path):
    message = failure(tmp_path, "name: hut", "name: hut", level="L9")
    assert message == "hut.building.yaml:2:1: no level 'L9' (levels: L1)"


@pytest.mark.parametrize(
    "text", ["[]", "levels: 3", "levels: {L1: [2]}", "levels: {L1: {vertices: 5}}", "x", "levels:"]
)
def test_a_file_that_is_not_a_building_is_refused(tmp_path, text):
    with pytest.raises(InputError):
        load(tmp_path, text)


def test_a_level_without_lanes_or_vertices_loads(tmp_path):
    world = load(tmp_path, "levels: {L1: {}}")
    assert (world.vertices, world.lanes, len(world.levels[0].walls)) == ((), (), 0)


@pytest.mark.parametrize(
    ("name", "vertices", "lanes", "walls", "doors"),
    [
        ("mrp_bench/office", 29, 32, 31, 0),
        ("mrp_bench/office_crowdsim", 25, 28, 31, 0),
        ("mrp_bench/warehouse", 54, 40, 34, 0),
        ("mrp_bench/airport_terminal", 210, 223, 464, 5),
        ("rmf_demos/battle_royale", 21, 20, 32, 0),
        ("rmf_demos/office", 29, 30, 33, 3),
        ("rmf_demos/triple_H", 23, 22, 28, 0),
    ],
)
def test_public_maps_load_whole_and_fast(shared_data, name, vertices, lanes, walls, doors):
    begin = time.process_time()
    world = Rmf(file=shared_data / f"rmf/{name}.building.yaml").load()
    assert time.process_time() - begin < 1
    level = world.levels[0]
    assert (len(world.vertices), len(world.lanes), len(level.walls), len(level.doors)) == (
        vertices,
        lanes,
        walls,
        doors,
    )


def test_the_hotel_loads_with_three_levels_on_top_of_one_another(shared_data):
    world = Rmf(file=shared_data / "rmf/rmf_demos/hotel.building.yaml").load()
    assert [(level.name, level.elevation) for level in world.levels] == [("L1", 0), ("L2", 8), ("L3", 16)]
    assert [len(level.walls) for level in world.levels] == [56, 99, 99]
    assert [len(level.doors) for level in world.levels] == [5, 7, 7]
    assert [len(level.floors) for level in world.levels] == [3, 5, 5]
    assert len(world.lanes) == 58 + 32 + 32
    assert [(lift.name, lift.levels, lift.initial_level) for lift in world.lifts] == [
        ("Lift1", (0, 1, 2), 0),
        ("Lift2", (0, 1, 2), 0),
    ]
    for lift in world.lifts:
        cabins = [(vertex.x, vertex.y, vertex.level) for vertex in world.vertices if vertex.lift == lift.name]
        assert {level for _, _, level in cabins} == {0, 1, 2}
        assert np.hypot(*(np.array(cabins)[:, :2] - (lift.x, lift.y)).T).max() < 0.1, "the fiducials align the levels"
        for door in lift.doors:
            lane = [ln for ln in world.lanes if world.vertices[ln.end].lift == lift.name or
                    world.vertices[ln.start].lift == lift.name]  # fmt: skip
            ends = [[(world.vertices[i].x, world.vertices[i].y) for i in (ln.start, ln.end)] for ln in lane]
            gaps = [segment_distance(*np.array([a, b, door.start, door.end])) for a, b in ends]
            assert max(gaps) == 0, "every lane into the cabin leads through its door"


def test_furniture_of_public_maps_is_solid_or_named(shared_data):
    for file in sorted((shared_data / "rmf").glob("*/*.yaml")):
        world = Rmf(file=file).load()
        assert not any("no known footprint" in note for note in world.notes), file
        for level in world.levels:
            assert all(obstacle.estimated for obstacle in level.obstacles)
    assert len(Rmf(file=shared_data / "rmf/mrp_bench/airport_terminal.building.yaml").load().levels[0].obstacles) > 270


def test_vertices_of_the_original_office_come_in_publication_order(shared_data):
    world = Rmf(file=shared_data / "rmf/mrp_bench/office.building.yaml").load()
    import random

    names = [vertex.name for vertex in world.vertices]
    random.seed(3000)
    assert random.sample(names, 5) == ["puffin", "pantry", "dugong", "monkey", "woodpecker"]
    random.seed(3001)
    assert random.sample(names, 5) == ["dugong", "mayfly", "frog", "pantry", "blue_whale"]


def test_walls_of_the_original_office_span_the_published_width(shared_data):
    walls = Rmf(file=shared_data / "rmf/mrp_bench/office.building.yaml").load().levels[0].walls.reshape(-1, 2)
    width, _ = np.ptp(walls, axis=0)
    assert width + 0.1 == pytest.approx(21.53, abs=0.03)


HOUSE = """\
coordinate_system: reference_image
levels:
  G:
    measurements: [[0, 1, {distance: [3, 5]}]]
    fiducials: [[0, 0, a], [9, 3, b], [4, 7, c]]
    vertices: [[0, 0, 0, hall], [100, 0, 0, "", {lift_cabin: [1, up]}], [50, 40, 0, ""]]
    lanes: [[0, 1, {}]]
    floors: [{vertices: [0, 1, 2], parameters: {}}]
    models: [{model_name: Desk, name: d, x: 60, y: 60, z: 0, yaw: 1.5, static: true}]
  U:
    fiducials: [[1, 1, a], [18, 7, b], [9, 15, c]]
    vertices: [[0, 0, 0, attic], [100, 0, 0, ""], [50, 40, 0, ""]]
    doors: [[0, 1, {type: [1, hinged], motion_degrees: [3, 90], right_left_ratio: [3, 1]}]]
    holes: [{vertices: [0, 1, 2]}]
    elevation: 4
lifts:
  up: {x: 5, y: 0, yaw: 0, width: 2, depth: 1.5, reference_floor_name: G, initial_floor_name: U,
       doors: {front: {x: -1, y: 0, width: 1, motion_axis_orientation: 1.6, door_type: 2}},
       level_doors: {G: [front], U: [front]}}
"""
TOKEN = re.compile(r"[\w.]+|\S")


@settings(deadline=None, max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.sampled_from([BUILDING, HOUSE]),
    st.integers(0, 10**6),
    st.sampled_from(
        ["", "x", "-1", "7", "1e9", "1e999", ".nan", "~", "true", "[]", "{}", "[1, 2]", '""', "{a: 1}", "*a"]
    ),
)
def test_any_slip_gives_a_world_or_one_line(tmp_path, text, index, slip):
    places = list(TOKEN.finditer(text))
    place = places[index % len(places)]
    text = text[: place.start()] + slip + text[place.end() :]
    try:
        world = load(tmp_path, text)
        positions = [(vertex.x, vertex.y) for vertex in world.vertices] + [(lift.x, lift.y) for lift in world.lifts]
    except InputError as error:
        line, positions = str(error), []
        assert (error.file is not None, "\n" in line) == (True, False)  # noqa: PT017 - either outcome is right
    assert np.isfinite(positions).all()


def test_a_navigation_graph_is_refused_as_no_building(tmp_path):
    file = tmp_path / "0.yaml"
    file.write_text(
        "building_name: office\ndoors: {}\nlevels:\n  L1:\n    lanes:\n    - [0, 1, {speed_limit: 0.0}]\n"
        "    vertices:\n    - [8.9, -6.1, {name: ''}]\n    - [10.4, -5.5, {is_charger: true, name: charger}]\n"
    )
    with pytest.raises(InputError, match=r"0.yaml:8:\d+: this is an RMF navigation graph, not a building"):
        Rmf(file=file).load()
