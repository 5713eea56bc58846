import math

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from mrpbench_core.checking.clearance import has_clearance
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Level, Obstacle

coordinate = st.floats(-3, 3, allow_nan=False).map(lambda value: round(value, 3))
point = st.tuples(coordinate, coordinate)


def box_gap(wall, x, y, thickness=0.1) -> float:
    """Distance of a point from a wall's box, in the box's own frame."""
    x1, y1, x2, y2 = wall
    yaw = math.atan2(y2 - y1, x2 - x1)
    dx, dy = x - (x1 + x2) / 2, y - (y1 + y2) / 2
    along, across = dx * math.cos(yaw) + dy * math.sin(yaw), dy * math.cos(yaw) - dx * math.sin(yaw)
    length = math.hypot(x2 - x1, y2 - y1) + thickness
    return math.hypot(max(abs(along) - length / 2, 0), max(abs(across) - thickness / 2, 0))


def sampled_gap(wall, p, q) -> float:
    shares = np.linspace(0, 1, 400)
    return min(box_gap(wall, p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])) for s in shares)


@settings(deadline=None, max_examples=150)
@given(
    st.lists(st.tuples(coordinate, coordinate, coordinate, coordinate), min_size=1, max_size=4),
    point,
    point,
    st.sampled_from([0.0, 0.05, 0.2, 0.6]),
)
def test_a_sweep_is_clear_when_no_wall_is_nearer_than_the_radius(walls, p, q, radius):
    gap = min(sampled_gap(wall, p, q) for wall in walls)
    step = math.dist(p, q) / 399
    assume(abs(gap - radius) > step + 1e-6)
    assert has_clearance(Level(name="", walls=walls), [p], [q], radius)[0] == (gap > radius)


def test_many_sweeps_are_judged_alike_together_and_alone():
    rng = np.random.default_rng(5)
    level = Level(name="", walls=rng.uniform(0, 10, (20, 4)))
    start = rng.uniform(0, 10, (300, 2))
    end = start + rng.uniform(-1, 1, (300, 2))
    alone = [has_clearance(level, a, b, 0.2)[0] for a, b in zip(start, end, strict=True)]
    assert has_clearance(level, start, end, 0.2).tolist() == alone
    assert 20 < sum(alone) < 280


def test_inside_of_an_obstacle_is_not_clear():
    level = Level(name="", obstacles=(Obstacle(name="", polygon=[[0, 0], [4, 0], [4, 4], [2, 1], [0, 4]]),))
    points = np.array([[0.5, 0.7], [2, 3], [5, 5]])
    assert has_clearance(level, points, points, 0.0).tolist() == [False, True, True]


def test_touching_at_exactly_the_radius_is_allowed():
    level = Level(name="", walls=[[0, 0, 2, 0]])
    assert has_clearance(level, [[1, 0.35]], [[2, 0.35]], 0.3)[0]
    assert not has_clearance(level, [[1, 0.349]], [[2, 0.349]], 0.3)[0]


def test_a_point_cannot_pass_through_a_wall():
    assert not has_clearance(Level(name="", walls=[[0, 0, 2, 0]]), [[1, -1]], [[1, 1]], 0.0)[0]


@settings(deadline=None, max_examples=100)
@given(
    st.lists(st.booleans(), min_size=20, max_size=20),
    st.tuples(st.floats(0.2, 2.3), st.floats(0.2, 1.8)),
    st.tuples(st.floats(0.2, 2.3), st.floats(0.2, 1.8)),
    st.sampled_from([0.05, 0.15]),
)
def test_blocked_cells_are_solid_squares(cells, p, q, radius):
    occupancy = Occupancy(blocked=np.array(cells).reshape(4, 5), resolution=0.5)
    squares = [((column + 0.5) * 0.5, (row + 0.5) * 0.5) for row, column in np.argwhere(occupancy.blocked)]
    shares = np.linspace(0, 1, 300)[:, None]
    path = np.array(p) + shares * (np.array(q) - np.array(p))
    gaps = [np.hypot(*np.maximum(np.abs(path - centre) - 0.25, 0).T).min() for centre in squares]
    gap = min(gaps, default=9.0)
    assume(abs(gap - radius) > math.dist(p, q) / 299 + 1e-6)
    assert has_clearance(Level(name="", occupancy=occupancy), [p], [q], radius)[0] == (gap > radius)


def test_beyond_a_raster_is_solid():
    level = Level(name="", occupancy=Occupancy(blocked=np.zeros((2, 2), bool), resolution=1.0))
    points = np.array([[1.0, 1.0], [0.2, 1.0], [5.0, 5.0]])
    assert has_clearance(level, points, points, 0.3).tolist() == [True, False, False]
