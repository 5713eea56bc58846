"""The raster of what is solid, by geometry and by rays from above."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_simulators_pybullet.above import occupancy_from_above, triangulate
from mrpbench_worlds_standard.generated.rooms import GeneratedRooms
from mrpbench_worlds_standard.rmf import Rmf
from mrpbench_worlds_standard.shipped import Bottlenecks, Household, Office, Warehouse

from mrpbench_core.checking.clearance import solids
from mrpbench_core.checking.occupancy import bounds, rasterise
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.worlds.world import Level, Obstacle

pytest.importorskip("pybullet", reason="PyBullet has no wheel for this Python")

ASIDE = math.sqrt(2) / 1000
"""metres by which rasters lie off the walls, which are drawn to the decimetre: a ray down an edge may hit or miss."""
HAIR = 0.001
"""metres: what Bullet's single precision and collision margins may be off."""


def compared(level, cell_size):
    """The number of cells that both find blocked; they may differ only if the middle is within `HAIR` of an edge."""
    low, high = bounds(level)
    origin = (float(low[0]) - ASIDE, float(low[1]) - ASIDE)
    columns, rows = np.ceil((high - origin) / cell_size).astype(int).tolist()
    frame = {"origin": origin, "shape": (rows, columns)}
    geometry, rays = rasterise(level, cell_size, **frame), occupancy_from_above(level, cell_size, **frame)
    for place in geometry.centres(np.argwhere(geometry.blocked != rays.blocked)):
        gaps = [point_segment_distance(place, it, np.roll(it, -1, axis=0)).min() for it in solids(level)]
        assert min(gaps) < HAIR, place
    return int((geometry.blocked & rays.blocked).sum())


@pytest.mark.parametrize("source", [Office(), Warehouse(), Household(), Bottlenecks(case="roundabout")], ids=repr)
def test_geometry_and_rays_agree_on_built_in_worlds(source):
    assert compared(source.load().levels[0], 0.1) > 100


@pytest.mark.parametrize("name", ["mrp_bench/office", "mrp_bench/warehouse", "rmf_demos/hotel"])
def test_geometry_and_rays_agree_on_public_maps(shared_data, name):
    for level in Rmf(file=shared_data / f"rmf/{name}.building.yaml").load().levels:
        assert compared(level, 0.15) > 1000


def test_geometry_and_rays_agree_on_rasters():
    level = GeneratedRooms().load().levels[0]
    rows, columns = level.occupancy.shape
    size = level.occupancy.resolution
    frame = {"origin": level.occupancy.origin, "shape": (2 * rows, 2 * columns)}
    geometry, rays = (way(level, size / 2, **frame).blocked for way in (rasterise, occupancy_from_above))
    assert np.array_equal(geometry, rays)


@settings(deadline=None, max_examples=40)
@given(radii=st.lists(st.floats(0.3, 3), min_size=3, max_size=12), turned=st.booleans())
def test_they_agree_on_any_star(radii, turned):
    angle = np.arange(len(radii)) * 2 * np.pi / len(radii) * (-1 if turned else 1)
    star = np.column_stack([np.cos(angle), np.sin(angle)]) * np.array(radii)[:, None]
    compared(Level(name="L1", obstacles=(Obstacle(name="star", polygon=star),)), 0.217)


def test_triangles_cover_a_polygon_once():
    polygon = np.array([(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1), (1, 3), (0, 3)], float)  # a U
    parts = triangulate(polygon)
    (a, b), (c, d) = (parts[:, 1] - parts[:, 0]).T, (parts[:, 2] - parts[:, 0]).T
    assert np.abs(a * d - b * c).sum() / 2 == pytest.approx(8.0)


def test_nothing_blocks_nothing():
    assert not occupancy_from_above(Level(name="L1"), 0.5).blocked.any()
