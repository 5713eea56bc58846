"""The rolling costmap against brute force in NumPy."""

import math
from itertools import pairwise

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_controllers_dwb import Dwb, LocalCostmap

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.execution.observation import Observation, Observations, ScanBatch
from mrpbench_core.model.worlds.world import Level, Obstacle, World

BURGER = load_robot("turtlebot3_burger")
NOWHERE = World(name="w", levels=())


def session(world=NOWHERE, **costmap):
    return Dwb(local_costmap=LocalCostmap(**costmap)).start_fleet((BURGER,), world, 0.05)


def see(controller, pose, ranges=None, now=0.0):
    scan = None if ranges is None else ScanBatch(stamp=now, robot=[0], ranges=[ranges])
    path = np.array([pose[:2], pose[:2]], float)
    seen = Observation(now=now, pose=np.array(pose, float), twist=np.zeros(2), path=path, scan=scan)
    controller.command(Observations.alone(seen))
    return controller.costmap(0)


ranges = st.lists(st.one_of(st.floats(0.15, 3.5), st.just(math.inf)), min_size=24, max_size=24)
pose = st.tuples(st.floats(-20, 20), st.floats(-20, 20), st.floats(-3, 3))


@settings(deadline=None, max_examples=40)
@given(pose, ranges, st.sampled_from([0.2, 0.55]), st.sampled_from([1.0, 3.0]))
def test_costs_around_marked_cells_are_those_of_nav2(pose, ranges, radius, factor):
    costs, x, y, inscribed = see(
        session(inflation_radius=radius, cost_scaling_factor=factor, footprint_clearing_enabled=False), pose, ranges
    )
    plain, *_ = see(session(plugins=("obstacle_layer",), footprint_clearing_enabled=False), pose, ranges)
    # Marks: the cells of the points that beams hit, not farther than 2.5 m from the lidar.
    angle = pose[2] + np.arange(24) * 2 * np.pi / 24
    forward = BURGER.lidar.mount[0]
    lidar = np.array([pose[0] + forward * math.cos(pose[2]), pose[1] + forward * math.sin(pose[2])])
    hits = np.array(ranges) < 2.5
    points = lidar + np.where(hits, ranges, 0.0)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    at = np.floor(points[hits] / 0.05).astype(int) - np.round([x / 0.05, y / 0.05]).astype(int)
    at = at[((at >= 0) & (at < 60)).all(axis=1)]
    marked = np.zeros((60, 60), bool)
    marked[at[:, 1], at[:, 0]] = True
    near_border = np.abs(points[hits] / 0.05 - np.round(points[hits] / 0.05)).min(initial=1) < 1e-6
    if not near_border:  # else rounding decides
        assert ((plain == 254) == marked).all()
    # Inflation: Nav2's formula of the exact distance to the nearest mark.
    rows, columns = np.nonzero(plain == 254)
    expected = np.zeros((60, 60))
    for row in range(60):
        for column in range(60):
            square = ((rows - row) ** 2 + (columns - column) ** 2).min(initial=10**6)
            distance = math.sqrt(square) * 0.05
            if square == 0:
                expected[row, column] = 254
            elif math.sqrt(square) <= math.floor(radius / 0.05):
                falling = math.floor(252 * math.exp(-factor * (distance - inscribed)))
                expected[row, column] = 253 if distance <= inscribed else falling
    assert (costs == expected).all()


def test_the_map_lies_around_the_robot_on_the_cells_of_the_plane():
    costs, x, y, _ = see(session(), (3.21, -7.77, 1.0), [math.inf] * 24)
    assert costs.shape == (60, 60)
    assert abs(x + 1.5 - 3.21) <= 0.026
    assert abs(y + 1.5 + 7.77) <= 0.026
    assert x / 0.05 == pytest.approx(round(x / 0.05))


def test_the_map_is_made_as_often_as_it_says():
    controller = session(plugins=("obstacle_layer",), update_frequency=5.0)
    see(controller, (0.0, 0.0, 0.0), [1.0] * 24, now=0.0)
    assert see(controller, (0.5, 0.0, 0.0), now=0.1)[1] == pytest.approx(-1.5)
    assert see(controller, (0.5, 0.0, 0.0), now=0.2)[1] == pytest.approx(-1.0)


def test_clearing_removes_marked_cells():
    controller = session()
    assert see(controller, (0.0, 0.0, 0.0), [1.0] * 24)[0].any()
    controller.clear(0)
    assert not controller.costmap(0)[0].any()
    assert controller.is_free(0, np.array([[1.0, 0.0, 0.0]])).all()


def test_cells_within_the_footprint_of_a_marked_cell_are_not_free():
    controller = session(robot_radius=0.1)
    see(controller, (0.0, 0.0, 0.0), [math.inf] * 6 + [1.0] + [math.inf] * 17)  # one mark straight to the left
    poses = np.array([(-0.032, y, 0.0) for y in (0.5, 0.85, 0.92, 1.0, 1.08, 1.2)])
    assert controller.is_free(0, poses).tolist() == [True, True, False, False, False, True]


