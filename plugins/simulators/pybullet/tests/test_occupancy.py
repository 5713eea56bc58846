"""Occupancy two ways: by area, and by vertical rays through PyBullet's world."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.builtin.worlds.shipped import Household, Office, Warehouse
from mrpbench_core.checking.occupancy import rasterise
from mrpbench_core.model.geometry import point_segment_distance
from mrpbench_core.model.occupancy import Occupancy
from mrpbench_core.model.solids import segments
from mrpbench_core.model.world import Level, Obstacle, World

pytest.importorskip("pybullet", reason="PyBullet has no wheel for this Python")
from mrpbench_simulators_pybullet.occupancy import ears, occupancy_by_rays

L_SHAPE = [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]]
SHAPES = Level(
    name="L1",
    walls=[[0, 0, 6, 0], [6, 0, 6, 5], [3, 0, 3.5, 2], [2, 2, 2, 2]],
    obstacles=(
        Obstacle(name="corner", polygon=np.array(L_SHAPE[::-1]) * 0.6 + (0.5, 2.5)),
        Obstacle(name="low", polygon=[[4, 3], [5, 3.3], [4.4, 4.2]], height=0.02),
    ),
)


GRAZE = 1e-4
"""Metres from an outline within which rounding decides whether a ray meets it."""


def disagreements(level, cell_size):
    """How many cells there are, the share of blocked ones, and on how many area and rays disagree.

    Cells whose centres all but lie on an outline do not count; the raster is put a hair off the map's round numbers so
    that few do.
    """
    level = attrs.evolve(level, holes=())
    first = rasterise(level, cell_size)
    origin = (first.origin[0] - 0.00137, first.origin[1] - 0.00173)
    area = rasterise(level, cell_size, origin=origin, shape=first.shape)
    rays = occupancy_by_rays(level, area)
    outline = segments(World(name="w", levels=(level,)))
    different = area.centres(np.argwhere(area.blocked != rays.blocked))
    off = [point_segment_distance(centre, outline[:, :2], outline[:, 2:]).min() for centre in different]
    return area.blocked.size, area.blocked.mean(), sum(distance > GRAZE for distance in off), len(off)


@pytest.mark.parametrize(
    ("level", "cell_size"),
    [
        (SHAPES, 0.03),
        (Office().load().levels[0], 0.05),
        (Warehouse().load().levels[0], 0.1),
        (Household().load().levels[0], 0.04),
    ],
    ids=["shapes", "office", "warehouse", "household"],
)
def test_rays_and_areas_agree_on_every_cell(level, cell_size):
    cells, blocked, wrong, grazed = disagreements(level, cell_size)
    assert cells > 20_000
    assert 0.002 < blocked < 0.9
    assert wrong == 0
    assert grazed < cells / 1000


def test_rays_and_areas_agree_on_the_maps_of_the_original(shared_data):
    from mrpbench_core.builtin.worlds.rmf import Rmf

    files = sorted((shared_data / "rmf" / "mrp_bench").rglob("*.building.yaml"))
    assert files
    for file in files:
        level = Rmf(file=file).load().levels[0]
        size = 0.4 if "airport" in file.name else 0.1
        cells, _, wrong, grazed = disagreements(level, size)
        assert wrong == 0, file.name
        assert grazed < cells / 1000, file.name


def test_cells_of_a_raster_are_seen_from_above():
    blocked = np.random.default_rng(0).random((40, 30)) < 0.3
    level = Level(name="L1", occupancy=Occupancy(blocked=blocked, cell_size=0.5, origin=(-3.0, 2.0)))
    fine = Occupancy(blocked=np.zeros((120, 90), bool), cell_size=0.5 / 3, origin=(-3.0, 2.0))
    assert np.array_equal(occupancy_by_rays(level, fine).blocked, np.kron(blocked, np.ones((3, 3), bool)))


@settings(deadline=None)
@given(st.lists(st.floats(0.2, 3.0), min_size=3, max_size=12))
def test_ears_fill_a_polygon_and_nothing_else(radii):
    """Star-shaped polygons: the areas of the triangles add up to the polygon's."""
    turn = np.linspace(0, 2 * np.pi, len(radii), endpoint=False)
    polygon = np.column_stack([np.cos(turn), np.sin(turn)]) * np.array(radii)[:, None]

    def area(corners):
        ahead = np.roll(corners, -1, axis=-2)
        return (corners[..., 0] * ahead[..., 1] - corners[..., 1] * ahead[..., 0]).sum(axis=-1) / 2

    triangles = polygon[ears(polygon)]
    assert triangles.shape == (len(radii) - 2, 3, 2)
    assert (area(triangles) >= -1e-12).all()
    assert np.isclose(area(triangles).sum(), area(polygon))
