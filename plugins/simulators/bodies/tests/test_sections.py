import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_simulators_bodies.body import RobotBody, Shape, hull, plain_body
from mrpbench_simulators_bodies.sections import convex_polygon, convex_section, outline_at
from mrpbench_tests.fixtures.drive import BURGER

from mrpbench_core.model.common.geometry import inside


def area(polygon):
    x, y = polygon.T
    return float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum()) / 2


def body(*shapes):
    wheels = plain_body(BURGER).wheels
    return RobotBody(shapes=shapes, mass=1.0, centre=np.zeros(3), inertia=np.eye(3), wheels=wheels)


def at(height, kind, *size):
    frame = np.eye(4)
    frame[2, 3] = height
    return Shape(kind=kind, size=size, frame=frame)


@pytest.mark.parametrize(
    ("shape", "height", "wanted"),
    [
        (at(0.5, "box", 2.0, 1.0, 1.0), 0.7, 2.0),
        (at(0.5, "box", 2.0, 1.0, 1.0), 1.1, 0.0),
        (at(0.5, "cylinder", 0.3, 1.0), 0.2, np.pi * 0.09),
        (at(0.5, "sphere", 0.5), 0.8, np.pi * (0.25 - 0.09)),
        (at(0.5, "capsule", 0.2, 0.6), 0.9, np.pi * (0.04 - 0.01)),
    ],
)
def test_sections_have_the_area_of_the_shape_at_that_height(shape, height, wanted):
    sides = outline_at(body(shape), height)
    found = area(sides[:, :2]) if len(sides) else 0.0
    assert found == pytest.approx(wanted, rel=0.03)


@given(st.integers(0, 10_000), st.floats(-0.9, 0.9))
def test_a_section_contains_what_the_hull_has_at_that_height(seed, height):
    """Convex combinations of corners, moved onto the plane along a line to a corner beyond it."""
    random = np.random.default_rng(seed)
    points = random.uniform(-1, 1, (12, 3))
    section = convex_section(points, height)
    mixed = random.dirichlet(np.ones(12), 200) @ points
    top, bottom = points[points[:, 2].argmax()], points[points[:, 2].argmin()]
    for point in mixed:
        other = top if point[2] < height else bottom
        if (other[2] - height) * (point[2] - height) >= 0:
            continue
        share = (height - point[2]) / (other[2] - point[2])
        cut = (point + share * (other - point))[None, :2]
        grown = section.mean(axis=0) + (section - section.mean(axis=0)) * (1 + 1e-6)
        assert inside(grown, cut).all()


@given(st.integers(0, 10_000))
def test_a_convex_polygon_turns_left_and_holds_all_points(seed):
    points = np.random.default_rng(seed).normal(size=(30, 2))
    polygon = convex_polygon(points)
    assert area(polygon) > 0
    for start, end in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        along, offset = end - start, points - start
        assert (along[0] * offset[:, 1] - along[1] * offset[:, 0] >= -1e-7).all()


def test_a_plain_robot_has_the_outline_of_its_footprint_at_the_height_of_its_lidar():
    sides = outline_at(plain_body(BURGER), BURGER.lidar.mount[2])
    assert area(sides[:, :2]) == pytest.approx(area(BURGER.footprint), rel=1e-6)
    assert not len(outline_at(plain_body(BURGER), BURGER.height + 0.01))


def test_a_hull_of_many_points_keeps_its_size_and_a_flat_one_gets_volume():
    random = np.random.default_rng(2)
    points = random.normal(size=(50_000, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    few = hull(points)
    assert len(few) <= 2000
    assert np.abs(np.abs(few).max(axis=0) - 1).max() < 0.002
    flat = hull(np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float))
    assert np.ptp(flat[:, 2]) == pytest.approx(0.001, rel=0.01)
