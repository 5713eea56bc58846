import math
from itertools import pairwise

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_navigators_waypoints import Waypoints
from mrpbench_navigators_waypoints.route_follower import RouteFollower

from mrpbench_core.model.execution.route import Route

RULES = Waypoints().arrival_rules
CUTTING = Waypoints(path_end="release").arrival_rules
CLEARANCE = 0.25


class Follower:
    """A fleet of one, whose pose is asked for only where it matters."""

    def __init__(self, route, rules, clearance, beyond_bends=False):
        self.fleet = RouteFollower([route], rules, np.array([clearance]), beyond_bends)

    def update(self, x, y, yaw, speed, released):
        self.pose = np.array([[x, y, yaw]])
        twist = np.array([[speed, 0.0]])
        self.fleet.update(self.pose, twist, np.array([released], np.int32), np.zeros(1, np.int16))
        self.fleet.survey(0.0, self.pose, twist)

    def adopt(self, route):
        self.fleet.adopt([route])

    reached = property(lambda self: self.fleet.reached[0])
    cleared = property(lambda self: self.fleet.cleared[0])
    under_way = property(lambda self: bool(self.fleet.under_way[0]))
    yaw = property(lambda self: self.fleet.yaw[0])
    speed = property(lambda self: self.fleet.speed[0])

    @property
    def path(self):
        if not self.fleet.following[0]:
            return None
        return np.vstack([self.fleet.foot, self.fleet.corners[self.fleet.begin[0] : self.fleet.end[0]]])


def route(points, yaw=math.nan, speed=math.inf):
    waypoint = np.column_stack([np.array(points, float), np.full(len(points), np.nan)])
    waypoint[-1, 2] = yaw
    segments = len(points) - 1
    return Route(waypoint=waypoint, level=np.zeros(segments + 1), speed=np.full(segments, speed))


def follow(points, poses, released=None, rules=RULES, **options):
    """The follower after some poses (x, y, yaw), one control period apart, with everything released."""
    follower = Follower(route(points, **options), rules, CLEARANCE)
    for pose in poses:
        follower.update(*pose, 0.2, len(points) - 1 if released is None else released)
    return follower


LINE = [(0, 0), (0.4, 0), (0.8, 0), (1.2, 0)]
CORNER = [(0, 0), (0.4, 0), (0.4, 0.4), (0.4, 0.8)]


def along(line, step=0.02):
    """Poses along a polyline."""
    poses = []
    for (ax, ay), (bx, by) in pairwise(line):
        count = max(1, round(math.dist((ax, ay), (bx, by)) / step))
        yaw = math.atan2(by - ay, bx - ax)
        poses += [(ax + (bx - ax) * k / count, ay + (by - ay) * k / count, yaw) for k in range(count + 1)]
    return poses


def test_nothing_is_reached_nor_cleared_at_the_start_and_nothing_to_drive_without_release():
    follower = follow(LINE, [(0, 0, 0)], released=0)
    assert (follower.reached, follower.cleared, follower.under_way) == (0, 0, False)
    assert follower.path is None


def test_a_robot_that_waits_turns_to_the_next_waypoint_if_it_may():
    rules = Waypoints(turn_ahead=True).arrival_rules
    for pose, released, turns in (
        ((0, 0, -1), 0, True),  # at the start
        ((0.4, 0, 0), 1, True),
        ((0.4, 0, math.pi / 2), 1, False),  # it faces it
        ((0.4, 0.8, 0), 3, False),  # at the end any yaw will do
    ):
        follower = follow(CORNER, [*along(CORNER[: released + 1]), pose], released=released, rules=rules)
        assert follower.under_way == turns
        assert (follower.path is not None) == turns
        assert not follow(CORNER, [*along(CORNER[: released + 1]), pose], released=released).under_way


def test_a_robot_does_not_turn_ahead_while_it_drives():
    follower = follow(CORNER, [(0.1, 0, 0)], released=1, rules=Waypoints(turn_ahead=True).arrival_rules)
    assert math.isnan(follower.yaw)


def test_waypoints_are_reached_within_the_tolerance_and_only_as_far_as_released():
    assert follow(LINE, along([(0, 0), (0.29, 0)])).reached == 0
    assert follow(LINE, along([(0, 0), (0.31, 0)])).reached == 1
    assert follow(LINE, along([(0, 0), (1.2, 0)]), released=2).reached == 2
    assert follow(LINE, along([(0, 0), (1.2, 0)])).reached == 3


