from mrpbench_core.checking.navigation import crossings, duplicates, unique_edges, vertices_on_lanes
from mrpbench_core.model.worlds.world import Lane, Level, Vertex, World


def world_of(points, *pairs, graphs=()) -> World:
    return World(
        name="",
        levels=(Level(name=""),),
        vertices=tuple(Vertex(name="", x=x, y=y) for x, y in points),
        lanes=tuple(
            Lane(start=start, end=end, graph=graph)
            for (start, end), graph in zip(pairs, graphs or [0] * len(pairs), strict=True)
        ),
    )


def test_lanes_of_different_graphs_need_not_join():
    points = [(0, 0), (2, 2), (0, 2), (2, 0), (1, 1), (9, 9)]
    apart = world_of(points, (0, 1), (2, 3), (4, 5), graphs=(0, 1, 2))
    assert (crossings(apart), vertices_on_lanes(apart)) == ([], [])
    one = world_of(points, (0, 1), (2, 3), (4, 5), graphs=(1, 1, 0))
    assert (crossings(one), vertices_on_lanes(one)) == ([((0, 1), (2, 3))], [])


def test_an_edge_counts_once_in_any_direction_and_graph():
    world = world_of([(0, 0), (1, 0), (0, 0), (1, 0), (2, 0)], (0, 1), (1, 0), (2, 3), (3, 4))
    assert unique_edges(world) == [(2, 3), (3, 4)]
    assert duplicates(world) == [(0, 2), (1, 3)]


def test_a_crossing_needs_no_common_vertex():
    world = world_of([(0, 0), (2, 2), (0, 2), (2, 0), (4, 4)], (0, 1), (2, 3), (1, 4))
    assert crossings(world) == [((0, 1), (2, 3))]
    assert vertices_on_lanes(world) == []


def test_a_vertex_on_a_lane_is_found_but_not_its_ends():
    world = world_of([(0, 0), (4, 0), (2, 0.01), (2, 3), (2, 0.5)], (0, 1), (2, 3))
    assert vertices_on_lanes(world) == [(2, (0, 1)), (4, (2, 3))]


def test_levels_do_not_meet():
    world = World(
        name="",
        levels=(Level(name="a"), Level(name="b")),
        vertices=tuple(
            Vertex(name="", x=x, y=y, level=level)
            for x, y, level in [(0, 0, 0), (2, 2, 0), (0, 2, 1), (2, 0, 1), (1, 1, 1), (0, 0, 1)]
        ),
        lanes=(Lane(start=0, end=1), Lane(start=2, end=3)),
    )
    assert crossings(world) == []
    assert vertices_on_lanes(world) == [(4, (2, 3))]
    assert duplicates(world) == []


def test_a_world_without_lanes_has_nothing_to_find():
    world = world_of([])
    assert (unique_edges(world), crossings(world), vertices_on_lanes(world), duplicates(world)) == ([], [], [], [])
