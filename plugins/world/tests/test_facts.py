import attrs
import numpy as np
import pytest
from mrpbench_world.facts import check_world, size

from mrpbench_core.model.planning.roadmap import Raster, Roadmap
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Door, Lane, Level, Obstacle, Vertex, World


def roadmap_of(position, edges=(), place=(), grid=None) -> Roadmap:
    return Roadmap(
        position=position,
        level=np.zeros(len(position)),
        heading=np.full(len(position), np.nan),
        edges=list(edges),
        duration=np.ones((1, len(edges))),
        tick=1.0,
        grid=grid,
        place=list(place),
        notes=("left out.",),
    )


def world_of(*places, lanes=(), walls=(), notes=()) -> World:
    return World(
        name="w",
        levels=(Level(name="", walls=list(walls)),),
        vertices=tuple(Vertex(name=name, x=x, y=y) for name, x, y in places),
        lanes=tuple(Lane(start=a, end=b) for a, b in lanes),
        notes=notes,
    )


def test_cells_are_counted_on_a_raster_only():
    world = world_of(("a", 0.5, 0.5), ("b", 1.5, 0.5), lanes=[(0, 1)], walls=[[0, 0, 3, 0]], notes=("assumed.",))
    grid = Raster(shape=(2, 3), cell_size=1.0, origin=(0.0, 0.0), cell=[[0, 0], [0, 1]])
    facts = check_world(world, roadmap_of([[0.5, 0.5], [1.5, 0.5]], [[0, 1], [1, 0]], [0, 1], grid), 0.2)
    assert (facts.cells, facts.free, facts.blocked) == (6, 2, 4)
    assert (facts.vertices, facts.edges, facts.components, facts.walls) == (2, 1, 1, 1)
    assert (facts.roadmap_vertices, facts.roadmap_edges, facts.roadmap_components) == (2, 2, 1)
    assert (facts.width, facts.height) == pytest.approx((3.1, 0.1))
    assert facts.faults == ()
    assert facts.notes == ("assumed.", "left out.")
    graph = check_world(world, roadmap_of([[0.5, 0.5], [1.5, 0.5]], [[0, 1], [1, 0]], [0, 1]), 0.2)
    assert (graph.cells, graph.free, graph.blocked) == (None, None, None)


def test_pieces_of_the_graph_are_counted_by_position():
    places = [("a", 0, 0), ("b", 1, 0), ("a2", 0, 0), ("c", 2, 5), ("d", 8, 8), ("e", 9, 9)]
    facts = check_world(world_of(*places, lanes=[(0, 1), (2, 3), (4, 5)]), roadmap_of([[0, 0]], place=[0] * 6), 0.1)
    assert facts.components == 2


def test_every_kind_of_fault_is_named():
    world = world_of(
        ("in_wall", 5, 5), ("tight", 3, 4.85), ("a", 0, 0), ("b", 4, 0),
        ("", 2, 0), ("c", 1, -1), ("d", 1, 1), ("a", 0, 0),
        lanes=[(2, 3), (5, 6), (0, 3)],
        walls=[[2, 5, 8, 5]],
    )  # fmt: skip
    roadmap = roadmap_of([[0, 0], [4, 0], [9, 9]], [[0, 1], [1, 0]], [-1, 2, 0, 1, 0, 0, 0, 0])
    assert check_world(world, roadmap, 0.2).faults == (
        "(2.00, 0.00) lies on lane b – a without joining it",
        "lanes b – a and c – d cross without a vertex",
        "in_wall lies inside something solid",
        "tight is nearer than 0.200 m to something solid",
        "lane in_wall – b passes something solid nearer than 0.200 m",
        "in_wall cannot be reached on the roadmap",
        "tight cannot be reached on the roadmap",
        "a is 2 vertices in one position",
    )


def test_places_of_several_graphs_are_facts_and_repeated_vertices_faults():
    places = [("a", 0, 0), ("b", 4, 0), ("b", 4, 0), ("c", 4, 4)]
    roadmap = roadmap_of([[0, 0], [4, 0], [4, 4]], [[0, 1], [1, 2]], [0, 1, 1, 2])
    for graphs, shared, faults in (((0, 1), 1, ()), ((1, 1), 0, ("b is 2 vertices in one position",))):
        lanes = tuple(Lane(start=2 * i, end=2 * i + 1, graph=graph) for i, graph in enumerate(graphs))
        world = attrs.evolve(world_of(*places), lanes=lanes)
        facts = check_world(world, roadmap, 0.1)
        assert (facts.shared, facts.faults, facts.components) == (shared, faults, 1)


def test_a_name_of_several_places_or_doors_is_a_fault():
    door = Door(name="gate", start=(9, 0), end=(9, 1))
    world = world_of(("dock", 1, 1), ("dock", 5, 1), ("", 3, 1), ("", 7, 1), lanes=[(0, 1), (2, 3)])
    world = attrs.evolve(world, levels=(Level(name="", doors=(door, attrs.evolve(door, end=(9, 2)))),))
    faults = check_world(world, roadmap_of([[1, 1]], place=[0] * 4), 0.1).faults
    assert "2 places are named dock: (1.00, 1.00), (5.00, 1.00)" in faults
    assert "2 doors are named gate" in faults


def test_narrow_passages_and_all_levels_are_reported():
    walls = [[0, 0, 2, 0], [2.3, 0, 4, 0]]
    world = attrs.evolve(
        world_of(("a", 1, 1), walls=walls),
        levels=(Level(name="G", walls=walls), Level(name="U", walls=[[0, 0, 9, 0]])),
    )
    facts = check_world(world, roadmap_of([[1, 1]], place=[0]), 0.125)
    assert (facts.levels, facts.walls) == (2, 3)
    assert facts.width == pytest.approx(9.1)
    assert facts.narrow == ("the passage at (2.15, -0.05) on level G is 0.200 m wide, the robot needs 0.250 m",)
    assert check_world(world, roadmap_of([[1, 1]], place=[0]), 0.09).narrow == ()


def test_faults_on_upper_levels_are_found():
    level = Level(name="U", walls=[[0, 0, 9, 0]])
    world = attrs.evolve(world_of(("a", 1, 0), ("b", 5, 3), lanes=[(0, 1)]), levels=(Level(name="G"), level))
    world = attrs.evolve(world, vertices=tuple(attrs.evolve(vertex, level=1) for vertex in world.vertices))
    faults = check_world(world, roadmap_of([[1, 1]], place=[-1, -1]), 0.1).faults
    assert faults == ("a lies inside something solid", "lane a – b passes something solid nearer than 0.100 m")


def test_size_covers_rasters_obstacles_and_places():
    assert size(World(name="", levels=(Level(name=""),))) == (0, 0)
    assert size(world_of(("a", 1, 1), ("b", 4, 3))) == (3, 2)
    raster = Level(name="", occupancy=Occupancy(blocked=np.zeros((4, 6), bool), resolution=0.5))
    assert size(World(name="", levels=(raster,))) == (3, 2)
    table = Level(name="", obstacles=(Obstacle(name="", polygon=[[0, 0], [2, 0], [2, 1]]),))
    assert size(World(name="", levels=(table,))) == (2, 1)
