"""Doors and lifts as resources, and ways round open doors."""

import math
from collections import deque

import attrs
import numpy as np
import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.model.common.geometry import segment_distance
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.doors import leaf_segments, opening_time
from mrpbench_core.model.worlds.facilities import Facilities, ride_time
from mrpbench_core.model.worlds.world import Door, Lane, Level, Vertex, World
from mrpbench_core.testing.fixtures.building import CABIN, building

RADIUS = 0.12
WALLS = [[0, 0, 6, 0], [6, 0, 6, 4], [6, 4, 0, 4], [0, 4, 0, 0], [0, 2, 2.5, 2], [3.5, 2, 6, 2]]
"""A hall, y from 0 to 2, and a room above it, with a gap of 1 m."""
MOTIONS = ("hinged", "double_hinged", "sliding", "double_sliding", "telescope", "double_telescope")
DOORS = st.builds(
    Door,
    name=st.just("door"),
    start=st.just((2.5, 2.0)),
    end=st.just((3.5, 2.0)),
    motion=st.sampled_from(MOTIONS),
    motion_axis=st.sampled_from(["start", "end"]),
    motion_direction=st.sampled_from([1, -1]),
    motion_degrees=st.sampled_from([60.0, 90.0, 120.0, 180.0]),
    right_left_ratio=st.sampled_from([0.5, 1.0, 2.0]),
)


def hall(door: Door, lane_height: float = 1.0) -> World:
    """A lane along the hall, and one into the room."""
    places = {"west": (1, lane_height), "front": (3, lane_height), "east": (5, lane_height), "room": (3, 3.5)}
    return World(
        name="hall",
        levels=(Level(name="L1", walls=WALLS, doors=(door,)),),
        vertices=tuple(Vertex(name=name, x=x, y=y) for name, (x, y) in places.items()),
        lanes=(Lane(start=0, end=1), Lane(start=1, end=2), Lane(start=1, end=3)),
    )


def tower() -> World:
    """Two levels joined by a lift."""
    x, y = CABIN
    places = [Vertex(name="", x=1, y=y, level=level) for level in (0, 1)]
    stops = [Vertex(name="", x=x, y=y, level=level, lift="lift") for level in (0, 1)]
    return attrs.evolve(building(), vertices=(*places, *stops), lanes=(Lane(start=0, end=2), Lane(start=1, end=3)))


def gap_to_leaves(door: Door, opening: float, start, end) -> np.ndarray:
    """Metres f8[k] from straight ways to the leaves."""
    lines = leaf_segments(door, opening)
    gap = segment_distance(lines[None, :, :2], lines[None, :, 2:], start[:, None], end[:, None])
    return gap.min(axis=1) - door.thickness / 2


def ways(roadmap: Roadmap) -> tuple[np.ndarray, np.ndarray]:
    return roadmap.position[roadmap.edges[:, 0]], roadmap.position[roadmap.edges[:, 1]]


def blocks_a_robot(roadmap: Roadmap, door: Door) -> bool:
    """Tell by search whether a robot that holds the door open can come to an edge that its open leaf blocks.

    Independent of the code under test: edges and vertices by turns, through the resource only.
    """
    resource = roadmap.resources[0]
    held, stands, through = (set(part) for part in (resource.edges, resource.vertices, resource.passage))
    start, end = ways(roadmap)
    open_leaf = set(np.flatnonzero(gap_to_leaves(door, 1.0, start, end) < RADIUS - 1e-6).tolist())
    queue = deque((edge, edge in through, edge in open_leaf - through) for edge in held)
    seen = set(queue)
    while queue:
        edge, passed, barred = queue.popleft()
        if passed and barred:
            return True
        head = int(roadmap.edges[edge, 1])
        if head not in stands:
            continue
        for after in held & set(np.flatnonzero(roadmap.edges[:, 0] == head).tolist()):
            state = (after, passed or after in through, barred or after in open_leaf - through)
            if state not in seen:
                seen.add(state)
                queue.append(state)
    return False


@pytest.mark.parametrize("cell_size", [None, 0.25])
@given(door=DOORS)
def test_an_open_leaf_blocks_no_robot_that_comes_through_its_door(make_fleet, cell_size, door):
    world = hall(door)
    builder = Graph() if cell_size is None else GridRoadmap(cell_size=cell_size)
    roadmap = builder.build(world, make_fleet(RADIUS))
    event(f"{door.motion}: {len(roadmap.notes)} notes")
    if roadmap.resources:
        assert not blocks_a_robot(roadmap, door)


@given(door=DOORS, opening=st.floats(0, 1))
def test_leaves_at_any_opening_touch_no_robot_outside_the_resource(make_fleet, door, opening):
    roadmap = GridRoadmap(cell_size=0.25).build(hall(door), make_fleet(RADIUS))
    if not roadmap.resources:
        return
    resource = roadmap.resources[0]
    start, end = ways(roadmap)
    near = np.flatnonzero(gap_to_leaves(door, opening, start, end) < RADIUS)
    assert set(near.tolist()) <= set(resource.edges)
    near = np.flatnonzero(gap_to_leaves(door, opening, roadmap.position, roadmap.position) < RADIUS)
    assert set(near.tolist()) <= set(resource.vertices)


