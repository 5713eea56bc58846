"""Closed loop: navigator, controller and the simulator of the core."""

import math

import numpy as np
import pytest
from mrpbench_controllers_pure_pursuit import PurePursuit
from mrpbench_navigators_waypoints import Waypoints

from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.execution.observation import Estimate, FleetObservation, Odometry
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.execution.state import Inputs
from mrpbench_core.model.worlds.world import Level, World

PERIOD = 0.05
EMPTY = World(name="empty", levels=(Level(name="L1"),))
L_SHAPE = [(x, 0) for x in range(5)] + [(4, y) for y in range(1, 5)]
ZIG_ZAG = [((k + 1) // 2, k // 2) for k in range(13)]
THERE_AND_BACK = [(0, 0), (1, 0), (2, 0), (1, 0), (0, 0)]


def route(cells, cell_size, yaw=math.nan):
    waypoint = np.column_stack([np.array(cells, float) * cell_size, np.full(len(cells), np.nan)])
    waypoint[-1, 2] = yaw
    return Route(waypoint=waypoint, level=np.zeros(len(cells)), speed=np.full(len(cells) - 1, np.inf))


def corridor(cells, cell_size, half_width):
    """Walls on both sides of an L-shaped route, as boxes of 2 cm."""
    x, y = np.array(cells[-1], float) * cell_size
    near, w = 0.3, half_width + 0.01
    outer = [(-near, -w, x + w, -w), (x + w, -w, x + w, y + near)]
    inner = [(-near, w, x - w, w), (x - w, w, x - w, y + near)]
    return World(name="corridor", levels=(Level(name="L1", walls=outer + inner, wall_thickness=0.02),))


def drive(routes, release=None, world=EMPTY, robot="turtlebot3_burger", **nav):
    """Poses f8[t,n,3], twists f8[t,n,2], reached i8[t,n], contacts and events until all routes are done."""
    fleet = Fleet(robots=(load_robot(robot),) * len(routes))
    last = np.array([len(route.speed) for route in routes])
    starts = np.array([[*route.waypoint[0, :2], 0.0] for route in routes])
    navigator = Waypoints(**nav).start(fleet, world, routes, PurePursuit(), PERIOD, 0)
    poses, twists, reached, contacts, events = [], [], [], [], []
    with Kinematic().open(world, fleet, starts, 0, PERIOD) as simulation:
        state = simulation.state
        for period in range(1200):
            now = period * PERIOD
            released = last if release is None else np.minimum(last, release(now))
            observation = FleetObservation(
                estimate=Estimate(pose=state.pose),
                odometry=Odometry(pose=state.pose, twist=state.twist),
                level=state.level,
            )
            motion = navigator.step(now, observation, Orders(released=released))
            poses.append(state.pose)
            twists.append(state.twist)
            reached.append(motion.reached)
            contacts += state.contacts.tolist()
            events += motion.events
            if (motion.reached == last).all() and not motion.twist.any() and not state.twist.any():
                break
            state = simulation.step(Inputs(twist=motion.twist))
    return np.array(poses), np.array(twists), np.array(reached), contacts, events


def cross_track(poses, route):
    ends = route.waypoint[:, :2]
    return point_segment_distance(poses[:, None, :2], ends[:-1], ends[1:]).min(axis=1)


@pytest.mark.parametrize("robot", ["turtlebot3_burger", "turtlebot3_waffle"])
@pytest.mark.parametrize("cell_size", [0.35, 0.4])
@pytest.mark.parametrize("cells", [L_SHAPE, ZIG_ZAG, THERE_AND_BACK], ids=["L", "zig-zag", "there and back"])
def test_a_robot_keeps_to_its_route_and_stops_at_its_end(cells, cell_size, robot):
    path = route(cells, cell_size)
    poses, twists, reached, _, events = drive([path], robot=robot)
    assert reached[-1, 0] == len(cells) - 1
    assert cross_track(poses[:, 0], path).max() < 0.07
    assert math.dist(poses[-1, 0, :2], path.waypoint[-1, :2]) < 0.03
    assert twists[:, 0, 0].max() <= load_robot(robot).max_speed
    assert not events


def test_a_robot_drives_straight_at_full_speed_through_waypoints():
    _, twists, _, _, _ = drive([route([(x, 0) for x in range(8)], 0.35)])
    assert np.allclose(twists[4:-10, 0, 0], 0.22)


def test_a_robot_that_must_stop_at_waypoints_stops():
    cells = [(x, 0) for x in range(5)]
    _, twists, reached, _, _ = drive([route(cells, 0.35)], waypoints="stop")
    for waypoint in range(1, 4):
        under_way = twists[np.flatnonzero(reached[:, 0] == waypoint), 0, 0]
        assert under_way.min() < 0.01


def test_a_robot_takes_the_yaw_of_its_goal():
    poses, _, reached, _, _ = drive([route(L_SHAPE, 0.35, yaw=-2.0)])
    assert reached[-1, 0] == len(L_SHAPE) - 1
    assert abs(math.remainder(poses[-1, 0, 2] + 2.0, math.tau)) <= 0.25


def test_a_robot_waits_at_the_end_of_the_released_segments_and_goes_on():
    path = route(L_SHAPE, 0.35)
    poses, _, reached, _, events = drive([path], release=lambda now: 3 if now < 15 else 8)
    at_rest = poses[round(14.9 / PERIOD), 0, :2]
    assert math.dist(at_rest, path.waypoint[3, :2]) < 0.03
    assert reached[-1, 0] == 8
    assert not events


def test_a_corridor_only_a_little_wider_than_the_robot_is_driven_without_contact():
    radius = load_robot("turtlebot3_burger").radius
    path = route(L_SHAPE, 0.4)
    _, _, reached, contacts, _ = drive([path], world=corridor(L_SHAPE, 0.4, radius + 0.06))
    assert reached[-1, 0] == 8
    assert not contacts


def test_a_robot_behind_a_wall_gives_up():
    wall = World(name="wall", levels=(Level(name="L1", walls=[[0.6, -1, 0.6, 1]]),))
    _, _, reached, contacts, events = drive(
        [route([(0, 0), (1, 0), (2, 0), (3, 0)], 0.35)], world=wall, max_recoveries=1, movement_time_allowance=5.0
    )
    assert reached[-1, 0] == 1
    assert contacts
    assert [event.kind for event in events] == ["no_progress", "recovery", "no_progress", "aborted"]


def test_equal_runs_agree_to_the_last_bit():
    def run():
        routes = [route(L_SHAPE, 0.35), route([(x, y + 6) for x, y in ZIG_ZAG], 0.35)]
        poses, twists, reached, _, _ = drive(routes)
        return poses.tobytes(), twists.tobytes(), reached.tobytes()

    assert run() == run()
