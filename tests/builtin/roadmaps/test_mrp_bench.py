"""Table I of the original benchmark, and the same rule at its default cell size."""

import numpy as np
import pytest
from mrpbench_worlds_standard.rmf import Rmf

from mrpbench_core.builtin.roadmaps.lanes import Lanes
from mrpbench_core.builtin.roadmaps.mrp_bench import mrp_bench_raster
from mrpbench_core.checking.components import components
from mrpbench_core.checking.navigation import unique_edges
from mrpbench_core.model.worlds.world import Lane, Level, Vertex, World


@pytest.mark.parametrize(
    ("name", "cell_size", "vertices", "edges", "shape", "free"),
    [
        ("office", 0.4, 29, 32, (25, 41), 333),
        ("airport_terminal", 0.4, 210, 211, (151, 700), 7645),
        ("warehouse", 0.4, 54, 40, (59, 51), 788),
        ("office_crowdsim", 0.4, 25, 28, (25, 38), 310),
        ("office", 0.35, 29, 32, (28, 46), 391),
        ("airport_terminal", 0.35, 210, 211, (172, 800), 8772),
        ("warehouse", 0.35, 54, 40, (67, 58), 914),
    ],
)
def test_the_original_raster_is_reproduced_exactly(
    shared_data, make_fleet, name, cell_size, vertices, edges, shape, free
):
    world = Rmf(file=shared_data / f"rmf/mrp_bench/{name}.building.yaml", doors="open").load()  # it knows no doors
    roadmap = Lanes(cell_size=cell_size, compatible="mrp_bench").build(world, make_fleet(0.125))
    assert (len(world.vertices), len(unique_edges(world))) == (vertices, edges)
    assert roadmap.grid.shape == shape
    assert len(roadmap.position) == free
    assert len(set(components(len(roadmap.position), roadmap.edges))) == 1


def test_vertices_of_the_airport_share_as_many_cells_as_in_the_original(shared_data, make_fleet):
    world = Rmf(file=shared_data / "rmf/mrp_bench/airport_terminal.building.yaml").load()
    for cell_size, cells in ((0.4, 190), (0.35, 188)):
        roadmap = Lanes(cell_size=cell_size, compatible="mrp_bench").build(world, make_fleet(0.125))
        assert len(np.unique(roadmap.place)) == cells


def test_cells_start_at_the_lowest_vertex(two_rooms, make_fleet):
    roadmap = Lanes(cell_size=0.4, compatible="mrp_bench").build(two_rooms, make_fleet(0.1))
    assert roadmap.grid.origin == (1, 1.5)
    assert roadmap.position[roadmap.place[0]].tolist() == pytest.approx([1.2, 1.7])


def test_edges_through_walls_are_kept_and_counted(shared_data, make_fleet):
    world = Rmf(file=shared_data / "rmf/mrp_bench/office.building.yaml").load()
    roadmap = Lanes(compatible="mrp_bench").build(world, make_fleet(0.125))
    assert roadmap.notes == ("15 of the raster's edges on which a robot would touch something are kept.",)


SQUARE = [(0, 0), (6, 0), (6, 6), (0, 6)]


@pytest.mark.parametrize(
    ("points", "lanes", "drawn"),
    [
        # Of two steps that are as near to the line, the second is taken: east first, or west first on the way back.
        ([(0, 0), (3, 3)], [(0, 1)], ["###.", "#...", "....", "...#"]),
        ([(3, 3), (0, 0)], [(0, 1)], ["#...", "...#", "...#", "..##"]),
        # East, north, three times east, north and east; narrow cells open their left and lower neighbours.
        ([(0, 0), (5, 2)], [(0, 1)], ["###...", ".....#", ".....#"]),
        # A lane inside is widened to one side, and ends where its places are.
        (
            [(0, 0), (6, 6), (3, 3), (3, 6)],
            [(2, 3)],
            ["###.###", "##..###", "##..###", "###.###", "#######", "#######", "#######"],
        ),
        # Lanes on the lower and the left border look at the opposite border, which is closed, and are widened inwards.
        (SQUARE, [(0, 1)], ["#######"] * 5 + ["#.....#", "......."]),
        (SQUARE, [(0, 3)], [".######"] + ["..#####"] * 5 + [".######"]),
        # The opposite border has a lane of its own: every other cell of it is widened, and of the lower border, too.
        (SQUARE, [(0, 1), (2, 3)], [".......", "#.#.#.#", "#######", "#######", "#######", "#.#.#.#", "......."]),
        (SQUARE, [(0, 3), (1, 2)], [".#####.", *["..###..", ".#####."] * 3]),
    ],
)
@pytest.mark.parametrize("cell", [1.0, 0.5])
def test_roads_are_walked_and_widened_as_in_the_original(points, lanes, drawn, cell):
    """Worked out by hand from the rules in the module's docstring; the top row of a drawing is the highest."""
    world = World(
        name="drawn",
        levels=(Level(name="L1"),),
        vertices=tuple(Vertex(name=str(number), x=x * cell, y=y * cell) for number, (x, y) in enumerate(points)),
        lanes=tuple(Lane(start=start, end=end) for start, end in lanes),
    )
    found = mrp_bench_raster(world, cell)
    assert ["".join(".#"[int(it)] for it in row) for row in found.blocked[::-1]] == drawn
    assert found.origin == (0, 0)
