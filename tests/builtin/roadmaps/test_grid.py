import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_worlds_standard.movingai import MovingAi
from mrpbench_worlds_standard.rmf import Rmf

from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.checking.components import components
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet, RobotModel
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Level, Vertex, World

DISC = np.array([[1, 0], [0, 1], [-1, 0], [0, -1]])


def gaps_to_walls(walls, points):
    """Distances f8[W,n] of points from the boxes of walls 0.1 m thick, each in its box's own frame."""
    walls = np.asarray(walls, float)
    centre, half = (walls[:, :2] + walls[:, 2:]) / 2, (walls[:, 2:] - walls[:, :2]) / 2
    length = np.hypot(*half.T)
    ahead = half / length[:, None]
    offset = points[None] - centre[:, None]
    along = np.abs((offset * ahead[:, None]).sum(-1)) - (length + 0.05)[:, None]
    across = np.abs(offset[..., 1] * ahead[:, None, 0] - offset[..., 0] * ahead[:, None, 1]) - 0.05
    return np.hypot(np.maximum(along, 0), np.maximum(across, 0))


def least_gap(roadmap, walls):
    """Least distance of any sampled point on any edge from any wall."""
    start, end = roadmap.position[roadmap.edges[:, 0]], roadmap.position[roadmap.edges[:, 1]]
    return min(gaps_to_walls(walls, start + share * (end - start)).min() for share in np.linspace(0, 1, 21))


@settings(deadline=None, max_examples=40)
@given(
    st.lists(st.tuples(*[st.floats(0, 5).map(lambda value: round(value, 2))] * 4), max_size=5),
    st.sampled_from([0.1, 0.2, 0.35]),
    st.sampled_from([0.3, 0.4]),
)
def test_robots_keep_clear_of_walls_everywhere(inner, radius, cell_size):
    outer = [(0, 0, 5, 0), (5, 0, 5, 5), (5, 5, 0, 5), (0, 5, 0, 0)]
    walls = outer + [wall for wall in inner if wall[:2] != wall[2:]]
    world = World(name="", levels=(Level(name="", walls=walls),))
    fleet = Fleet(robots=(RobotModel(name="", footprint=radius * DISC, max_speed=1, max_turn_rate=1),))
    try:
        roadmap = GridRoadmap(cell_size=cell_size).build(world, fleet)
    except InputError:
        return
    assert gaps_to_walls(walls, roadmap.position).min() >= radius - 1e-9
    if len(roadmap.edges):
        assert least_gap(roadmap, walls) >= radius - 1e-9
    assert len(set(components(len(roadmap.position), roadmap.edges))) == 1


def test_no_cell_is_left_out_without_reason(two_rooms, make_fleet):
    """Against cells judged one by one with the walls' boxes, and a search from a place."""
    roadmap = GridRoadmap(cell_size=0.3).build(two_rooms, make_fleet(0.2))
    walls = two_rooms.levels[0].walls
    rows, columns = roadmap.grid.shape
    cells = [(row, column) for row in range(rows) for column in range(columns)]
    centres = np.array([(column + 0.5, row + 0.5) for row, column in cells]) * 0.3 + roadmap.grid.origin
    fits = gaps_to_walls(walls, centres).min(axis=0) >= 0.2
    free = {cell for cell, fit in zip(cells, fits, strict=True) if fit}
    where = dict(zip(cells, centres, strict=True))
    reached = {tuple(roadmap.grid.cell[roadmap.place[0]])}
    frontier = list(reached)
    while frontier:
        row, column = frontier.pop()
        for cell in ((row + 1, column), (row - 1, column), (row, column + 1), (row, column - 1)):
            if cell in free and cell not in reached:
                way = where[row, column] + np.linspace(0, 1, 50)[:, None] * (where[cell] - where[row, column])
                if gaps_to_walls(walls, way).min() >= 0.2:
                    reached.add(cell)
                    frontier.append(cell)
    assert {tuple(cell) for cell in roadmap.grid.cell.tolist()} == reached


def test_the_gap_is_open_to_a_small_robot_only(two_rooms, make_fleet):
    narrow = GridRoadmap(cell_size=0.1).build(two_rooms, make_fleet(0.44))
    label = components(len(narrow.position), narrow.edges)
    assert label[narrow.place[0]] == label[narrow.place[1]]
    wide = GridRoadmap(cell_size=0.1).build(two_rooms, make_fleet(0.46))
    label = components(len(wide.position), wide.edges)
    assert label[wide.place[0]] != label[wide.place[1]]


def test_the_largest_robot_decides(two_rooms, make_fleet):
    mixed = GridRoadmap().build(two_rooms, make_fleet(0.1, 0.3))
    assert len(mixed.position) == len(GridRoadmap().build(two_rooms, make_fleet(0.3)).position)


def test_a_tick_is_a_cell_at_the_slowest_robots_speed(two_rooms, make_fleet):
    roadmap = GridRoadmap(cell_size=0.4).build(two_rooms, make_fleet(0.1, 0.1, speeds=[1.0, 0.5]))
    assert roadmap.tick == pytest.approx(0.8)
    assert roadmap.duration.shape == (2, len(roadmap.edges))
    assert (roadmap.duration == 1).all()