def test_a_waypoint_is_reached_by_passing_close_to_it_but_not_far_from_it():
    assert follow(LINE, [(0, 0, 0), (0.55, 0.09, 0)]).reached == 1
    assert follow(LINE, [(0, 0, 0), (0.55, 0.11, 0)]).reached == 0


def test_a_segment_is_cleared_when_the_robot_leaves_room_at_its_start():
    assert follow(LINE, along([(0, 0), (0.24, 0)])).cleared == 0
    assert follow(LINE, along([(0, 0), (0.26, 0)])).cleared == 1
    # Near the first waypoint it has not yet left room for another at the second one's start.
    assert follow(LINE, along([(0, 0), (0.6, 0)])).cleared == 1
    assert follow(LINE, along([(0, 0), (1.2, 0)])).cleared == 3


def test_a_segment_no_longer_than_the_clearance_is_cleared_when_its_end_is_reached():
    short = [(0, 0), (0.2, 0), (0.4, 0)]
    assert follow(short, along([(0, 0), (0.09, 0)])).cleared == 0
    follower = follow(short, along([(0, 0), (0.2, 0)]), released=1)
    assert (follower.reached, follower.cleared) == (1, 1)


@pytest.mark.parametrize(
    "points", [LINE, CORNER, [(0, 0), (0.36, 0)], [(0, 0), (0.3, 0)], [(0, 0), (0.4, 0), (0, 0), (0.4, 0)]]
)
def test_a_robot_rests_only_where_it_has_cleared_the_place_before_its_goal(points):
    rules = Waypoints(xy_goal_tolerance=0.25).arrival_rules
    follower, robot = Follower(route(points), rules, CLEARANCE), iter(along(points))
    while follower.fleet.reached[0] < len(points) - 1:
        follower.update(*next(robot), 0.2, len(points) - 1)
    assert follower.cleared == len(points) - 1


def test_a_robot_that_makes_room_waits_only_where_it_has_cleared_the_place_before():
    aside = [(0, 0), (0.3, 0), (0.3, 0), (0, 0)]
    for x, counts in ((0.24, (0, 0)), (0.26, (2, 1))):
        follower = follow(aside, along([(0, 0), (x, 0)]), released=2)
        assert (follower.reached, follower.cleared) == counts
    assert follower.fleet.tables.tolerance == pytest.approx(0.3 - CLEARANCE, abs=1e-5)


def test_a_robot_that_cannot_come_nearer_to_a_place_with_little_room_is_near_the_end_of_its_path():
    follower = follow([(0, 0), (0.3, 0)], along([(0, 0), (0.24, 0)]))
    assert not follower.reached
    assert [follower.fleet.is_near_path_end(0, x, 0.0) for x in (0.19, 0.21, 0.24, 0.26)] == [False, True, True, False]
    follower.fleet.skip_path_end(0)
    assert follower.reached == 1


def test_a_tolerance_of_the_goal_is_not_made_smaller_than_that_of_waypoints():
    near = [*along([(0, 0), (0.8, 0)]), (1.0, 0, 0)]
    for tolerance, reached in ((0.25, 3), (0.10, 2)):
        rules = Waypoints(xy_goal_tolerance=0.25, waypoint_tolerance=tolerance).arrival_rules
        assert follow(LINE, near, rules=rules).reached == reached


def test_a_wait_is_reached_at_once_and_cleared_with_the_move_after_it():
    waiting = [(0, 0), (0.4, 0), (0.4, 0), (0.4, 0), (0.8, 0)]
    follower = follow(waiting, along([(0, 0), (0.4, 0)]), released=3)
    assert (follower.reached, follower.cleared) == (3, 1)
    assert not follower.under_way
    follower.update(0.6, 0, 0, 0.2, 4)
    assert (follower.reached, follower.cleared) == (3, 1)
    follower.update(0.66, 0, 0, 0.2, 4)
    assert (follower.reached, follower.cleared) == (3, 4)


