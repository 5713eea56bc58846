import math
from itertools import pairwise

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.builtin.navigators.follower import Follower
from mrpbench_core.builtin.navigators.waypoints import Waypoints
from mrpbench_core.model.execution import Mode, Route

OPTIONS = Waypoints(max_recoveries=2)
CLEARANCE = 0.25


def route(points, yaw=math.nan, speed=math.inf):
    waypoint = np.column_stack([np.array(points, float), np.full(len(points), np.nan)])
    waypoint[-1, 2] = yaw
    segments = len(points) - 1
    return Route(waypoint=waypoint, level=np.zeros(segments + 1), speed=np.full(segments, speed))


def follow(points, poses, released=None, navigator=OPTIONS, **options):
    """The follower after some poses (x, y, yaw), one control period apart, with everything released."""
    follower = Follower(route(points, **options), navigator, CLEARANCE)
    events = []
    for period, (x, y, yaw) in enumerate(poses):
        limit = len(points) - 1 if released is None else released
        events += follower.update(period * 0.05, x, y, yaw, 0.2, limit)
    return follower, events


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
    follower, _ = follow(LINE, [(0, 0, 0)], released=0)
    assert (follower.reached, follower.cleared, follower.mode) == (0, 0, Mode.WAITING)
    assert follower.path(0, 0, 0) is None


def test_waypoints_are_reached_within_the_tolerance_and_only_as_far_as_released():
    assert follow(LINE, along([(0, 0), (0.29, 0)]))[0].reached == 0
    assert follow(LINE, along([(0, 0), (0.31, 0)]))[0].reached == 1
    assert follow(LINE, along([(0, 0), (1.2, 0)]), released=2)[0].reached == 2
    assert follow(LINE, along([(0, 0), (1.2, 0)]))[0].reached == 3


def test_a_waypoint_passed_beside_is_reached_but_not_one_passed_far_off():
    assert follow(LINE, [(0, 0, 0), (0.55, 0.09, 0)])[0].reached == 1
    assert follow(LINE, [(0, 0, 0), (0.55, 0.11, 0)])[0].reached == 0


def test_a_segment_is_cleared_when_the_robot_leaves_room_at_its_start():
    assert follow(LINE, along([(0, 0), (0.24, 0)]))[0].cleared == 0
    assert follow(LINE, along([(0, 0), (0.26, 0)]))[0].cleared == 1
    # Near the first waypoint it has not yet left room for another at the second one's start.
    assert follow(LINE, along([(0, 0), (0.6, 0)]))[0].cleared == 1
    assert follow(LINE, along([(0, 0), (1.2, 0)]))[0].cleared == 3


def test_a_segment_no_longer_than_the_clearance_is_cleared_when_its_end_is_reached():
    short = [(0, 0), (0.2, 0), (0.4, 0)]
    assert follow(short, along([(0, 0), (0.09, 0)]))[0].cleared == 0
    follower, _ = follow(short, along([(0, 0), (0.2, 0)]), released=1)
    assert (follower.reached, follower.cleared) == (1, 1)


def test_a_wait_is_reached_at_once_and_cleared_with_the_move_after_it():
    waiting = [(0, 0), (0.4, 0), (0.4, 0), (0.4, 0), (0.8, 0)]
    follower, _ = follow(waiting, along([(0, 0), (0.4, 0)]), released=3)
    assert (follower.reached, follower.cleared) == (3, 1)
    assert follower.mode == Mode.WAITING
    follower.update(9, 0.6, 0, 0, 0.2, 4)
    assert (follower.reached, follower.cleared) == (3, 1)
    follower.update(9, 0.66, 0, 0, 0.2, 4)
    assert (follower.reached, follower.cleared) == (3, 4)


def test_a_robot_that_comes_back_does_not_clear_early():
    there_and_back = [(0, 0), (0.4, 0), (0, 0), (0.4, 0)]
    follower, _ = follow(there_and_back, along([(0, 0), (0.31, 0)]))
    assert (follower.reached, follower.cleared) == (1, 1)
    for pose in along([(0.31, 0), (0.0, 0)]):
        follower.update(1, *pose, 0.2, 3)
    assert (follower.reached, follower.cleared) == (2, 2)


def test_the_path_begins_beside_the_robot_and_ends_where_the_release_ends():
    follower, _ = follow(LINE, along([(0, 0), (0.5, 0)]), released=2)
    assert np.allclose(follower.path(0.5, 0.03, 0), [(0.5, 0), (0.8, 0)])


@settings(deadline=None, max_examples=100)
@given(
    st.lists(st.sampled_from([(0.4, 0), (-0.4, 0), (0, 0.4), (0, -0.4), (0, 0)]), min_size=1, max_size=8),
    st.data(),
)
def test_no_path_leads_beyond_what_is_released(steps, data):
    points = [(0.0, 0.0), *np.cumsum(steps, axis=0).tolist()]
    follower, driven, released = Follower(route(points), OPTIONS, CLEARANCE), 0, 0
    for _ in range(3):
        released = data.draw(st.integers(released, len(steps)))
        for x, y, yaw in along(points[driven : released + 1], step=0.05):
            follower.update(0, x, y, yaw, 0.2, released)
            assert driven <= follower.reached <= released
            path = follower.path(x, y, yaw)
            if path is not None:
                ends = [points[index] for index in range(follower.reached, released + 1)]
                assert min(math.dist(path[-1], end) for end in ends) < 1e-9
        driven = released


