import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_worlds_standard.shipped import Household

from mrpbench_core.checking.clearance import has_clearance
from mrpbench_core.checking.occupancy import rasterise
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Area, Level, Obstacle

place = st.floats(-3, 3)


@st.composite
def levels(draw):
    walls = draw(st.lists(st.tuples(place, place, place, place), max_size=3))
    middle = np.array([draw(place), draw(place)])
    angle = np.sort(draw(st.lists(st.floats(0, 6.28), min_size=3, max_size=6)))
    polygon = middle + np.stack([np.cos(angle), np.sin(angle)], axis=1) * draw(st.floats(0.1, 2))
    return Level(name="", walls=walls, obstacles=(Obstacle(name="", polygon=polygon),))


@settings(deadline=None, max_examples=60)
@given(levels(), st.floats(0.11, 1))
def test_a_cell_is_blocked_where_a_ray_through_its_centre_hits(level, size):
    raster = rasterise(level, size)
    cells = np.argwhere(np.ones(raster.shape, bool))
    centres = raster.centres(cells)
    far = has_clearance(level, centres, centres, 1e-6)  # on the very border either answer is right
    near = ~has_clearance(level, centres, centres, 0.0)
    blocked = raster.blocked[cells[:, 0], cells[:, 1]]
    assert not blocked[far].any()
    inside = near & ~_on_border(level, centres)
    assert blocked[inside].all()


def _on_border(level, points):
    """Moved a little in each direction, some of these points are free."""
    moved = [points + step for step in ((1e-6, 1e-6), (-1e-6, 1e-6), (1e-6, -1e-6), (-1e-6, -1e-6))]
    return np.any([has_clearance(level, at, at, 0.0) for at in moved], axis=0)


@settings(deadline=None, max_examples=60)
@given(levels(), st.floats(0.11, 1))
def test_touched_cells_are_those_that_a_fine_search_finds_and_hardly_more(level, size):
    raster = rasterise(level, size, "touched")
    steps = (np.arange(8) + 0.5) / 8 - 0.5
    offset = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2) * size
    cells = np.argwhere(np.ones(raster.shape, bool))
    centres = raster.centres(cells)
    points = (centres[:, None] + offset).reshape(-1, 2)
    hit = (~has_clearance(level, points, points, 0.0)).reshape(len(cells), -1)
    blocked = raster.blocked[cells[:, 0], cells[:, 1]]
    assert blocked[hit.any(axis=1)].all()
    assert not blocked[has_clearance(level, centres, centres, size * 0.7072)].any()


def test_holes_and_obstacles_are_in_the_raster():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    level = Level(name="", holes=(Area(polygon=square),), obstacles=(Obstacle(name="", polygon=square + (2, 0)),))
    assert rasterise(level, 0.5).blocked.astype(int).tolist() == [[1, 1, 0, 0, 1, 1]] * 2


def test_the_frame_of_the_raster_can_be_given():
    level = Level(name="", walls=[[0, 0, 1, 0]])
    raster = rasterise(level, 0.1, origin=(-0.5, -0.5), shape=(10, 20))
    assert raster.blocked.sum() == 1 * 11
    assert rasterise(Level(name=""), 0.1).blocked.tolist() == [[False]]


def test_the_raster_of_a_level_stays_unchanged():
    own = Occupancy(blocked=np.eye(4, dtype=bool), resolution=0.5, origin=(1, 2))
    level = Level(name="", occupancy=own)
    assert rasterise(level, 0.5) is own
    fine = rasterise(level, 0.25)
    np.testing.assert_array_equal(fine.blocked, np.kron(own.blocked, np.ones((2, 2), bool)))
    coarse = rasterise(level, 1.0, "touched")
    assert coarse.blocked.tolist() == [[True, False], [False, True]]
    wider = rasterise(level, 0.5, origin=(0.5, 2.0), shape=(4, 6))
    assert wider.blocked[:, 0].all(), "beyond its edge it is solid"
    assert wider.blocked[:, 5].all()
    np.testing.assert_array_equal(wider.blocked[:, 1:5], own.blocked)


def test_a_raster_too_large_is_refused():
    with pytest.raises(InputError, match="20 × 100000020 cells is too large"):
        rasterise(Level(name="", walls=[[0, 0, 5e5, 0]]), 0.005)


def test_the_blocked_area_of_a_furnished_flat_stays_the_same():
    level = Household().load().levels[0]
    area = rasterise(level, 0.02).blocked.mean() * 12.4 * 9.2
    assert area == pytest.approx(rasterise(level, 0.05).blocked.mean() * 12.4 * 9.2, rel=0.03)
    assert 20 < area < 40