def test_a_robot_that_comes_back_does_not_clear_early():
    there_and_back = [(0, 0), (0.4, 0), (0, 0), (0.4, 0)]
    follower = follow(there_and_back, along([(0, 0), (0.31, 0)]))
    assert (follower.reached, follower.cleared) == (1, 1)
    for pose in along([(0.31, 0), (0.0, 0)]):
        follower.update(*pose, 0.2, 3)
    assert (follower.reached, follower.cleared) == (2, 2)


def test_the_path_begins_next_to_the_robot_and_ends_where_the_release_ends():
    follower = follow(LINE, along([(0, 0), (0.5, 0)]), released=2)
    assert np.allclose(follower.path, [(0.5, 0), (0.8, 0)])


@settings(deadline=None, max_examples=100)
@given(
    st.lists(st.sampled_from([(0.4, 0), (-0.4, 0), (0, 0.4), (0, -0.4), (0, 0)]), min_size=1, max_size=8),
    st.data(),
)
def test_no_path_leads_beyond_what_is_released(steps, data):
    points = [(0.0, 0.0), *np.cumsum(steps, axis=0).tolist()]
    follower, driven, released = Follower(route(points), RULES, CLEARANCE), 0, 0
    for _ in range(3):
        released = data.draw(st.integers(released, len(steps)))
        for x, y, yaw in along(points[driven : released + 1], step=0.05):
            follower.update(x, y, yaw, 0.2, released)
            assert driven <= follower.reached <= released
            path = follower.path
            if path is not None:
                ends = [points[index] for index in range(follower.reached, released + 1)]
                assert min(math.dist(path[-1], end) for end in ends) < 1e-9
        driven = released


def test_a_robot_that_waits_before_a_bend_does_not_go_round_it():
    follower = follow(CORNER, along([(0, 0), (0.35, 0)]), released=1)
    assert follower.reached == 1
    assert np.allclose(follower.path, [(0.35, 0), (0.4, 0)])


def test_the_path_ends_at_a_bend_until_it_is_reached():
    follower = follow(CORNER, along([(0, 0), (0.2, 0)]))
    assert np.allclose(follower.path, [(0.2, 0), (0.4, 0)])
    follower = follow(CORNER, along([(0, 0), (0.35, 0)]))
    assert np.allclose(follower.path, [(0.35, 0), (0.4, 0), (0.4, 0.4), (0.4, 0.8)])
    follower = follow(CORNER, [*along([(0, 0), (0.35, 0)]), (0.38, 0.05, 1.5)])
    assert np.allclose(follower.path, [(0.4, 0.05), (0.4, 0.4), (0.4, 0.8)])


def test_a_robot_that_has_reached_the_end_drives_on_to_the_very_end_and_stands_there():
    follower = follow(LINE, along([(0, 0), (1.12, 0)]))
    assert follower.reached == 3
    assert follower.path is not None
    follower.update(1.19, 0, 0, 0.2, 3)
    assert follower.path is None


def test_the_goal_has_a_yaw_when_the_route_prescribes_one():
    follower = follow(LINE, along([(0, 0), (1.2, 0)]), yaw=1.5)
    assert follower.reached == 2
    assert follower.path is not None
    follower.update(1.2, 0, 1.4, 0.0, 3)
    assert follower.reached == 3
    assert follower.path is None


def test_a_robot_arrives_with_the_yaw_with_which_it_rests_and_not_with_that_of_its_last_move():
    for rests_with, arrives in ((math.nan, True), (1.5, True), (0.0, False)):
        waypoint = np.array([(x, y, 0.0) for x, y in LINE] + [(*LINE[-1], rests_with)])
        follower = Follower(attrs.evolve(route([*LINE, LINE[-1]]), waypoint=waypoint), RULES, CLEARANCE)
        for x, y, _ in along([LINE[0], LINE[-1]]):
            follower.update(x, y, 1.5, 0.2, len(LINE))
        assert (follower.reached == len(LINE)) == arrives


def test_the_yaw_of_the_goal_is_not_to_be_taken_at_a_bend_before_it():
    follower = follow(CORNER, along([(0, 0), (0.2, 0)]), yaw=1.5)
    assert math.isnan(follower.yaw)
    follower.update(0.35, 0, 0, 0.2, 3)
    assert follower.yaw == 1.5