@given(door=DOORS)
def test_a_robot_in_a_doorway_needs_it_open_and_touches_no_open_leaf(make_fleet, door):
    roadmap = GridRoadmap(cell_size=0.25).build(hall(door), make_fleet(RADIUS))
    start, end = ways(roadmap)
    crossing = (np.sign(start[:, 1] - 2) != np.sign(end[:, 1] - 2)).nonzero()[0]
    through = roadmap.resources[0].passage if roadmap.resources else ()
    assert set(crossing.tolist()) <= set(through)
    passing = np.array(through, np.int64)
    assert (gap_to_leaves(door, 1.0, start[passing], end[passing]) >= RADIUS - 1e-6).all()


def test_a_leaf_across_the_only_hall_leaves_the_door_shut_rather_than_the_hall_parted(make_fleet):
    door = Door(name="room door", start=(2.5, 2.0), end=(3.5, 2.0), motion="hinged", motion_direction=1)
    world = hall(door, lane_height=1.4)
    more = [Vertex(name=f"bay_{index}", x=1 + 0.3 * index, y=0.5) for index in range(3)]
    lanes = [Lane(start=0, end=4 + index) for index in range(3)]
    world = attrs.evolve(world, vertices=(*world.vertices, *more), lanes=(*world.lanes, *lanes))
    roadmap = Graph().build(world, make_fleet(RADIUS))
    assert roadmap.resources == ()
    (note,) = [note for note in roadmap.notes if "room door" in note]
    assert note.startswith(
        "Door room door stays closed: its open leaf would block a robot that passes through it, at ("
    )
    joined = {tuple(sorted(edge)) for edge in roadmap.edges.tolist()}
    west, front, east, room = roadmap.place[:4].tolist()
    assert {tuple(sorted(pair)) for pair in ((west, front), (front, east))} <= joined
    assert room not in roadmap.edges


def test_a_leaf_that_bars_a_way_with_a_way_round_keeps_that_way_out(make_fleet):
    door = Door(name="door", start=(2.5, 2.0), end=(3.5, 2.0), motion="hinged", motion_direction=1)
    world = hall(door, lane_height=1.4)
    detour = (Vertex(name="south", x=3, y=0.4),)
    lanes = (*world.lanes, Lane(start=0, end=4), Lane(start=4, end=2), Lane(start=4, end=1))
    world = attrs.evolve(world, vertices=(*world.vertices, *detour), lanes=lanes)
    roadmap = Graph().build(world, make_fleet(RADIUS))
    west, front = roadmap.place[:2].tolist()
    assert [resource.name for resource in roadmap.resources] == ["door"]
    assert not {(west, front), (front, west)} & {tuple(edge) for edge in roadmap.edges.tolist()}
    assert any(note.startswith("Door door: 1 edge is left out, at (2.00, 1.40)") for note in roadmap.notes)


def test_a_leaf_that_opens_into_the_room_bars_nothing_in_the_hall(make_fleet):
    door = Door(name="door", start=(2.5, 2.0), end=(3.5, 2.0), motion="hinged", motion_direction=-1)
    roadmap = Graph().build(hall(door), make_fleet(RADIUS))
    assert roadmap.notes == ()
    assert len(roadmap.edges) == 6


def test_the_setup_of_a_door_is_its_opening_time(make_fleet):
    door = Door(name="door", start=(2.5, 2.0), end=(3.5, 2.0), motion="sliding")
    (resource,) = Graph(tick=0.5).build(hall(door), make_fleet(RADIUS)).resources
    assert (resource.kind, resource.capacity) == ("door", 1)
    assert resource.setup_ticks * 0.5 == pytest.approx(opening_time(door), abs=0.5)
    assert resource.setup_ticks * 0.5 >= opening_time(door)


def test_lifts_join_levels_by_edges_that_take_a_ride(make_fleet):
    world = tower()
    roadmap = Graph(tick=0.5).build(world, make_fleet(RADIUS))
    lift = world.lifts[0]
    start, end = roadmap.level[roadmap.edges].T
    (rides,) = np.nonzero(start != end)
    assert len(rides) == 2
    assert roadmap.duration[0, rides].tolist() == [math.ceil(ride_time(world, lift, 0, 1) / 0.5)] * 2
    (resource,) = [resource for resource in roadmap.resources if resource.kind == "lift"]
    assert set(rides.tolist()) <= set(resource.edges)
    inside = [lift.holds(x, y) for x, y in roadmap.position.tolist()]
    assert set(np.flatnonzero(inside).tolist()) <= set(resource.vertices)


def test_mutexes_keep_their_lanes_when_lifts_bring_edges_of_their_own(make_fleet):
    world = tower()
    world = attrs.evolve(world, lanes=(world.lanes[0], attrs.evolve(world.lanes[1], mutex="narrow")))
    roadmap = Graph().build(world, make_fleet(RADIUS))
    (mutex,) = [resource for resource in roadmap.resources if resource.kind == "mutex"]
    ends = set(roadmap.place[[1, 3]].tolist())
    assert [set(edge) for edge in roadmap.edges[list(mutex.edges)].tolist()] == [ends, ends]


def test_a_mutex_named_like_a_door_gets_another_name(make_fleet):
    door = Door(name="door", start=(2.5, 2.0), end=(3.5, 2.0), motion="sliding")
    world = hall(door)
    world = attrs.evolve(world, lanes=(attrs.evolve(world.lanes[0], mutex="door"), *world.lanes[1:]))
    kinds = {resource.name: resource.kind for resource in Graph().build(world, make_fleet(RADIUS)).resources}
    assert kinds == {"mutex door": "mutex", "door": "door"}
    assert Facilities(world).names == ("door",)