@pytest.mark.parametrize(("yaw", "free"), [(0.0, True), (math.pi / 2, False)])
def test_a_polygon_is_free_or_not_by_its_outline(yaw, free):
    long = ((0.3, 0.05), (-0.3, 0.05), (-0.3, -0.05), (0.3, -0.05))
    controller = session(footprint=long)
    see(controller, (0.0, 0.0, 0.0), [math.inf] * 6 + [0.305] + [math.inf] * 17)
    assert controller.is_free(0, np.array([[-0.032, 0.0, yaw]]))[0] == free


def test_the_static_map_is_a_layer():
    walls = World(name="wall", levels=(Level(name="L1", walls=[[1.0, -9, 1.0, 9]]),))
    controller = session(walls, plugins=("static_layer",))
    costs, x, _, _ = see(controller, (0.0, 0.0, 0.0))
    columns = np.flatnonzero((costs == 254).all(axis=0))
    faces = x + (columns + 0.5) * 0.05
    assert abs(faces - 0.95).min() <= 0.05  # a wall of 10 cm
    assert not (costs[:, :40] == 254).any()


def test_robots_keep_their_maps_while_they_wait():
    controller = session(plugins=("obstacle_layer",))
    see(controller, (0.0, 0.0, 0.0), [1.0] * 24)
    observations = Observations.alone(
        Observation(
            now=0.2,
            pose=np.zeros(3),
            twist=np.zeros(2),
            path=np.zeros((1, 2)),
            scan=ScanBatch(stamp=0.2, robot=[0], ranges=[[1.3] * 24]),
        )
    )
    nothing = {name: getattr(observations, name)[:0] for name in ("robot", "pose", "twist", "foot", "begin", "end")}
    controller.command(attrs.evolve(observations, yaw=np.empty(0), speed=np.empty(0), **nothing))
    costs, x, y, _ = controller.costmap(0)
    ahead = costs[int((0.01 - y) / 0.05), :]
    assert x + (np.flatnonzero(ahead == 254)[-1] + 0.5) * 0.05 == pytest.approx(1.3 - 0.032, abs=0.05)


def scan_of_box(left, right, ahead, size=360):
    """Beams from the origin that hit the near face of a box."""
    angle = np.arange(size) * 2 * np.pi / size
    with np.errstate(divide="ignore"):
        distance = ahead / np.cos(angle)
    beside = distance * np.sin(angle)
    hit = (np.cos(angle) > 0) & (beside >= right) & (beside <= left)
    return np.where(hit, distance, np.inf).tolist()


def on_a_path(controller, path):
    seen = Observation(now=0.2, pose=np.zeros(3), twist=np.zeros(2), path=np.array(path, float))
    return controller.reroute(Observations.alone(seen), 0)


def test_a_way_around_leads_back_to_the_path_and_keeps_clear():
    controller = session(robot_radius=0.1)
    see(controller, (0.0, 0.0, 0.0), scan_of_box(0.1, -0.1, 0.6))
    path = [(0, 0), (1.2, 0)]
    way = on_a_path(controller, path)
    assert way is not None
    assert abs(way[-1, 1]) < 1e-9
    assert 0.6 < way[-1, 0] <= 1.2
    corners = np.vstack([[0, 0], way])
    dense = np.concatenate([np.linspace(a, b, 30) for a, b in pairwise(corners)])
    assert controller.is_free(0, np.column_stack([dense, np.zeros(len(dense))])).all()
    assert np.abs(dense[:, 1]).max() <= 0.55


def test_there_is_no_way_around_a_free_path_nor_a_wall():
    controller = session(robot_radius=0.1)
    see(controller, (0.0, 0.0, 0.0), [math.inf] * 360)
    assert on_a_path(controller, [(0, 0), (1.2, 0)]) is None
    see(controller, (0.0, 0.0, 0.0), scan_of_box(9.0, -9.0, 0.6), now=0.2)
    assert on_a_path(controller, [(0, 0), (1.2, 0)]) is None


def test_a_way_around_keeps_within_its_distance_of_the_path():
    controller = Dwb(max_detour=0.2, local_costmap=LocalCostmap(robot_radius=0.1)).start_fleet((BURGER,), NOWHERE, 0.05)
    see(controller, (0.0, 0.0, 0.0), scan_of_box(0.3, -0.3, 0.6))
    assert on_a_path(controller, [(0, 0), (1.2, 0)]) is None


def beside(controller, path, tolerance=0.5):
    seen = Observation(now=0.2, pose=np.zeros(3), twist=np.zeros(2), path=np.array(path, float))
    return controller.approach(Observations.alone(seen), 0, tolerance)