def test_stopping_at_waypoints_means_standing_still_at_each():
    stop = Waypoints(waypoints="stop").arrival_rules
    follower = follow(LINE, along([(0, 0), (0.31, 0)]), rules=stop)
    assert follower.reached == 1
    assert follower.path is None
    follower.update(0.31, 0, 0, 0.005, 3)
    assert np.allclose(follower.path, [(0.31, 0), (0.4, 0), (0.8, 0)])


def test_a_longer_route_continues_where_the_old_one_was():
    follower = follow(LINE, along([(0, 0), (0.9, 0)]))
    longer = [*LINE[:3], (0.8, 0.4), (0.8, 0.8)]
    follower.adopt(route(longer))
    follower.update(0.8, 0.0, 0, 0.2, 4)
    assert (follower.reached, follower.cleared) == (2, 2)
    assert np.allclose(follower.path[-1], (0.8, 0.8))


def test_the_speed_limit_is_that_of_the_segment_under_way():
    limits = attrs.evolve(route(LINE), speed=np.array([0.1, 0.2, math.inf]))
    follower = Follower(limits, RULES, CLEARANCE)
    seen = []
    for pose in along([(0, 0), (1.2, 0)]):
        follower.update(*pose, 0.2, 3)
        seen.append(follower.speed)
    assert list(dict.fromkeys(seen)) == [0.1, 0.2, math.inf]


def test_a_robot_that_need_not_move_has_arrived():
    follower = Follower(route([(1, 1)]), RULES, CLEARANCE)
    follower.update(1, 1, 0, 0, 0)
    assert not follower.under_way
    assert follower.path is None
    waits = follow([(1, 1), (1, 1)], [(1, 1, 0)])
    assert waits.reached == 1


def test_a_robot_that_need_not_move_still_takes_the_yaw_that_is_wanted():
    follower = Follower(route([(1, 1)], yaw=2.0), RULES, CLEARANCE)
    follower.update(1, 1, 0, 0, 0)
    assert follower.under_way
    assert np.allclose(follower.path, [(1, 1), (1, 1)])
    assert follower.yaw == 2.0
    follower.update(1, 1, 1.9, 0, 0)
    assert not follower.under_way
    assert follower.path is None


