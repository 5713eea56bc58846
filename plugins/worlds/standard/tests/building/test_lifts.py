import pytest

from mrpbench_core.files.errors import InputError

TOWER = """\
coordinate_system: cartesian_meters
levels:
  G: {vertices: [[0, 0, 0, hall], [5, 0, 0, "", {lift_cabin: [1, up]}]], lanes: [[0, 1, {}]]}
  U: {vertices: [[0, 0, 0, attic], [5.2, 0.1, 0, ""]], lanes: [[0, 1, {}]],
      holes: [{vertices: [0, 1, 1]}]}
  V: {}
lifts:
  up:
    {x: 5, y: 0, yaw: 0, width: 2, depth: 1.5, reference_floor_name: G, initial_floor_name: U,
     lowest_floor: G, highest_floor: U, plugins: true,
     doors: {front: {x: -1, y: 0, width: 1, motion_axis_orientation: 1.5708, door_type: 2},
             back: {x: 1, y: 0, width: 0.9, motion_axis_orientation: 1.5708, door_type: 2}},
     level_doors: {G: [front], U: [front, back]}}
"""


def test_a_lift_knows_its_cabin_levels_and_doors(load):
    (lift,) = load(TOWER).lifts
    assert (lift.name, lift.x, lift.y, lift.width, lift.depth) == ("up", 5, 0, 2, 1.5)
    assert (lift.levels, lift.initial_level) == ((0, 1), 1)
    assert [door.name for door in lift.doors] == ["front", "back"]
    assert lift.door_levels == ((0, 1), (1,))
    assert lift.doors[0].start == pytest.approx((4, -0.5), abs=1e-4)
    assert lift.doors[0].end == pytest.approx((4, 0.5), abs=1e-4)


def test_places_in_the_cabin_name_their_lift(load):
    vertices = load(TOWER).vertices
    assert [(vertex.name, vertex.level, vertex.lift) for vertex in vertices] == [
        ("hall", 0, ""),
        ("", 0, "up"),
        ("attic", 1, ""),
        ("", 1, "up"),
    ]


def test_a_lift_shaft_is_not_a_hole(load):
    shaft = TOWER.replace('[5.2, 0.1, 0, ""]]', '[5.2, 0.1, 0, ""], [4.2, -0.4, 0, ""], [5.8, 0.5, 0, ""]]')
    assert load(shaft.replace("[0, 1, 1]", "[1, 2, 3]")).levels[1].holes == ()
    assert len(load(TOWER.replace("[0, 1, 1]", "[0, 0, 0]")).levels[1].holes) == 1


def test_a_lift_of_one_loaded_level_or_none_is_cut_or_noted(load):
    (lift,) = load(TOWER, level="G").lifts
    assert (lift.levels, lift.initial_level, lift.door_levels) == ((0,), 0, ((0,), ()))
    world = load(TOWER, level="V")
    assert world.lifts == ()
    assert any("'up' stops at no level that is loaded" in note for note in world.notes)
    assert any("'up' is drawn on level 'G'" in note for note in load(TOWER, level="U").notes)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("width: 2,", "", "has no 'width'"),
        ("width: 2,", "width: 0,", "width should be positive"),
        ("U: [front, back]}", "U: [side]}", "opens the door 'side' on level 'U', which it does not have"),
        ("level_doors: {G:", "level_doors: {X:", "no level 'X' (levels: G, U, V)"),
        ("x: 5, y", "x: here, y", "should be a number"),
        ("initial_floor_name: U", "initial_floor_name: X", "no level 'X' (levels: G, U, V)"),
        ("highest_floor: U", "highest_floor: X", "no level 'X' (levels: G, U, V)"),
    ],
)
def test_a_mistake_is_named_with_its_line(load, old, new, message):
    assert old in TOWER
    with pytest.raises(InputError) as caught:
        load(TOWER.replace(old, new))
    assert message in str(caught.value)
    assert caught.value.line >= 8


def test_a_lift_that_serves_fewer_than_two_levels_is_noted(load):
    for doors, note in (("U: []}", "'up' has no door on level 'U' and does not stop there"), ("}", None)):
        world = load(TOWER.replace("U: [front, back]}", doors))
        assert world.lifts == ()
        assert any("'up' serves 1 level and is left out" in found for found in world.notes)
        assert note is None or any(note in found for found in world.notes)


SECOND = """
  side:
    {x: %s, y: 0, yaw: %s, width: 2, depth: 1.5, reference_floor_name: G,
     doors: {front: {x: -1, y: 0, width: 1, motion_axis_orientation: 1.5708, door_type: 2}},
     level_doors: {%s: [front], %s: [front]}}
"""


@pytest.mark.parametrize(("x", "yaw", "levels"), [(5, 0, "GU"), (6.5, 0, "UV"), (6.7, 0.8, "GU")])
def test_lifts_in_one_shaft_are_refused(load, x, yaw, levels):
    with pytest.raises(InputError, match="lifts 'up' and 'side' are in the same shaft") as caught:
        load(TOWER + SECOND % (x, yaw, *levels))
    assert caught.value.line == 15


def test_a_lift_drawn_twice_is_one_that_serves_all_levels(load):
    lift = TOWER.partition("lifts:\n")[2]
    other = (
        lift.replace("up:", "cargo:").replace("x: 5,", "x: 5.05,").replace("U: [front, back]", "U: [front], V: [back]")
    )
    for text in (TOWER + other, TOWER.replace(lift, other + lift)):
        world = load(text)
        (one,) = world.lifts
        assert (one.name, sorted(one.levels), one.initial_level) == ("cargo", [0, 1, 2], 1)
        assert [(door.name, sorted(levels)) for door, levels in zip(one.doors, one.door_levels, strict=True)] == [
            ("front", [0, 1]),
            ("back", [1, 2]),
        ]
        assert sum("have the same cabin and doors and are one" in note for note in world.notes) == 1
        assert {vertex.lift for vertex in world.vertices} == {"", "cargo"}


@pytest.mark.parametrize(("x", "yaw", "levels"), [(7, 0, "GU"), (7.3, 0.8, "GU"), (5, 0, "VW")])
def test_lifts_that_only_touch_or_are_above_each_other_are_two(load, x, yaw, levels):
    text = TOWER.replace("  V: {}", "  V: {}\n  W: {}") + SECOND % (x, yaw, *levels)
    assert [lift.name for lift in load(text).lifts] == ["up", "side"]


def test_a_vertex_names_the_cabin_that_it_lies_in(load):
    world = load(TOWER.replace("[0, 0, 0, attic]", "[0, 0, 0, attic, {lift_cabin: [1, up]}]"))
    assert [vertex.lift for vertex in world.vertices if vertex.name == "attic"] == [""]
    assert any("names the lift_cabin 'up', which is not at that position" in note for note in world.notes)