def test_the_way_to_an_occupied_end_leads_to_the_nearest_place_with_room():
    controller = session(robot_radius=0.1)
    see(controller, (0.0, 0.0, 0.0), scan_of_box(9.0, -9.0, 0.8))
    way = beside(controller, [(0, 0), (0.8, 0)])
    assert way is not None
    away = 0.8 - way[-1, 0]
    assert 0.108 < away < 0.25
    assert abs(way[-1, 1]) < 0.05
    assert beside(controller, [(0, 0), (0.8, 0)], tolerance=0.1) is None


def test_a_free_end_needs_no_way():
    controller = session(robot_radius=0.1)
    see(controller, (0.0, 0.0, 0.0), [math.inf] * 360)
    assert beside(controller, [(0, 0), (0.8, 0)]) is None


FACE = Obstacle(name="shelf", polygon=[(0.5, -0.4), (1.3, -0.4), (1.3, 0.4), (0.5, 0.4)])
SHELF = World(name="w", levels=(Level(name="L1", obstacles=(FACE,)),))


def test_no_path_leads_into_an_area_that_the_static_map_encloses():
    controller = session(SHELF, robot_radius=0.1)  # the lidar saw its near face only
    see(controller, (0.0, 0.0, 0.0), scan_of_box(0.4, -0.4, 0.5))
    assert on_a_path(controller, [(0, 0), (0.9, 0)]) is None
    way = beside(controller, [(0, 0), (0.9, 0)], tolerance=0.7)
    assert way is not None
    assert not ((way[:, 0] > 0.5) & (way[:, 0] < 1.3) & (abs(way[:, 1]) < 0.4)).any()


def test_a_static_layer_of_several_levels_is_refused():
    house = World(name="house", levels=(Level(name="L1"), Level(name="L2", elevation=3.0)))
    with pytest.raises(InputError, match="one level, and house has 2"):
        session(house, plugins=("static_layer",))
    assert session(house) is not None


@pytest.mark.parametrize("padding", [0.01, 0.03])
def test_a_wall_along_the_cells_is_kept_at_the_padded_radius_wherever_it_is_in_them(padding):
    gaps, radii = [], []
    for wall in np.arange(1.0, 1.1, 0.01):
        angle = np.arange(360) * 2 * np.pi / 360
        ahead = np.cos(angle) > 1e-9
        scan = np.full(360, np.inf)
        scan[ahead] = (wall - 0.5 - BURGER.lidar.mount[0]) / np.cos(angle[ahead])
        controller = session(footprint_padding=padding)
        *_, inscribed = see(controller, (0.5, 0.013, 0.0), scan)
        x = np.arange(wall - 0.3, wall, 0.001)
        free = controller.is_free(0, np.column_stack([x, np.full_like(x, 0.013), np.zeros_like(x)]))
        gaps.append(wall - x[free].max())
        radii.append(inscribed)
    assert gaps == pytest.approx(radii, abs=0.002)


def scan_of_squares(pose, corners, side):
    """Beams that hit squares along the axes, given by their lower left corners f8[k,2]."""
    forward = BURGER.lidar.mount[0]
    origin = pose[:2] + forward * np.array([math.cos(pose[2]), math.sin(pose[2])])
    angle = pose[2] + np.arange(360) * 2 * np.pi / 360
    along = np.column_stack([np.cos(angle), np.sin(angle)])
    with np.errstate(divide="ignore", invalid="ignore"):
        low, high = ((corners[:, None] + offset - origin) / along for offset in (0.0, side))
    enters, leaves = np.minimum(low, high).max(axis=2), np.maximum(low, high).min(axis=2)
    return np.where((enters < leaves) & (enters > 0), enters, np.inf).min(axis=0)


def distance_to_squares(places, corners, side):
    beyond = np.maximum(np.maximum(corners - places[:, None], places[:, None] - corners - side), 0)
    return np.hypot(*np.moveaxis(beyond, 2, 0)).min(axis=1)


PILLAR = [(0, 0)]
DIAGONAL = [(k, k) for k in range(-9, 10)]
SLOPE = [(k, k // 2) for k in range(-9, 10)]


@settings(deadline=None, max_examples=100)
@given(st.sampled_from([PILLAR, DIAGONAL, SLOPE]), st.integers(0, 2**32))
def test_a_robot_does_not_fit_where_it_would_touch_a_thin_pillar_or_a_diagonal_wall(squares, seed):
    """Cells of a raster map coincide with those of the costmap. One hit a cell is kept: a centimetre may be missing."""
    side, corners, draws = 0.05, np.array(squares) * 0.05, np.random.default_rng(seed)
    start = np.zeros(3)
    while not 0.135 < distance_to_squares(start[None, :2], corners, side)[0] < 0.2:
        start = np.append(draws.uniform(-0.25, 0.25, 2), draws.uniform(-3, 3))
    controller = session()
    see(controller, start, scan_of_squares(start, corners, side))
    places = start[:2] + np.mgrid[-2:3, -2:3].reshape(2, -1).T * 0.01
    free = controller.is_free(0, np.column_stack([places, np.zeros(len(places))]))
    assert free.any()
    assert (distance_to_squares(places[free], corners, side) > BURGER.radius - 0.01).all()
