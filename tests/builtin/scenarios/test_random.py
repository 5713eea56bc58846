"""Random scenarios are feasible, reproducible, and, where asked for, those of the original."""

import attrs
import numpy as np
import pytest

from mrpbench_core.builtin.scenarios.random import Random
from mrpbench_core.checking.scenario import check_scenario
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet, RobotModel
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_core.model.planning.roadmap import Raster, Roadmap
from mrpbench_core.model.worlds.world import Vertex, World

WORLD = World(name="plain", levels=())


def fleet_of(count, radius=0.1):
    model = RobotModel(name="disc", footprint=[[radius, 0], [0, radius], [-radius, 0]], max_speed=1, max_turn_rate=1)
    return Fleet(robots=(model,) * count)


def raster(rows, columns, cell_size=1.0, walls=()):
    """A four-connected grid without the cells `walls`."""
    cells = [(row, column) for row in range(rows) for column in range(columns) if (row, column) not in walls]
    index = {cell: vertex for vertex, cell in enumerate(cells)}
    edges = [
        (index[cell], index[near])
        for cell in cells
        for near in ((cell[0] + 1, cell[1]), (cell[0] - 1, cell[1]), (cell[0], cell[1] + 1), (cell[0], cell[1] - 1))
        if near in index
    ]
    return Roadmap(
        position=[((column + 0.5) * cell_size, (row + 0.5) * cell_size) for row, column in cells],
        level=[0] * len(cells),
        heading=[np.nan] * len(cells),
        edges=edges,
        duration=[[1] * len(edges)],
        tick=1.0,
        grid=Raster(shape=(rows, columns), cell_size=cell_size, origin=(0.0, 0.0), cell=cells),
    )


def posed(roadmap, fleet, scenario):
    return Problem(
        roadmap=roadmap,
        profile=[0] * len(fleet),
        radius=fleet.radii,
        start=roadmap.locate(scenario.start[:, :2], scenario.start_level),
        ready=[0] * len(fleet),
        goals=tuple(((int(roadmap.locate(task.goals[:, :2], task.levels)[0]),),) for task in scenario.tasks),
        features=frozenset({Feature.FOOTPRINTS}),
    )


@pytest.mark.parametrize("seed", range(20))
def test_every_draw_is_feasible_on_a_divided_map_with_wide_robots(seed):
    walls = {(row, 4) for row in range(10)}
    roadmap = raster(10, 15, cell_size=0.5, walls=walls)
    fleet = fleet_of(8, radius=0.4)
    scenario = Random(robots=8).draw(WORLD, roadmap, fleet, seed)
    assert check_scenario(posed(roadmap, fleet, scenario)) == []
    assert (scenario.start[:, 0] > 2.5).all()  # the larger side of the wall


def test_all_of_the_map_is_used_and_every_vertex_is_as_likely():
    roadmap = raster(3, 3)
    drawn = [Random(robots=1).draw(WORLD, roadmap, fleet_of(1), seed) for seed in range(900)]
    for places in (np.array([s.start[0, :2] for s in drawn]), np.array([s.tasks[0].goals[0, :2] for s in drawn])):
        _, counts = np.unique(places, axis=0, return_counts=True)
        assert len(counts) == 9
        assert ((counts - 100) ** 2 / 100).sum() < 26.1  # chi-square, 8 degrees of freedom, p = 0.001
    assert any((s.start[0, :2] == s.tasks[0].goals[0, :2]).all() for s in drawn)


def test_a_draw_depends_on_the_seed_alone_and_a_smaller_fleet_is_a_part_of_a_larger():
    roadmap = raster(6, 6)
    five, nine = (Random(robots=n).draw(WORLD, roadmap, fleet_of(n), 7) for n in (5, 9))
    assert five == Random(robots=5).draw(WORLD, roadmap, fleet_of(5), 7)
    assert five.id != Random(robots=5).draw(WORLD, roadmap, fleet_of(5), 8).id
    assert np.array_equal(five.start, nine.start[:5], equal_nan=True)
    assert five.tasks == nine.tasks[:5]


