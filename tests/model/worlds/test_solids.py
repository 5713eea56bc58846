import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.solids import polygon_outline, raster_outline, segments, wall_boxes
from mrpbench_core.model.worlds.world import Level, Obstacle, World


def enclosed(outline):
    """Area on the left of a closed outline, by Green's theorem."""
    x1, y1, x2, y2 = outline.T
    return float((x1 * y2 - x2 * y1).sum() / 2)


def test_a_wall_is_a_box_longer_than_its_centre_line_by_its_thickness():
    box = wall_boxes(np.array([[1.0, 2.0, 4.0, 2.0]]), 0.2)
    assert np.allclose(np.unique(box.reshape(-1, 2), axis=0), [[0.9, 1.9], [0.9, 2.1], [4.1, 1.9], [4.1, 2.1]])
    assert np.isclose(enclosed(box), 3.2 * 0.2)


def test_a_wall_without_length_is_a_square_and_no_walls_are_no_segments():
    assert np.isclose(enclosed(wall_boxes(np.array([[1.0, 2.0, 1.0, 2.0]]), 0.2)), 0.04)
    assert wall_boxes(np.empty((0, 4)), 0.1).shape == (0, 4)


@settings(deadline=None, max_examples=50)
@given(st.tuples(*[st.floats(-5, 5)] * 4), st.floats(0.01, 1))
def test_every_wall_has_its_solid_on_the_left(line, thickness):
    length = np.hypot(line[2] - line[0], line[3] - line[1])
    assert np.isclose(enclosed(wall_boxes(np.array([line]), thickness)), (length + thickness) * thickness)


def test_a_polygon_has_its_solid_on_the_left_whichever_way_it_was_drawn():
    square = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
    for polygon in (square, square[::-1]):
        outline = polygon_outline(polygon)
        assert enclosed(outline) == 4
        assert (outline[:, 2:] == np.roll(outline[:, :2], -1, axis=0)).all() or (
            outline[:, :2] == np.roll(outline[:, 2:], -1, axis=0)
        ).all()


@settings(deadline=None, max_examples=50)
@given(arrays(bool, st.tuples(st.integers(1, 8), st.integers(1, 8))))
def test_the_outline_of_a_raster_is_the_border_of_its_free_cells(blocked):
    outline = raster_outline(Occupancy(blocked=blocked, resolution=0.5, origin=(-1.0, 2.0)))
    assert np.isclose(enclosed(outline), -0.25 * (~blocked).sum())
    free = np.pad(~blocked, 1)
    borders = (free[1:] != free[:-1]).sum() + (free[:, 1:] != free[:, :-1]).sum()
    assert np.isclose(np.hypot(*(outline[:, 2:] - outline[:, :2]).T).sum(), 0.5 * borders)
    # Just right of the middle of every segment is a free cell, just left of it none.
    middle, along = (outline[:, :2] + outline[:, 2:]) / 2, outline[:, 2:] - outline[:, :2]
    right = np.sign(along[:, ::-1] * (1, -1)) * 1e-3
    # The middle of a run of even length lies on a corner of cells: move a little along it.
    middle = middle + np.sign(along) * 1e-3
    for side, wanted in ((right, True), (-right, False)):
        column, row = np.floor((middle + side - (-1.0, 2.0)) / 0.5).astype(int).T
        assert (free[row + 1, column + 1] == wanted).all()


def test_runs_are_joined():
    assert len(raster_outline(Occupancy(blocked=np.zeros((3, 7), bool), resolution=1.0))) == 4


def test_a_level_is_all_it_holds():
    level = Level(
        name="L1",
        walls=[[0, 0, 1, 0], [0, 1, 1, 1]],
        obstacles=(Obstacle(name="crate", polygon=[[0, 0], [1, 0], [0, 1]]),),
        occupancy=Occupancy(blocked=[[False]], resolution=1.0),
    )
    assert segments(World(name="w", levels=(Level(name="L0"), level)), 1).shape == (8 + 3 + 4, 4)
    assert segments(World(name="w", levels=(Level(name="L0"), level)), 0).shape == (0, 4)
