import attrs
import numpy as np
import pytest
from mrpbench_worlds_standard.rmf import Rmf

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.checking.components import components
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.worlds.world import Lane, Level, Vertex, World


def world_of(points, lanes, walls=()) -> World:
    return World(
        name="net",
        levels=(Level(name="", walls=list(walls)),),
        vertices=tuple(Vertex(name=f"v{index}", x=x, y=y) for index, (x, y) in enumerate(points)),
        lanes=tuple(lanes),
    )


def test_a_lane_takes_its_length_over_its_speed_rounded_up(make_fleet):
    lanes = [Lane(start=0, end=1), Lane(start=1, end=2, speed_limit=0.1), Lane(start=2, end=3, speed_limit=9)]
    roadmap = Graph(tick=0.5).build(world_of([(0, 0), (2, 0), (4, 0), (4, 2.05)], lanes), make_fleet(0.1))
    assert roadmap.edges.tolist() == [[0, 1], [1, 0], [1, 2], [2, 1], [2, 3], [3, 2]]
    assert roadmap.duration.tolist() == [[20, 20, 40, 40, 21, 21]]
    assert roadmap.tick == 0.5


def test_one_way_lanes_are_one_edge(make_fleet):
    lanes = [Lane(start=1, end=0, bidirectional=False)]
    roadmap = Graph().build(world_of([(0, 0), (2, 0)], lanes), make_fleet(0.1))
    assert roadmap.edges.tolist() == [[1, 0]]


def test_each_profile_has_its_own_durations_and_passages(make_fleet):
    walls = [[1, 0.4, 1, 2], [1, -0.4, 1, -2]]
    fleet = make_fleet(0.1, 0.4, 0.1, speeds=[0.2, 0.4, 0.2])
    detour = [Lane(start=0, end=1), Lane(start=0, end=2), Lane(start=2, end=1)]
    roadmap = Graph().build(world_of([(0, 0), (2, 0), (1, 4)], detour, walls), fleet)
    assert roadmap.edges.tolist() == [[0, 1], [0, 2], [1, 0], [1, 2], [2, 0], [2, 1]]
    slow, fast = roadmap.duration.tolist()
    assert slow[0] == 20
    assert fast[0] == fast[2] == -1
    assert all(ticks > 0 for index, ticks in enumerate(fast) if index not in (0, 2))


def test_a_lane_that_no_robot_fits_on_is_left_out_and_named(make_fleet):
    lanes = [Lane(start=0, end=1), Lane(start=1, end=2)]
    roadmap = Graph().build(world_of([(0, 0), (4, 0), (8, 0)], lanes, [[6, -1, 6, 1]]), make_fleet(0.1))
    assert roadmap.edges.tolist() == [[0, 1], [1, 0]]
    assert roadmap.notes == ("Lane v1 – v2 is left out where a robot on it would touch something solid.",)


def test_a_place_in_a_wall_is_not_a_vertex(make_fleet):
    lanes = [Lane(start=0, end=1), Lane(start=1, end=2)]
    roadmap = Graph().build(world_of([(6, 0), (0, 0), (4, 0)], lanes, [[6, -1, 6, 1]]), make_fleet(0.1))
    assert roadmap.place.tolist() == [-1, 0, 1]
    assert roadmap.edges.tolist() == [[0, 1], [1, 0]]
    assert "No robot can stand at v0." in roadmap.notes


def test_places_of_several_graphs_in_one_position_are_one_vertex(make_fleet):
    points, lanes = (
        [(0, 0), (2, 0), (0, 0), (2, 0)],
        [Lane(start=0, end=1), Lane(start=2, end=3, graph=1, speed_limit=0.1)],
    )
    roadmap = Graph().build(world_of(points, lanes), make_fleet(0.1))
    assert roadmap.place.tolist() == [0, 1, 0, 1]
    assert roadmap.edges.tolist() == [[0, 1], [1, 0]]
    assert roadmap.duration.tolist() == [[20, 20]], "of parallel lanes the fastest"


@pytest.mark.parametrize(("name", "drawn"), [("office", 1), ("warehouse", 14), ("airport_terminal", 4)])
def test_the_original_maps_become_one_piece(shared_data, make_fleet, name, drawn):
    world = Rmf(file=shared_data / f"rmf/mrp_bench/{name}.building.yaml").load()
    lanes = [(lane.start, lane.end) for lane in world.lanes]
    assert len(set(components(len(world.vertices), lanes))) == drawn
    roadmap = Graph().build(world, make_fleet(0.125))
    assert len(set(components(len(roadmap.position), roadmap.edges))) == 1
    assert (roadmap.place >= 0).all()
    moved = roadmap.position[roadmap.place] - [(vertex.x, vertex.y) for vertex in world.vertices]
    assert np.hypot(*moved.T).max() < 0.2


def test_a_mutex_is_a_resource_of_its_lanes_and_of_the_vertices_between_them(make_fleet, two_rooms):
    places = tuple(Vertex(name=str(index), x=0.5 + index, y=1.5) for index in range(6))
    lanes = tuple(Lane(start=index, end=index + 1, mutex="gap" if 0 < index < 4 else "") for index in range(5))
    roadmap = Graph().build(attrs.evolve(two_rooms, vertices=places, lanes=lanes), make_fleet(0.1))
    (mutex,) = roadmap.resources
    assert (mutex.name, mutex.kind, mutex.capacity) == ("gap", "mutex", 1)
    ends = {tuple(np.sort(roadmap.edges[edge]).tolist()) for edge in mutex.edges}
    assert ends == {tuple(sorted(roadmap.place[[index, index + 1]].tolist())) for index in (1, 2, 3)}
    assert set(mutex.vertices) == set(roadmap.place[[2, 3]].tolist())


def test_places_may_name_a_mutex_too(make_fleet, two_rooms):
    west, east = two_rooms.vertices
    world = attrs.evolve(two_rooms, vertices=(west, attrs.evolve(east, parameters={"mutex": "bay"})))
    (mutex,) = Graph().build(world, make_fleet(0.1)).resources
    assert (mutex.name, mutex.edges, len(mutex.vertices)) == ("bay", (), 1)


def test_worlds_without_drivable_lanes_are_refused(make_fleet):
    with pytest.raises(InputError, match="has no lanes"):
        Graph().build(World(name="x", levels=(Level(name=""),)), make_fleet(0.1))
    with pytest.raises(InputError, match="no lane that a robot fits on"):
        Graph().build(world_of([(0, 0), (4, 0)], [Lane(start=0, end=1)], [[2, -1, 2, 1]]), make_fleet(0.1))