def test_the_published_stream_does_not_change():
    """Written out so that a change of NumPy or of this file cannot silently change published scenarios."""
    scenario = Random(robots=4).draw(WORLD, raster(4, 4), fleet_of(4), 0)
    numbers = np.random.Generator(np.random.PCG64(np.random.SeedSequence([0, 0]))).random(16)
    assert scenario.start[:, :2].tolist() == [[i % 4 + 0.5, i // 4 + 0.5] for i in np.argsort(numbers)[:4]]
    assert scenario.start[:, :2].tolist() == [[3.5, 2.5], [3.5, 0.5], [1.5, 3.5], [2.5, 0.5]]


@pytest.mark.parametrize("seed", [-1, 2**70])
def test_any_integer_is_a_seed(seed):
    assert len(Random(robots=2).draw(WORLD, raster(3, 3), fleet_of(2), seed).start) == 2


def test_too_many_robots_are_refused_with_the_number_that_fits():
    walls = {(0, 1)}
    with pytest.raises(InputError, match=r"3 robots do not fit: .* 2 places that connect"):
        Random(robots=3).draw(WORLD, raster(1, 4, walls=walls), fleet_of(3), 0)
    with pytest.raises(InputError, match=r"at which [12] robots can start 2\.40 m apart"):
        Random(robots=3).draw(WORLD, raster(1, 4), fleet_of(3, radius=1.2), 0)


def test_no_vertex_at_all_is_refused():
    empty = Roadmap(position=np.empty((0, 2)), level=[], heading=[], edges=[], duration=[[]], tick=1.0)
    with pytest.raises(InputError, match="0 places"):
        Random(robots=1).draw(WORLD, empty, fleet_of(1), 0)


def test_one_way_streets_do_not_trap_a_robot():
    roadmap = raster(1, 4)
    one_way = attrs.evolve(roadmap, edges=[(0, 1), (1, 2), (2, 3), (3, 2), (2, 1)], duration=[[1] * 5])
    for seed in range(10):
        scenario = Random(robots=2).draw(WORLD, one_way, fleet_of(2), seed)
        assert (scenario.start[:, 0] > 1).all()
        assert all(task.goals[0, 0] > 1 for task in scenario.tasks)


NAMED = World(
    name="named",
    levels=(),
    vertices=(
        Vertex(name="a", x=0.5, y=0.5),
        Vertex(name="a_again", x=0.6, y=0.5),
        Vertex(name="b", x=2.5, y=0.5),
        Vertex(name="c", x=2.5, y=2.5),
        Vertex(name="outside", x=9.0, y=9.0),
    ),
)


def test_the_worlds_places_are_used_where_it_has_any():
    drawn = [Random(robots=3).draw(NAMED, raster(3, 3), fleet_of(3), seed) for seed in range(10)]
    assert all(set(s.start_names) == {"a", "b", "c"} for s in drawn)  # one name per cell, none outside the roadmap
    assert all({task.name for task in s.tasks} == {"a", "b", "c"} for s in drawn)
    assert len({s.start_names for s in drawn}) > 1


def test_places_near_one_another_in_different_cells_are_both_used():
    """Robots stand at the centres of cells, not at the places."""
    near = attrs.evolve(NAMED, vertices=(Vertex(name="a", x=0.99, y=0.5), Vertex(name="b", x=1.01, y=0.5)))
    scenario = Random(robots=2).draw(near, raster(3, 3), fleet_of(2), 0)
    assert set(scenario.start_names) == {"a", "b"}


def test_a_place_that_the_roadmap_left_out_is_not_used():
    roadmap = attrs.evolve(raster(3, 3), grid=None, place=[0, -1, 2, -1, -1])
    scenario = Random(robots=2).draw(NAMED, roadmap, fleet_of(2), 0)
    assert set(scenario.start_names) == {"a", "b"}


def test_the_originals_draw_takes_all_vertices_as_they_come():
    scenario = Random(robots=5, compatible="mrp_bench").draw(NAMED, raster(1, 1), fleet_of(5), 3000)
    assert sorted(scenario.start_names) == ["a", "a_again", "b", "c", "outside"]
    with pytest.raises(InputError, match="6 robots do not fit: world named has 5 navigation vertices"):
        Random(robots=6, compatible="mrp_bench").draw(NAMED, raster(1, 1), fleet_of(6), 3000)


@pytest.mark.parametrize(
    ("name", "seed", "starts", "goals"),
    [
        ("office", 3000, "puffin pantry dugong monkey woodpecker", "dugong mayfly frog pantry blue_whale"),
        ("warehouse", 333, "seal bobcat", "puffin seal"),
    ],
)
def test_the_originals_scenarios_come_out_again(shared_data, name, seed, starts, goals):
    rmf = pytest.importorskip("mrpbench_worlds_standard.rmf")
    world = rmf.Rmf(file=shared_data / "rmf" / "mrp_bench" / f"{name}.building.yaml").load()
    count = len(starts.split())
    scenario = Random(robots=count, compatible="mrp_bench").draw(world, raster(1, 1), fleet_of(count), seed)
    assert " ".join(scenario.start_names) == starts
    assert " ".join(task.name for task in scenario.tasks) == goals