def test_a_robot_that_comes_back_to_its_route_farther_on_has_reached_what_lies_before():
    follower = follow(LINE, along([(0, 0), (0.2, 0)]))
    follower.fleet.rejoin(0, 0.9, 0.0)
    assert follower.reached == 2
    follower.update(0.9, 0.0, 0.0, 0.2, 3)
    assert np.allclose(follower.path, [(0.9, 0), (1.2, 0)])
    assert follower.cleared == 2


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 2**32 - 1))
def test_robots_in_a_fleet_do_not_disturb_one_another(seed):
    random = np.random.default_rng(seed)
    routes = [route(np.cumsum(random.choice([-0.4, 0, 0.4], (6, 2)), axis=0)) for _ in range(4)]
    together = RouteFollower(routes, RULES, np.full(4, CLEARANCE))
    alone = [RouteFollower([each], RULES, np.full(1, CLEARANCE)) for each in routes]
    for step in range(40):
        pose = np.column_stack([[each.waypoint[step // 8, :2] for each in routes], np.zeros(4)])
        pose[:, :2] += random.uniform(-0.1, 0.1, (4, 2))
        released = np.full(4, 1 + step // 8, np.int32)
        together.update(pose, np.tile([0.2, 0.0], (4, 1)), released, np.zeros(4, np.int16))
        for robot, single in enumerate(alone):
            single.update(pose[robot : robot + 1], np.array([[0.2, 0.0]]), released[:1], np.zeros(1, np.int16))
            assert (single.reached[0], single.cleared[0]) == (together.reached[robot], together.cleared[robot])


def test_a_robot_that_stops_at_waypoints_turns_there_to_the_next():
    stop = Waypoints(waypoints="stop").arrival_rules
    there = (0.4, 0.0, 0.0)
    follower = follow(CORNER, [there, there], rules=stop)
    assert follower.reached == 0
    assert follower.yaw == math.pi / 2
    turned = follow(CORNER, [there, (0.4, 0.0, math.pi / 2 - 0.2)], rules=stop)
    assert turned.reached == 1


def test_an_occupied_waypoint_can_be_skipped_and_the_route_continues_next_to_it():
    follower = follow(LINE, [(0.2, 0.0, 0.0)], rules=Waypoints(waypoints="stop").arrival_rules)
    follower.fleet.skip_path_end(0)
    follower.update(0.3, 0.2, 0.0, 0.0, 3)
    assert follower.reached == 1
    assert follower.path[-1].tolist() == [0.8, 0.0]


def test_the_last_waypoint_can_be_skipped_too():
    follower = follow(LINE, [(0.4, 0.0, 0.0), (0.8, 0.0, 0.0), (1.0, 0.0, 0.0)])
    follower.fleet.skip_path_end(0)
    follower.update(1.0, 0.1, 0.0, 0.0, 3)
    assert follower.reached == 3
    assert not follower.under_way


def test_beyond_bends_the_path_ends_with_the_released_part_and_corners_may_be_cut():
    points = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2)]
    follower = Follower(route(points), CUTTING, CLEARANCE, beyond_bends=True)
    follower.update(0.2, 0, 0, 0.2, 3)
    assert follower.path.tolist() == [[0.2, 0], [1, 0], [1, 1], [2, 1]]
    follower.update(0.85, 0.2, 0, 0.2, 3)  # beyond the bisector of the bend
    assert follower.reached == 1
    assert follower.path.tolist() == [[1, 0.2], [1, 1], [2, 1]]
    near = Follower(route(points), RULES, CLEARANCE)
    near.update(0.2, 0, 0, 0.2, 3)
    assert near.path.tolist() == [[0.2, 0], [1, 0]]


def test_beyond_bends_the_path_ends_where_it_turns_back_until_the_robot_is_there():
    follower = Follower(route([(0, 0), (1, 0), (1, 1), (1, 0), (0, 0)]), CUTTING, CLEARANCE, beyond_bends=True)
    follower.update(0.2, 0, 0, 0.2, 4)
    assert follower.path.tolist() == [[0.2, 0], [1, 0], [1, 1]]
    follower.update(1, 0.8, math.pi / 2, 0.2, 4)
    assert follower.path.tolist() == [[1, 0.8], [1, 1]]
    follower.update(1, 0.95, math.pi / 2, 0.2, 4)
    assert follower.reached == 2
    assert follower.path.tolist()[1:] == [[1, 0], [0, 0]]


def test_a_robot_that_cut_corners_has_passed_them_when_it_is_back_near_its_route():
    points = [(0, 0), (2, 0), (2, 0.4), (0, 0.4)]
    follower = Follower(route(points), CUTTING, CLEARANCE, beyond_bends=True)
    follower.update(1.6, 0.1, 0, 0.2, 3)
    assert follower.reached == 0
    follower.update(1.5, 0.35, math.pi, 0.2, 3)  # 0.5 m before both corners
    assert (follower.reached, follower.cleared) == (2, 3)
    assert follower.path.tolist() == [[1.5, 0.4], [0, 0.4]]


def test_a_robot_beside_a_part_of_its_route_far_ahead_has_not_passed_all_before():
    follower = Follower(route([(0, 0), (2, 0), (2, 0.4), (0, 0.4)]), CUTTING, CLEARANCE, beyond_bends=True)
    follower.update(1.0, 0.4, 0, 0.2, 3)
    assert follower.reached == 0


def test_a_robot_far_from_its_route_has_passed_nothing():
    follower = Follower(route([(0, 0), (2, 0), (2, 2)]), CUTTING, CLEARANCE, beyond_bends=True)
    follower.update(1.2, 1.4, 0, 0.2, 2)
    assert follower.reached == 0


def test_a_lift_and_the_end_of_the_released_part_are_not_passed():
    there_and_back = [(0, 0), (0.4, 0), (0.4, 0), (0, 0), (0, 2)]
    upstairs = attrs.evolve(route(there_and_back), level=np.array([0, 0, 1, 1, 1], np.int16))
    follower = Follower(upstairs, CUTTING, CLEARANCE, beyond_bends=True)
    follower.update(-0.1, 0.5, 0, 0.2, 4)
    assert follower.reached == 0
    follower = Follower(route(there_and_back), CUTTING, CLEARANCE, beyond_bends=True)
    follower.update(-0.1, 0.5, 0, 0.2, 3)
    assert follower.reached == 0
    follower.update(-0.1, 0.5, 0, 0.2, 4)
    assert (follower.reached, follower.cleared) == (3, 4)
