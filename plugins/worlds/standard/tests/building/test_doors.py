import math

import numpy as np
import pytest

from mrpbench_core.model.worlds.doors import leaf_segments

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


@pytest.mark.parametrize("word", ["End", "middle", "none"])
def test_an_axis_other_than_the_start_is_the_end(load, word):
    world = load(DOOR % f"motion_axis: [1, {word}]")
    assert world.levels[0].doors[0].motion_axis == "end"
    assert world.notes == (f"door motion_axis {word!r} is neither start nor end and is treated as end.",)


SHEET = """\
levels:
  L1:
    vertices: [[100, 200, 0, ""], [%d, %d, 0, ""], [0, 0, 0, ""], [0, 50, 0, ""]]
    measurements: [[2, 3, {distance: [3, 1]}]]
    doors: [[0, 1, {type: [1, %s], motion_axis: [1, %s], motion_direction: [2, %d], motion_degrees: [3, %d]}]]
"""
"""50 pixels to the metre, y down."""


@pytest.mark.parametrize("direction", [1, -1])
@pytest.mark.parametrize("degrees", [30, 90, 150, -90])
@pytest.mark.parametrize(("kind", "axis"), [("hinged", "start"), ("hinged", "end"), ("double_hinged", "start")])
@pytest.mark.parametrize("end", [(200, 200), (100, 100), (20, 260)])
def test_hinged_leaves_open_to_the_side_on_which_the_editor_draws_them(load, end, kind, axis, degrees, direction):
    """The arithmetic of the traffic editor's drawing, in pixels."""
    (x1, y1), (x2, y2) = (100, 200), end
    length, angle = math.hypot(x2 - x1, y2 - y1), math.atan2(y2 - y1, x2 - x1)
    turn = math.radians(abs(degrees)) * direction
    leaves = {"start": (x1, y1, angle + turn), "end": (x2, y2, angle + math.pi + turn)}
    drawn = [leaves[axis]]
    if kind == "double_hinged":
        length /= 2
        drawn = [leaves["start"], (x2, y2, angle + math.pi - turn)]
    tips = [(x + length * math.cos(way), y + length * math.sin(way)) for x, y, way in drawn]
    (door,) = load(SHEET % (*end, kind, axis, direction, degrees)).levels[0].doors
    np.testing.assert_allclose(leaf_segments(door, 1.0)[:, 2:], [(x / 50, -y / 50) for x, y in tips], atol=1e-9)
