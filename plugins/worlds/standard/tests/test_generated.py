"""Properties of all generated worlds."""

import time

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_worlds_standard.generated.random import GeneratedRandom
from mrpbench_worlds_standard.generated.rooms import GeneratedRooms
from mrpbench_worlds_standard.generated.warehouse import GeneratedWarehouse

from mrpbench_core.builtin.roadmaps.cells import connect
from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.builtin.scenarios.random import Random
from mrpbench_core.checking.components import components
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet

small = st.integers(1, 6)
share = st.floats(0, 1)
SOURCES = st.one_of(
    st.builds(
        GeneratedRandom,
        columns=st.integers(1, 20),
        rows=st.integers(1, 20),
        blocked=st.floats(0, 0.4),
        seed=st.integers(-3, 2**63 - 1),  # the largest whole number of an option
    ),
    st.builds(
        GeneratedWarehouse,
        shelf_columns=small, shelf_rows=small, shelf_length=small, shelf_depth=small,
        aisle=small, cross_aisle=small, margin=small, missing=share, seed=st.integers(0, 9),
    ),
    st.builds(GeneratedRooms, across=small, up=small, room=small, extra_doors=share, seed=st.integers(0, 9)),
)  # fmt: skip


def raster(source):
    return source.load().levels[0].occupancy


def parts(source) -> int:
    cells = connect(raster(source))
    return len(set(components(len(cells.cell), cells.edges).tolist()))


@settings(deadline=None, max_examples=150)
@given(SOURCES)
def test_all_free_cells_are_connected_and_the_same_again(source):
    assert parts(source) <= 1
    assert source.load() == source.load()


def test_seeds_make_different_worlds():
    for source in (GeneratedRandom(), GeneratedRooms(), GeneratedWarehouse(missing=0.3)):
        assert raster(source) != raster(attrs.evolve(source, seed=1))


def test_a_warehouse_has_the_shelves_it_is_asked_for():
    source = GeneratedWarehouse(
        shelf_columns=2, shelf_rows=3, shelf_length=4, shelf_depth=2, aisle=1, cross_aisle=3, margin=2
    )
    expected = np.zeros((12, 15), bool)
    for bottom in (2, 5, 8):
        for left in (2, 9):
            expected[bottom : bottom + 2, left : left + 4] = True
    np.testing.assert_array_equal(raster(source).blocked, expected)
    assert raster(attrs.evolve(source, missing=1.0)).blocked.sum() == 0


def test_rooms_have_doors_of_the_width_asked_for():
    closed = GeneratedRooms(across=3, up=2, room=5, door=2, extra_doors=0)
    blocked = raster(closed).blocked
    assert blocked.shape == (11, 17)
    walls = 2 * 11 + 17 - 2
    assert walls - blocked.sum() == 5 * 2, "five doors of two cells join six rooms"
    opened = raster(attrs.evolve(closed, extra_doors=1.0)).blocked
    assert walls - opened.sum() == 7 * 2


def test_about_as_many_cells_are_blocked_as_asked_for():
    blocked = raster(GeneratedRandom(columns=200, rows=100, blocked=0.2, seed=3)).blocked
    assert blocked.mean() == pytest.approx(0.2, abs=0.02)


@pytest.mark.parametrize(
    "source",
    [
        GeneratedRandom(columns=1000, rows=1000, blocked=0.2),
        GeneratedWarehouse(shelf_columns=83, shelf_rows=248),
        GeneratedRooms(across=125, up=125),
    ],
    ids=lambda source: type(source).__name__,
)
def test_a_million_cells_are_quickly_there(source):
    begin = time.process_time()
    occupancy = raster(source)
    assert time.process_time() - begin < 5
    assert occupancy.blocked.size == pytest.approx(1e6, rel=0.02)


def test_robots_can_be_placed_and_sent_about():
    fleet = Fleet(robots=(load_robot("turtlebot3_burger"),) * 20)
    for source in (GeneratedRandom(), GeneratedRooms(), GeneratedWarehouse()):
        world = source.load()
        roadmap = GridRoadmap().build(world, fleet)
        assert len(roadmap.position) == (~world.levels[0].occupancy.blocked).sum()
        assert len(Random(robots=20).draw(world, roadmap, fleet, 0).tasks) == 20


def test_nonsense_is_refused():
    with pytest.raises(InputError, match="the world would have 100000 × 100000 cells"):
        GeneratedRandom(columns=10**5, rows=10**5).load()
    with pytest.raises(ValueError, match="'door' must be at most 'room'"):
        GeneratedRooms(room=3, door=4)
    with pytest.raises(ValueError, match="blocked"):
        GeneratedRandom(blocked=0.6)
