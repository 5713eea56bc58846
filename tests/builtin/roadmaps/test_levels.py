"""Worlds of several levels."""

import attrs
import numpy as np
import pytest
from mrpbench_worlds_standard.rmf import Rmf

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.builtin.roadmaps.lanes import Lanes
from mrpbench_core.builtin.scenarios.random import Random
from mrpbench_core.checking.reachability import round_trips
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.worlds.world import Lane, Level, Vertex


@pytest.fixture
def tower(two_rooms):
    """The two rooms with an upper level whose walls would block the lower lane, and whose lane crosses it."""
    upper = Level(name="L2", elevation=3, walls=[[2, 0, 2, 4]])
    places = (Vertex(name="south", x=4, y=0.5, level=1), Vertex(name="north", x=4, y=3.5, level=1))
    mixed = (places[0], *two_rooms.vertices, places[1])
    return attrs.evolve(
        two_rooms,
        levels=(*two_rooms.levels, upper),
        vertices=mixed,
        lanes=(Lane(start=0, end=3, bidirectional=False), Lane(start=1, end=2)),
    )


@pytest.mark.parametrize("builder", [Lanes(), Lanes(compatible="mrp_bench"), GridRoadmap()], ids=repr)
def test_a_raster_has_one_level_and_says_so(tower, make_fleet, builder):
    with pytest.raises(InputError, match="a raster has one level, and world 'two rooms' has 2") as refusal:
        builder.build(tower, make_fleet(0.12))
    assert ", L2 (use roadmap: graph, or load one level, world: {plugin: rmf, file: ..., level:" in str(refusal.value)
    with pytest.raises(InputError, match=r"\(load one level") as refusal:
        builder.build(attrs.evolve(tower, lanes=()), make_fleet(0.12))


def test_a_graph_has_all_levels_and_no_crossing_between_them(tower, make_fleet):
    roadmap = Graph().build(tower, make_fleet(0.12))
    assert roadmap.level[roadmap.place].tolist() == [1, 0, 0, 1]
    np.testing.assert_allclose(roadmap.position[roadmap.place], [(v.x, v.y) for v in tower.vertices])
    ends = [set(np.flatnonzero(np.isin(roadmap.place, edge)).tolist()) for edge in roadmap.edges]
    assert sorted(map(sorted, ends)) == [[0, 3], [1, 2], [1, 2]]
    assert roadmap.notes == ()


def test_walls_block_lanes_of_their_own_level_only(tower, make_fleet):
    closed = attrs.evolve(tower.levels[1], walls=[[3, 2, 5, 2]])
    roadmap = Graph().build(attrs.evolve(tower, levels=(tower.levels[0], closed)), make_fleet(0.12))
    assert len(roadmap.edges) == 2
    assert roadmap.notes == ("Lane south – north is left out where a robot on it would touch something solid.",)


def test_random_scenarios_take_the_largest_connected_part_on_any_level(tower, make_fleet):
    upstairs = [Vertex(name=f"attic_{x}", x=x, y=3.5, level=1) for x in (3, 5)]
    lanes = [Lane(start=3, end=4), Lane(start=3, end=5), Lane(start=0, end=3)]
    world = attrs.evolve(tower, vertices=(*tower.vertices, *upstairs), lanes=(*lanes, tower.lanes[1]))
    roadmap, fleet = Graph().build(world, make_fleet(0.12, 0.12)), make_fleet(0.12, 0.12)
    for seed in range(5):
        scenario = Random(robots=2).draw(world, roadmap, fleet, seed)
        assert set(scenario.start_names) <= {"south", "north", "attic_3", "attic_5"}
        assert scenario.start_level.tolist() == [1, 1]


def test_the_hotel_is_one_part_with_lifts_and_the_doors_that_lanes_lead_through(shared_data, make_fleet):
    world = Rmf(file=shared_data / "rmf/rmf_demos/hotel.building.yaml").load()
    graph = Graph().build(world, make_fleet(0.12))
    assert (graph.place >= 0).all()
    assert graph.level[graph.place].tolist() == [vertex.level for vertex in world.vertices]
    assert len(np.unique(round_trips(graph, 0))) == 1
    kinds = {resource.name: resource.kind for resource in graph.resources}
    doors = ["L1_door1", "L1_door2", "L1_door4", "L1_door5", "L2_door2", "L3_door2"]
    assert kinds == dict.fromkeys(doors, "door") | {"Lift1": "lift", "Lift2": "lift"}
