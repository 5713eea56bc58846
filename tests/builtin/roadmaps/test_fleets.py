"""Robots that are bound to a navigation graph of RMF."""

import attrs
import numpy as np
import pytest

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.builtin.scenarios.random import Random
from mrpbench_core.checking.reachability import reachable
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.worlds.world import Lane, Level, Vertex, World


@pytest.fixture
def crossing() -> World:
    """Two lanes that cross at (3, 3): graph 0 from west to east, graph 1 from south to north, each with a side lane."""
    places = {"west": (0, 3), "east": (6, 3), "south": (3, 0), "north": (3, 6), "far_east": (9, 3), "far_north": (3, 9)}
    return World(
        name="crossing",
        levels=(Level(name="L1", walls=[[-2, -2, 12, -2], [12, -2, 12, 12], [12, 12, -2, 12], [-2, 12, -2, -2]]),),
        vertices=tuple(Vertex(name=name, x=x, y=y) for name, (x, y) in places.items()),
        lanes=(
            Lane(start=0, end=1),
            Lane(start=1, end=4),
            Lane(start=2, end=3, graph=1),
            Lane(start=3, end=5, graph=1),
        ),
    )


def names_reached(world, roadmap, profile, start):
    source = int(roadmap.place[[vertex.name for vertex in world.vertices].index(start)])
    seen = reachable(roadmap, profile, source)
    return {vertex.name for vertex, place in zip(world.vertices, roadmap.place, strict=True) if seen[place]}


def test_a_robot_drives_on_the_lanes_of_its_graph_only(crossing, make_fleet):
    roadmap = Graph().build(crossing, make_fleet(0.1, 0.1, 0.1, graphs=[0, 1, None]))
    assert names_reached(crossing, roadmap, 0, "west") == {"west", "east", "far_east"}
    assert names_reached(crossing, roadmap, 1, "south") == {"south", "north", "far_north"}
    assert names_reached(crossing, roadmap, 2, "west") == {vertex.name for vertex in crossing.vertices}


def test_lanes_of_other_graphs_are_left_out_with_a_note(crossing, make_fleet):
    roadmap = Graph().build(crossing, make_fleet(0.1, graphs=[1]))
    assert names_reached(crossing, roadmap, 0, "south") == {"south", "north", "far_north"}
    assert "2 lanes of navigation graphs without robots are left out." in roadmap.notes
    assert not any("touch" in note for note in roadmap.notes)


@pytest.mark.parametrize("seed", range(10))
def test_random_starts_and_goals_lie_on_the_graph_of_their_robot(crossing, make_fleet, seed):
    fleet = make_fleet(0.1, 0.1, 0.1, graphs=[0, 1, 0])
    roadmap = Graph().build(crossing, fleet)
    scenario = Random(robots=3).draw(crossing, roadmap, fleet, seed)
    east, north = {"west", "east", "far_east"}, {"south", "north", "far_north"}
    for own, start, task in zip((east, north, east), scenario.start_names, scenario.tasks, strict=True):
        assert start in own
        assert task.name in own
    assert len(set(scenario.start_names)) == 3
    assert np.isfinite(scenario.start[:, :2]).all()


def test_a_graph_without_lanes_and_rasters_are_refused(crossing, make_fleet):
    with pytest.raises(InputError, match=r"no lane of graph 4 \(graphs: 0, 1\)"):
        Graph().build(crossing, make_fleet(0.1, graphs=[4]))
    with pytest.raises(InputError, match="cannot keep to a navigation graph"):
        GridRoadmap().build(crossing, make_fleet(0.1, graphs=[0]))
    crowded = make_fleet(*[0.1] * 4, graphs=[0] * 4)
    with pytest.raises(InputError, match="no place on graph 0 is left"):
        Random(robots=4).draw(crossing, Graph().build(crossing, crowded), crowded, 0)


def test_robots_of_one_model_on_two_graphs_have_two_motion_profiles(crossing, make_fleet):
    fleet = make_fleet(0.1, 0.1, graphs=[0, 1])
    assert fleet.profiles[1] == (0, 1)
    assert Graph().build(attrs.evolve(crossing), fleet).duration.shape[0] == 2
