"""Lanes and cells that leaves sweep, and doors without a place to wait."""

import numpy as np
import pytest
from mrpbench_world.door_sweeps import check_door_sweeps
from mrpbench_world.facts import check_world

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.model.common.fleet import Fleet, RobotModel
from mrpbench_core.model.worlds.world import Door, Lane, Level, Vertex, World

RADIUS = 0.15
CORNERS = RADIUS * np.array([[1, 0], [0, 1], [-1, 0], [0, -1]])
FLEET = Fleet(robots=(RobotModel(name="disc", footprint=CORNERS, max_speed=0.5, max_turn_rate=1.0),))
PLACES = {
    "west": (0.5, 0.8),
    "crossing": (3.0, 0.8),
    "east": (5.5, 0.8),
    "room": (3.0, 4.5),
}
"""A corridor to the south of a wall at y = 2, and a room to the north of it."""


def world(motion="hinged", direction=1, axis="start", places=PLACES, room="room") -> World:
    """A door in the middle of the wall, one metre wide. With direction 1 it opens to the south if it is hinged at its
    west end, and to the north if at its east end.
    """
    door = Door(name="gate", start=(2.5, 2), end=(3.5, 2), motion=motion, motion_direction=direction, motion_axis=axis)
    walls = [(0, 0, 6, 0), (6, 0, 6, 5), (6, 5, 0, 5), (0, 5, 0, 0), (0, 2, 2.5, 2), (3.5, 2, 6, 2)]
    names = list(places)
    lanes = (("west", "crossing"), ("crossing", "east"), ("crossing", room))
    return World(
        name="w",
        levels=(Level(name="", walls=walls, doors=(door,)),),
        vertices=tuple(Vertex(name=name, x=x, y=y) for name, (x, y) in places.items()),
        lanes=tuple(Lane(start=names.index(a), end=names.index(b), bidirectional=True) for a, b in lanes),
    )


def sentences(drawn, builder=None):
    roadmap = (builder or Graph()).build(drawn, FLEET)
    assert any(resource.kind == "door" for resource in roadmap.resources)
    return check_door_sweeps(drawn, roadmap, RADIUS)


SOUTH = [(motion, 1, "start") for motion in ("hinged", "double_hinged")] + [("hinged", -1, "end")]
NORTH = [(motion, -1, "start") for motion in ("hinged", "double_hinged")] + [("hinged", 1, "end")]
SLIDING = [(motion, 1, "start") for motion in ("sliding", "double_sliding", "telescope", "double_telescope")]


@pytest.mark.parametrize(("motion", "direction", "axis"), SOUTH)
def test_lanes_that_a_leaf_sweeps_without_leading_through_the_door_are_named(motion, direction, axis):
    near = {name: (x, y + 0.6 if y < 1 else y) for name, (x, y) in PLACES.items()}
    found = sentences(world(motion, direction, axis, near))
    lanes = [sentence for sentence in found if "sweeps lane" in sentence]
    assert [sentence.split(", so")[0] for sentence in lanes] == [
        "the leaf of door gate sweeps lane west – crossing",
        "the leaf of door gate sweeps lane crossing – east",
    ]


@pytest.mark.parametrize(("motion", "direction", "axis"), [*SOUTH, *NORTH, *SLIDING])
def test_lanes_out_of_reach_of_the_leaf_are_not_named(motion, direction, axis):
    assert sentences(world(motion, direction, axis)) == []


@pytest.mark.parametrize(("motion", "direction", "axis"), [*NORTH, *SLIDING])
def test_lanes_on_the_other_side_of_the_wall_are_not_named(motion, direction, axis):
    near = {name: (x, y + 0.6 if y < 1 else y) for name, (x, y) in PLACES.items()}
    assert not any("sweeps lane" in sentence for sentence in sentences(world(motion, direction, axis, near)))


@pytest.mark.parametrize(
    ("motion", "direction", "axis", "side"), [*((*case, -1) for case in SOUTH), ("hinged", -1, "start", 1)]
)
def test_cells_that_a_leaf_sweeps_are_counted(motion, direction, axis, side):
    drawn = world(motion, direction, axis)
    (sentence,) = sentences(drawn, GridRoadmap(cell_size=0.5))
    assert sentence.startswith("the leaf of door gate sweeps ")
    count = int(sentence.split("sweeps ")[1].split()[0])
    position = GridRoadmap(cell_size=0.5).build(drawn, FLEET).position
    x, y = position.T
    # A quarter disc of 1 m, or two of 0.5 m, about the hinges; the row of cells at the doorway touches it.
    assert 1 <= count <= int(((np.abs(x - 3) < 1.7) & (side * (y - 2) > 0) & (side * (y - 2) < 1.3)).sum())


def test_sliding_leaves_sweep_no_cells():
    assert sentences(world("sliding"), GridRoadmap(cell_size=0.5)) == []


@pytest.mark.parametrize(("motion", "direction", "axis"), NORTH[:1] + NORTH[2:])
def test_a_door_whose_lanes_end_in_the_sweep_has_no_place_to_wait(motion, direction, axis):
    found = sentences(world(motion, direction, axis, PLACES | {"room": (3.0, 2.7)}))
    assert found == [
        (
            "door gate has no place to wait on the side of (3.00, 2.70), because the lanes end where its leaf opens: "
            "add a vertex farther from the door"
        )
    ]


def test_a_doors_waiting_place_may_be_behind_other_vertices_in_the_sweep():
    places = PLACES | {"room": (3.0, 2.7), "far": (3.0, 4.5)}
    drawn = world("hinged", -1, "start", places)
    lanes = (*drawn.lanes, Lane(start=3, end=4, bidirectional=True))
    assert check_door_sweeps(drawn, Graph().build(drawn, FLEET), RADIUS)
    longer = World(name="w", levels=drawn.levels, vertices=drawn.vertices, lanes=lanes)
    assert not any("no place to wait" in sentence for sentence in sentences(longer))


def test_they_are_part_of_the_facts_of_a_world():
    drawn = world("hinged", -1, "start", PLACES | {"room": (3.0, 2.7)})
    roadmap = Graph().build(drawn, FLEET)
    assert list(check_world(drawn, roadmap, RADIUS).sweeps) == check_door_sweeps(drawn, roadmap, RADIUS)
