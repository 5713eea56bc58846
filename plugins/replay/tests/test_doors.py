"""Doors and lifts on the page."""

import math
from types import SimpleNamespace

import attrs
import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_replay.doors import pack_facilities
from mrpbench_replay.packing import Packing

from mrpbench_core.model.worlds.doors import leaf_segments
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.model.worlds.world import Door, Level, World
from mrpbench_core.testing.fixtures.building import building

MOTIONS = ("hinged", "double_hinged", "sliding", "double_sliding", "telescope", "double_telescope")


SILENT = SimpleNamespace(channels={})
"""A recording that knows nothing of doors."""


def moved(leaf, opening):
    """Move a leaf like `page/facilities.js`."""
    x1, y1, x2, y2, dx, dy, turn = leaf
    cosine, sine = math.cos(turn * opening), math.sin(turn * opening)
    x, y = x1 + dx * opening, y1 + dy * opening
    return [x, y, x + cosine * (x2 - x1) - sine * (y2 - y1), y + sine * (x2 - x1) + cosine * (y2 - y1)]


@given(
    motion=st.sampled_from(MOTIONS),
    axis=st.sampled_from(["start", "end"]),
    direction=st.sampled_from([-1, 1]),
    degrees=st.floats(10, 180),
    ratio=st.floats(0.3, 3),
    end=st.tuples(st.floats(1, 2), st.floats(-2, 2)),
    opening=st.floats(0, 1),
)
def test_leaves_move_on_the_page_as_in_the_world(motion, axis, direction, degrees, ratio, end, opening):
    door = Door(
        name="d",
        start=(0, 0),
        end=end,
        motion=motion,
        motion_axis=axis,
        motion_direction=direction,
        motion_degrees=degrees,
        right_left_ratio=ratio,
    )
    world = World(name="w", levels=(Level(name="L1", doors=(door,)),))
    (drawn,) = pack_facilities(SILENT, world, Packing())["doors"]
    np.testing.assert_allclose(
        [moved(leaf, opening) for leaf in drawn["leaves"]], leaf_segments(door, opening), atol=1e-3
    )


def test_lifts_know_their_doors_stops_and_levels():
    world = building()
    packed = pack_facilities(SILENT, world, Packing())
    assert [door["name"] for door in packed["doors"]] + [cabin["name"] for cabin in packed["cabins"]] == list(
        Facilities(world).names
    )
    assert [door["lift"] for door in packed["doors"]] == [-1, 0]
    assert packed["doors"][1]["opens_on"] == [0, 1]
    assert packed["cabins"][0]["stops"] == [[0, 0.0], [1, 3.0]]


def test_recorded_states_of_doors_are_packed(store, chunk, run_context, unpack):
    world = attrs.evolve(run_context.world, levels=building().levels, lifts=building().lifts)
    doing = np.linspace([0, 0, 0], [1, 0.5, 3], len(chunk["time"]))
    recording = store(chunk | {"facility": doing}, context=attrs.evolve(run_context, world=world))
    packing = Packing()
    pack_facilities(recording, world, packing)
    arrays = unpack(packing.layout, packing.text())
    assert np.abs(arrays["facility"] - doing.T).max() <= 0.0026
