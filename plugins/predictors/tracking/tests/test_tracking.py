"""Tracks by synthetic scans, against the places from which these are made."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_native.tracking import STEP, Fleet

Scan = Callable[..., np.ndarray]
WALL = np.array([(-10.0, 2.5, 10.0, 2.5), (10.0, -6.0, -10.0, -6.0)])
ORIGIN = np.zeros((1, 3))
ONE = np.zeros(1, np.int32)
PERIOD = 0.2


def fleet(
    robots: int = 1, walls: np.ndarray = WALL, threads: int = 1, social_force: bool = False, **options: float
) -> Fleet:
    return Fleet(
        walls=walls,
        mount=np.zeros((robots, 2)),
        radius=np.full(robots, 0.11),
        options=options,
        social_force=social_force,
        threads=threads,
    )


def moving(tracker: Fleet) -> np.ndarray:
    """The tracks f8[k,6] of objects that move."""
    tracks = tracker.tracks(0)
    return tracks[(tracks[:, 4] >= 3) & (np.hypot(tracks[:, 2], tracks[:, 3]) >= 0.3)]


def follow(tracker: Fleet, scan: Scan, way: Callable[[float], object], seconds: float) -> float:
    """Show what is at `way(now)` from 0 on, and return the time of the last scan."""
    times = np.arange(0, seconds + 1e-9, PERIOD)
    for now in times:
        tracker.see(now, ONE, ORIGIN, scan(way(now)))
    return float(times[-1])


@pytest.mark.parametrize("speed", [0.6, 1.3])
def test_a_person_who_walks_past_a_wall_is_tracked_and_predicted(scan: Scan, speed: float) -> None:
    tracker = fleet()
    now = follow(tracker, scan, lambda t: [(-2.5 + speed * t, 1.9)], 2.4)
    (track,) = moving(tracker)
    assert np.hypot(*(track[:2] - (-2.5 + speed * now, 1.9))) < 0.15
    assert np.hypot(*(track[2:4] - (speed, 0.0))) < 0.2
    robot, place = tracker.predict(now + 0.05)
    assert robot.tolist() == [0]
    assert place.shape == (1, 31, 2)
    ahead = -2.5 + speed * (now + 0.05 + 10 * STEP)
    assert np.hypot(*(place[0, 10] - (ahead, 1.9))) < 0.35


def test_two_who_cross_keep_their_tracks(scan: Scan) -> None:
    tracker = fleet()
    ways = lambda t: [(-1.5 + 1.0 * t, 1.2), (1.5 - 1.0 * t, 1.9)]  # noqa: E731
    times = np.arange(0, 3.01, PERIOD)
    for now in times:
        tracker.see(now, ONE, ORIGIN, scan(ways(now), radius=0.2))
    tracks = moving(tracker)
    tracks = tracks[np.argsort(tracks[:, 0])]
    assert len(tracks) == 2
    assert tracks[0, 2] < -0.7
    assert tracks[1, 2] > 0.7
    assert np.hypot(*(tracks[:, :2] - [ways(times[-1])[1], ways(times[-1])[0]]).T).max() < 0.25


def test_an_object_behind_another_one_is_predicted_on_until_it_is_lost(scan: Scan) -> None:
    tracker = fleet(lost_after=1.0)
    hidden = lambda t: [(-1.5 + 1.2 * t, 1.9)]  # noqa: E731
    now = follow(tracker, scan, hidden, 1.2)
    screen = np.array([(-0.3, 0.4, 0.9, 0.4)])
    for later in np.arange(now + PERIOD, now + 0.9, PERIOD):
        tracker.see(later, ONE, ORIGIN, scan(hidden(later), walls=np.vstack([WALL, screen])))
        (track,) = moving(tracker)[:1]
        assert track[5] == pytest.approx(now)
        assert np.hypot(*(track[:2] - hidden(later)[0])) < 0.3
    for later in np.arange(now + 1.0, now + 1.5, PERIOD):
        tracker.see(later, ONE, ORIGIN, scan([]))
    assert not len(moving(tracker))


def test_walls_people_who_stand_and_robots_of_the_fleet_are_no_objects_that_move(scan: Scan) -> None:
    tracker = fleet(robots=2)
    for now in np.arange(0, 3, PERIOD):
        other = (-1.5 + 0.7 * now, -2.0)
        poses = np.array([(0.0, 0.0, 0.0), (*other, 0.0)])
        tracker.see(now, ONE, poses, scan([(1.0, 1.0), (*other,)], radius=0.11))
        assert not len(moving(tracker))
    tracks = tracker.tracks(0)
    assert np.hypot(*(tracks[:, :2] - (1.0, 1.0)).T) == pytest.approx([0.0], abs=0.05)


def test_a_robot_that_is_not_of_the_fleet_is_an_object(scan: Scan) -> None:
    tracker = fleet()
    follow(tracker, scan, lambda t: [(-1.5 + 0.7 * t, -2.0)], 2.4)
    assert len(moving(tracker)) == 1


def test_what_is_wider_than_an_object_is_not_tracked(scan: Scan) -> None:
    tracker = fleet()
    for now in np.arange(0, 2, PERIOD):
        x = -1.0 + 0.5 * now
        box = np.array([(x, 1.0, x + 1.5, 1.0)])
        tracker.see(now, ONE, ORIGIN, scan([], walls=np.vstack([WALL, box])))
    assert not len(tracker.tracks(0))


def test_two_legs_are_one_person(scan: Scan) -> None:
    tracker = fleet()
    stride = lambda t: 0.35 * np.sin(2 * np.pi * t / 1.05)  # noqa: E731
    for now in np.arange(0, 3.01, PERIOD):
        x = -2.0 + 1.3 * now
        legs = [(x + stride(now), 1.3), (x - stride(now), 1.45)]
        tracker.see(now, ONE, ORIGIN, scan(legs, radius=0.05))
    (track,) = moving(tracker)
    assert abs(track[2] - 1.3) < 0.5
    assert abs(track[3]) < 0.4


def test_beams_on_an_object_that_moves_are_taken_out_of_the_scan(scan: Scan) -> None:
    tracker = fleet()
    for now in np.arange(0, 2.4, PERIOD):
        ranges = scan([(-1.5 + 1.0 * now, 1.2), (1.0, -1.0)])
        left = tracker.see(now, ONE, ORIGIN, ranges)
        empty = scan([(1.0, -1.0)])
        walker = ranges < empty - 1e-9
        assert (left[~walker] == ranges[~walker]).all()
    assert walker.any()
    assert (left[walker] == -1).all()


@settings(max_examples=20)
@given(st.integers(0, 2**32 - 1), st.booleans())
def test_results_do_not_depend_on_the_number_of_threads_or_on_calls(seed: int, social_force: bool) -> None:
    draw = np.random.default_rng(seed)
    poses = np.column_stack([draw.uniform(-5, 5, (4, 2)), draw.uniform(-3, 3, 4)])
    one, more = (fleet(4, threads=threads, social_force=social_force) for threads in (1, 3))
    robots = np.arange(4, dtype=np.int32)
    start = np.full((4, 90), 3.0)
    for step in range(6):
        ranges = start.copy()
        for robot in robots:
            ranges[robot, 10 * robot + step : 10 * robot + step + 6] = 1.0 + 0.1 * step
        assert (one.see(0.2 * step, robots, poses, ranges) == more.see(0.2 * step, robots, poses, ranges)).all()
    for found, expected in zip(more.predict(1.1), one.predict(1.1), strict=True):
        assert (found == expected).all()


@settings(max_examples=30)
@given(st.floats(-3, 3), st.floats(-5, 1.8), st.floats(-1.4, 1.4), st.floats(-1.4, 1.4))
def test_predictions_by_constant_velocity_are_straight_and_begin_at_the_track(
    x: float, y: float, vx: float, vy: float
) -> None:
    tracker = fleet()
    for step in range(4):  # a pole that one beam or two hit
        place = np.array([x + vx * step * PERIOD, y + vy * step * PERIOD])
        ranges = np.full((1, 360), np.inf)
        ranges[0, np.round(np.arctan2(place[1], place[0]) / (2 * np.pi) * 360).astype(int) % 360] = np.hypot(*place)
        tracker.see(step * PERIOD, ONE, ORIGIN, ranges)
    _, place = tracker.predict(3 * PERIOD)
    tracks = moving(tracker)
    assert len(place) == len(tracks)
    for way, track in zip(place, tracks, strict=True):
        expected = track[:2] + np.arange(31)[:, None] * STEP * track[2:4]
        assert np.allclose(way, expected, atol=1e-9)
