import pytest

DOOR = """\
coordinate_system: cartesian_meters
levels:
  L1:
    vertices: [[0, 0, 0, ""], [3, 4, 0, ""]]
    doors: [[0, 1, {name: [1, gate], %s}]]
"""


@pytest.mark.parametrize(
    ("word", "motion"),
    [
        ("hinged", "hinged"),
        ("double_hinged", "double_hinged"),
        ("sliding", "sliding"),
        ("double_sliding", "double_sliding"),
        ("single_telescope", "telescope"),
        ("double_telescope", "double_telescope"),
        ("single_swing", "hinged"),
    ],
)
def test_every_kind_of_door_is_known(load, word, motion):
    world = load(DOOR % f"type: [1, {word}]")
    (door,) = world.levels[0].doors
    assert (door.name, door.motion, door.width) == ("gate", motion, 5)
    assert world.notes == ()


def test_an_unknown_kind_is_noted(load):
    world = load(DOOR % "type: [1, portcullis]")
    assert world.levels[0].doors[0].motion == "sliding"
    assert world.notes == ("door type 'portcullis' is not known and is treated as sliding.",)


def test_how_a_door_moves_is_kept(load):
    text = "motion_axis: [1, end], motion_direction: [2, -1], motion_degrees: [3, 75], right_left_ratio: [3, 2]"
    (door,) = load(DOOR % text).levels[0].doors
    assert (door.motion_axis, door.motion_direction, door.motion_degrees, door.right_left_ratio) == ("end", -1, 75, 2)
