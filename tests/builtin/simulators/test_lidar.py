import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.builtin.simulators.lidar import scan
from mrpbench_core.builtin.simulators.nearby import Nearby
from mrpbench_core.model.common.fleet import Lidar
from mrpbench_core.model.worlds.solids import wall_boxes

NOTHING = np.empty((0, 4))
NO_DISCS = np.empty((0, 2)), np.empty(0)


def test_beams_are_counted_from_straight_ahead_counter_clockwise_and_from_the_sensor():
    lidar = Lidar(beams=4, mount=(0.5, 0.0, 0.2), range=10.0, min_range=0.0)
    room = wall_boxes(np.array([[0, 0, 8, 0], [8, 0, 8, 6], [8, 6, 0, 6], [0, 6, 0, 0]], float), 0.0)
    ranges = scan(lidar, np.array([3.0, 2.0, np.pi / 2]), room, *NO_DISCS)  # the sensor is at (3, 2.5), facing +y
    assert np.allclose(ranges, [3.5, 3.0, 2.5, 5.0])


def test_a_disc_is_hit_on_its_near_side():
    lidar = Lidar(beams=4, mount=(0.0, 0.0, 0.2))
    ranges = scan(lidar, np.zeros(3), NOTHING, np.array([[0.0, 1.0]]), np.array([0.25]))
    assert np.allclose(ranges, [np.inf, 0.75, np.inf, np.inf])


def test_obstacles_too_near_or_too_far_give_no_return():
    lidar = Lidar(beams=1, mount=(0.0, 0.0, 0.2), range=3.5, min_range=0.12)
    for distance, seen in ((0.1, False), (0.13, True), (3.4, True), (3.6, False)):
        ranges = scan(lidar, np.zeros(3), NOTHING, np.array([[distance + 0.2, 0.0]]), np.array([0.2]))
        assert np.isfinite(ranges[0]) == seen


def test_an_obstacle_that_is_too_near_still_hides_obstacles_behind_it():
    lidar = Lidar(beams=1, mount=(0.0, 0.0, 0.2), min_range=0.12)
    ranges = scan(lidar, np.zeros(3), NOTHING, np.array([[0.25, 0.0], [1.0, 0.0]]), np.array([0.2, 0.2]))
    assert np.isinf(ranges[0])


coordinate = st.floats(-3, 3)


@settings(deadline=None, max_examples=60)
@given(
    st.lists(st.tuples(coordinate, coordinate, coordinate, coordinate), max_size=5),
    st.lists(st.tuples(coordinate, coordinate, st.floats(0.05, 0.5)), max_size=3),
    st.floats(-3, 3),
)
def test_a_beam_is_free_up_to_its_range_and_blocked_behind(lines, discs, yaw):
    """The oracle asks whether points lie in boxes and discs, a little shrunk or grown; it knows nothing of rays."""
    lines, discs = np.array(lines).reshape(-1, 4), np.array(discs).reshape(-1, 3)

    def solid(points, grown):
        inside = (np.hypot(*(points[:, None] - discs[:, :2]).transpose(2, 0, 1)) < discs[:, 2] + grown).any(1)
        for x1, y1, x2, y2 in lines:
            length = np.hypot(x2 - x1, y2 - y1)
            along = np.array([x2 - x1, y2 - y1]) / length if length > 0 else np.array([1.0, 0.0])
            offset, half = points - (x1, y1), 0.1 + grown
            forward, sideways = (offset * along).sum(1), offset[:, 1] * along[0] - offset[:, 0] * along[1]
            inside |= (forward > -half) & (forward < length + half) & (np.abs(sideways) < half)
        return inside

    if solid(np.zeros((1, 2)), 1e-6)[0]:
        return
    lidar = Lidar(beams=24, mount=(0.0, 0.0, 0.2), range=4.0, min_range=0.0)
    ranges = scan(lidar, np.array([0.0, 0.0, yaw]), wall_boxes(lines, 0.2), discs[:, :2], discs[:, 2])
    angle = yaw + np.arange(24) * 2 * np.pi / 24
    for distance, direction in zip(ranges, np.column_stack([np.cos(angle), np.sin(angle)]), strict=True):
        assert not solid(np.linspace(0, min(distance, 4.0), 400)[:, None] * direction, -1e-6).any()
        if np.isfinite(distance):
            assert solid(distance * direction[None], 1e-6).all()


@settings(deadline=None, max_examples=40)
@given(st.lists(st.tuples(coordinate, coordinate, coordinate, coordinate), max_size=8), coordinate, coordinate)
def test_nearby_finds_all_that_is_in_reach(lines, x, y):
    lines = np.array(lines).reshape(-1, 4)
    share = np.linspace(0, 1, 50)[:, None, None]
    points = lines[:, :2] + share * (lines[:, 2:] - lines[:, :2])
    near = (np.hypot(points[..., 0] - x, points[..., 1] - y) <= 0.7).any(axis=0)
    found = {tuple(line) for line in Nearby(lines, 0.7)(x, y)}
    assert {tuple(line) for line in lines[near]} <= found