def test_a_robot_that_waits_before_a_bend_does_not_go_round_it():
    follower, _ = follow(CORNER, along([(0, 0), (0.35, 0)]), released=1)
    assert follower.reached == 1
    assert np.allclose(follower.path(0.35, 0, 0), [(0.35, 0), (0.4, 0)])


def test_the_path_ends_at_a_bend_until_it_is_reached():
    follower, _ = follow(CORNER, along([(0, 0), (0.2, 0)]))
    assert np.allclose(follower.path(0.2, 0, 0), [(0.2, 0), (0.4, 0)])
    follower, _ = follow(CORNER, along([(0, 0), (0.35, 0)]))
    assert np.allclose(follower.path(0.35, 0, 0), [(0.35, 0), (0.4, 0), (0.4, 0.4), (0.4, 0.8)])
    follower, _ = follow(CORNER, [*along([(0, 0), (0.35, 0)]), (0.38, 0.05, 1.5)])
    assert np.allclose(follower.path(0.38, 0.05, 1.5), [(0.4, 0.05), (0.4, 0.4), (0.4, 0.8)])


def test_a_robot_that_has_reached_the_end_drives_on_to_the_very_end_and_stands_there():
    follower, _ = follow(LINE, along([(0, 0), (1.12, 0)]))
    assert follower.reached == 3
    assert follower.path(1.12, 0, 0) is not None
    assert follower.path(1.19, 0, 0) is None


def test_the_goal_has_a_yaw_when_the_route_prescribes_one():
    follower, _ = follow(LINE, along([(0, 0), (1.2, 0)]), yaw=1.5)
    assert follower.reached == 2
    assert follower.path(1.2, 0, 0) is not None
    follower.update(9, 1.2, 0, 1.4, 0.0, 3)
    assert follower.reached == 3
    assert follower.path(1.2, 0, 1.4) is None


def test_the_yaw_of_the_goal_is_not_to_be_taken_at_a_bend_before_it():
    follower, _ = follow(CORNER, along([(0, 0), (0.2, 0)]), yaw=1.5)
    follower.path(0.2, 0, 0)
    assert math.isnan(follower.yaw)
    follower.update(9, 0.35, 0, 0, 0.2, 3)
    follower.path(0.35, 0, 0)
    assert follower.yaw == 1.5


def test_stopping_at_waypoints_means_standing_still_at_each():
    stop = Waypoints(waypoints="stop")
    follower, _ = follow(LINE, along([(0, 0), (0.31, 0)]), navigator=stop)
    assert follower.reached == 1
    assert follower.path(0.31, 0, 0) is None
    follower.update(9, 0.31, 0, 0, 0.005, 3)
    assert np.allclose(follower.path(0.31, 0, 0), [(0.31, 0), (0.4, 0), (0.8, 0)])


@pytest.mark.parametrize("released", [3, 2])
def test_a_robot_without_progress_tries_again_and_then_gives_up(released):
    stuck = [(0.31, 0, 0)] * 700  # 35 s
    follower, events = follow(LINE, stuck, released=released)
    assert events == ["no_progress", "no_progress", "no_progress", "aborted"]
    assert follower.mode == Mode.ABORTED
    assert follower.path(0.3, 0, 0) is None
    follower.adopt(route(LINE))
    assert (follower.mode, follower.reached) == (Mode.WAITING, 1)


def test_waiting_for_release_is_not_a_lack_of_progress():
    follower, events = follow(LINE, [(0.4, 0, 0)] * 700, released=1)
    assert not events
    assert follower.mode == Mode.WAITING


def test_a_longer_route_continues_where_the_old_one_was():
    follower, _ = follow(LINE, along([(0, 0), (0.9, 0)]))
    longer = [*LINE[:3], (0.8, 0.4), (0.8, 0.8)]
    follower.adopt(route(longer))
    follower.update(9, 0.8, 0.0, 0, 0.2, 4)
    assert (follower.reached, follower.cleared) == (2, 2)
    assert np.allclose(follower.path(0.8, 0.0, 0)[-1], (0.8, 0.8))


def test_the_speed_limit_is_that_of_the_segment_under_way():
    limits = attrs.evolve(route(LINE), speed=np.array([0.1, 0.2, math.inf]))
    follower = Follower(limits, OPTIONS, CLEARANCE)
    seen = []
    for pose in along([(0, 0), (1.2, 0)]):
        follower.update(0, *pose, 0.2, 3)
        seen.append(follower.speed)
    assert list(dict.fromkeys(seen)) == [0.1, 0.2, math.inf]


def test_a_robot_that_need_not_move_has_arrived():
    follower = Follower(route([(1, 1)]), OPTIONS, CLEARANCE)
    assert follower.update(0, 1, 1, 0, 0, 0) == ()
    assert follower.path(1, 1, 0) is None
    waits, _ = follow([(1, 1), (1, 1)], [(1, 1, 0)])
    assert waits.reached == 1
