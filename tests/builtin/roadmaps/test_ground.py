"""Worlds of several levels."""

import attrs
import numpy as np
import pytest

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.builtin.roadmaps.lanes import Lanes
from mrpbench_core.builtin.scenarios.random import Random
from mrpbench_core.builtin.worlds.rmf import Rmf
from mrpbench_core.model.world import Lane, Level, Vertex


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
def test_a_raster_is_that_of_the_ground_level_alone(two_rooms, tower, make_fleet, builder):
    alone, whole = (builder.build(world, make_fleet(0.12)) for world in (two_rooms, tower))
    np.testing.assert_array_equal(whole.position, alone.position)
    np.testing.assert_array_equal(whole.edges, alone.edges)
    assert whole.place.tolist() == [-1, *alone.place.tolist(), -1]
    assert whole.notes == (*alone.notes, "A raster has one level, here L1: 2 places on other levels are left out.")


def test_no_point_of_another_level_is_on_a_raster(tower, make_fleet):
    roadmap = Lanes().build(tower, make_fleet(0.12))
    point = np.array([(1.0, 1.5), (1.0, 1.5)])
    assert roadmap.locate(point, np.array([0, 1])).tolist() == [roadmap.place[1], -1]


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
    assert roadmap.notes == ("Lane south – north is left out where a robot on it would touch something.",)


def test_random_scenarios_stay_where_robots_can_drive_and_on_the_ground(tower, make_fleet):
    upstairs = [Vertex(name=f"attic_{x}", x=x, y=3.5, level=1) for x in (3, 5)]
    lanes = [Lane(start=3, end=4), Lane(start=3, end=5), Lane(start=0, end=3)]
    world = attrs.evolve(tower, vertices=(*tower.vertices, *upstairs), lanes=(*lanes, tower.lanes[1]))
    roadmap, fleet = Graph().build(world, make_fleet(0.12, 0.12)), make_fleet(0.12, 0.12)
    for seed in range(5):
        scenario = Random(robots=2).draw(world, roadmap, fleet, seed)
        assert set(scenario.start_names) == {"west", "east"}
        assert scenario.start_level.tolist() == [0, 0]


def test_the_hotel_has_roadmaps_of_every_kind(shared_data, make_fleet):
    world = Rmf(file=shared_data / "rmf/rmf_demos/hotel.building.yaml").load()
    ground = np.array([vertex.level == 0 for vertex in world.vertices])
    for builder in (Lanes(), GridRoadmap()):
        roadmap = builder.build(world, make_fleet(0.12))
        assert (roadmap.place[~ground] == -1).all()
        assert (roadmap.place[ground] >= 0).mean() > 0.95
    graph = Graph().build(world, make_fleet(0.12))
    assert (graph.place >= 0).all()
    assert graph.level[graph.place].tolist() == [vertex.level for vertex in world.vertices]