def test_edges_run_both_ways_between_neighbours(two_rooms, make_fleet):
    roadmap = GridRoadmap().build(two_rooms, make_fleet(0.1))
    edges = set(map(tuple, roadmap.edges.tolist()))
    assert len(edges) == len(roadmap.edges)
    assert all((b, a) in edges for a, b in edges)
    step = np.abs(roadmap.grid.cell[roadmap.edges[:, 0]] - roadmap.grid.cell[roadmap.edges[:, 1]])
    assert (step.sum(axis=1) == 1).all()


def test_places_lie_in_their_cells_and_the_outside_is_left_out(two_rooms, make_fleet):
    roadmap = GridRoadmap().build(two_rooms, make_fleet(0.1))
    assert roadmap.locate(np.array([[1, 1.5], [5, 1.5]]), np.zeros(2, np.int16)).tolist() == roadmap.place.tolist()
    outside = attrs.evolve(two_rooms, vertices=(*two_rooms.vertices, Vertex(name="street", x=9, y=9)))
    beyond = GridRoadmap().build(outside, make_fleet(0.1))
    assert (beyond.place >= 0).all()
    x, y = roadmap.position.T
    assert ((x > 0) & (x < 6) & (y > 0) & (y < 4)).all()


def test_a_place_in_a_wall_is_noted(two_rooms, make_fleet):
    world = attrs.evolve(two_rooms, vertices=(*two_rooms.vertices, Vertex(name="safe", x=3, y=3)))
    roadmap = GridRoadmap().build(world, make_fleet(0.1))
    assert roadmap.place.tolist()[2] == -1
    assert roadmap.notes == ("No robot can stand at safe.",)


def test_a_place_is_never_moved_through_a_wall(make_fleet):
    """The place's own cell has its centre on the other side of the wall."""
    walls = [[0, 0, 4, 0], [4, 0, 4, 4], [4, 4, 0, 4], [0, 4, 0, 0], [2.03, 0, 2.03, 4]]
    world = World(name="", levels=(Level(name="", walls=walls),), vertices=(Vertex(name="a", x=2.13, y=2),))
    roadmap = GridRoadmap(cell_size=0.5).build(world, make_fleet(0.1))
    assert roadmap.position[roadmap.place[0]][0] > 2.03
    assert (roadmap.position[:, 0] > 2.03).all()


def test_a_raster_is_taken_cell_by_cell(make_fleet):
    blocked = np.array([[0, 1, 0], [0, 1, 0]], bool)
    world = World(name="", levels=(Level(name="", occupancy=Occupancy(blocked=blocked, resolution=1.0)),))
    for builder in (GridRoadmap(), GridRoadmap(cell_size=1.0)):
        roadmap = builder.build(world, make_fleet(0.5))
        assert roadmap.grid.cell.tolist() == [[0, 0], [0, 2], [1, 0], [1, 2]]
        assert roadmap.edges.tolist() == [[0, 2], [1, 3], [2, 0], [3, 1]]


def test_a_robot_larger_than_a_raster_cell_keeps_its_distance(make_fleet):
    blocked = np.zeros((5, 5), bool)
    blocked[0, 0] = True
    world = World(name="", levels=(Level(name="", occupancy=Occupancy(blocked=blocked, resolution=1.0)),))
    roadmap = GridRoadmap().build(world, make_fleet(1.0))
    cells = {tuple(cell) for cell in roadmap.grid.cell.tolist()}
    assert cells == {(row, column) for row in (1, 2, 3) for column in (1, 2, 3)} - {(1, 1)}


def test_another_cell_size_rasterises_a_raster_anew(make_fleet):
    world = World(name="", levels=(Level(name="", occupancy=Occupancy(blocked=[[False, True]], resolution=1.0)),))
    roadmap = GridRoadmap(cell_size=0.25).build(world, make_fleet(0.1))
    assert roadmap.grid.shape == (4, 8)
    assert len(roadmap.position) == 16


def test_agrees_with_the_native_grid_of_a_public_map(shared_data, make_fleet):
    world = MovingAi(file=shared_data / "movingai/maps/random-64-64-20.map").load()
    fleet = make_fleet(0.3)
    fine = GridRoadmap(cell_size=1.0000000001).build(world, fleet)  # not 1:1: through the sweep test
    plain = GridRoadmap().build(world, fleet)
    label = components(len(plain.position), plain.edges)
    largest = np.bincount(label).max()
    assert len(fine.position) == largest


@pytest.mark.parametrize("walls", [[], [[0, 0, 0.1, 0]]])
def test_a_world_without_room_is_refused(make_fleet, walls):
    with pytest.raises(InputError):
        GridRoadmap().build(World(name="dot", levels=(Level(name="", walls=walls),)), make_fleet(0.3))


def test_a_cell_size_that_is_surely_a_slip_is_refused(make_fleet):
    walls = [[0, 0, 60, 0], [60, 0, 60, 40], [60, 40, 0, 40], [0, 40, 0, 0]]
    with pytest.raises(InputError, match="cells"):
        GridRoadmap(cell_size=0.01).build(World(name="hall", levels=(Level(name="", walls=walls),)), make_fleet(0.1))
    with pytest.raises(ValueError, match="cell_size"):
        GridRoadmap(cell_size=0.0001)


def test_a_large_map_keeps_all_its_places(shared_data, make_fleet):
    airport = Rmf(file=shared_data / "rmf/mrp_bench/airport_terminal.building.yaml").load()
    roadmap = GridRoadmap().build(airport, make_fleet(0.125))
    assert (roadmap.place >= 0).all()
