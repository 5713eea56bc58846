import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_exporters_rosbag2 import raster
from mrpbench_exporters_rosbag2.raster import block, rasterise, wall_outline

from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Level, Obstacle, Vertex, World


def world(**level):
    return World(name="w", levels=(Level(name="L1", **level),))


def test_a_wall_blocks_the_cells_of_its_box_and_no_other():
    found = rasterise(world(walls=[[1.0, 1.0, 2.0, 1.0]], wall_thickness=0.1), 0, 0.05)
    rows, columns = np.nonzero(found.blocked)
    x, y = found.origin[0] + 0.05 * columns, found.origin[1] + 0.05 * rows
    assert (x.min(), x.max() + 0.05) == (pytest.approx(0.95), pytest.approx(2.05))
    assert (y.min(), y.max() + 0.05) == (pytest.approx(0.95), pytest.approx(1.05))
    assert len(rows) == 22 * 2


def test_walls_thinner_than_a_cell_leave_no_gap():
    found = rasterise(world(walls=[[0.0, 0.0, 3.1, 1.7]], wall_thickness=0.001), 0, 0.05)
    along = np.linspace([0, 0], [3.1, 1.7], 5000)
    assert found.blocked[tuple(found.cells(along).T)].all()
    assert found.blocked.sum() < 200


@given(
    st.lists(st.tuples(st.integers(0, 40), st.integers(0, 40)), min_size=3, max_size=6),
    st.floats(-0.3, 0.3),
    st.floats(-0.3, 0.3),
)
def test_a_cell_is_blocked_where_sampling_finds_the_polygon(corners, dx, dy):
    polygon = np.array(corners) / 4 + [dx, dy]
    blocked = np.zeros((11, 11), bool)
    block(blocked, polygon)
    spots = (np.arange(11 * 8) + 0.5) / 8
    x, y = np.meshgrid(spots, spots)
    inside = np.zeros(x.shape, bool)  # oracle: even-odd by winding of crossings, at many points of each cell
    for (x1, y1), (x2, y2) in zip(polygon, np.roll(polygon, 1, axis=0), strict=True):
        if y1 != y2:
            inside ^= (np.minimum(y1, y2) <= y) & (y < np.maximum(y1, y2)) & (x < x1 + (y - y1) / (y2 - y1) * (x2 - x1))
    sampled = inside.reshape(11, 8, 11, 8).any(axis=(1, 3))
    assert not (sampled & ~blocked).any()
    low, high = polygon.min(axis=0), polygon.max(axis=0)
    rows, columns = np.nonzero(blocked)
    assert ((columns + 1 > low[0]) & (columns < high[0]) & (rows + 1 > low[1]) & (rows < high[1])).all()


def test_a_cell_fully_outside_is_free():
    blocked = np.zeros((10, 10), bool)
    block(blocked, np.array([[2.0, 2.0], [8.0, 2.0], [8.0, 4.0], [4.0, 4.0], [4.0, 8.0], [2.0, 8.0]]))  # an L
    expected = np.zeros((10, 10), bool)
    expected[2:4, 2:8] = expected[2:8, 2:4] = True
    assert np.array_equal(blocked, expected)


def test_a_level_that_is_a_raster_keeps_its_cells_and_gets_its_walls():
    cells = np.zeros((4, 5), bool)
    cells[3, 0] = True
    level = {"occupancy": Occupancy(blocked=cells, resolution=1.0, origin=(10.0, 20.0)), "wall_thickness": 0.1}
    found = rasterise(world(walls=[[12.5, 20.5, 13.5, 20.5]], **level), 0, 0.05)
    assert (found.resolution, found.origin) == (1.0, (10.0, 20.0))
    assert sorted(zip(*np.nonzero(found.blocked), strict=True)) == [(0, 2), (0, 3), (3, 0)]


def test_shapes_beyond_a_raster_are_cut_off():
    level = {"occupancy": Occupancy(blocked=np.zeros((2, 2), bool), resolution=1.0)}
    found = rasterise(world(walls=[[-5, 0.5, 5, 0.5], [7, 7, 9, 9]], **level), 0, 1.0)
    assert found.blocked.tolist() == [[True, True], [False, False]]


def test_the_raster_reaches_beyond_walls_and_places():
    places = (Vertex(name="far", x=9.0, y=-2.0), Vertex(name="upstairs", x=90.0, y=0.0, level=1))
    crate = Obstacle(name="crate", polygon=[[0, 0], [1, 0], [1, 1]])
    found = rasterise(World(name="w", levels=(Level(name="L1", obstacles=(crate,)),), vertices=places), 0, 0.1)
    low = np.array(found.origin)
    high = low + np.array(found.shape[::-1]) * 0.1
    assert low == pytest.approx([-0.5, -2.5], abs=0.11)
    assert high == pytest.approx([9.5, 1.5], abs=0.11)


def test_a_large_world_gets_larger_cells(monkeypatch):
    monkeypatch.setattr(raster, "MOST_CELLS", 1000)
    found = rasterise(world(walls=[[0, 0, 10, 0], [0, 10, 10, 10]]), 0, 0.05)
    assert found.resolution == pytest.approx(0.4)
    assert np.prod(found.shape) < 1100


def test_an_empty_level_is_all_free():
    assert not rasterise(world(), 0, 0.05).blocked.any()


def test_a_wall_of_no_length_is_a_square():
    corners = wall_outline(np.array([1.0, 2.0, 1.0, 2.0]), 0.2)
    assert sorted(map(tuple, corners.round(9))) == [(0.9, 1.9), (0.9, 2.1), (1.1, 1.9), (1.1, 2.1)]
