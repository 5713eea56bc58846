"""Doors and lifts in motion."""

import attrs
import numpy as np
import pytest

from mrpbench_core.model.worlds.facilities import STOREY_HEIGHT, Facilities, ride_time
from mrpbench_core.model.worlds.level_layout import LevelLayout
from mrpbench_core.model.worlds.world import Door, Level, World
from mrpbench_core.testing.fixtures.building import CABIN, RISE, building

NO_ROBOTS = np.empty((0, 3)), np.empty(0, np.int16), np.empty(0)


@pytest.fixture
def facilities():
    return Facilities(building())


def run(facilities, state, commands, seconds, robots=NO_ROBOTS, period=0.05):
    for _ in range(round(seconds / period)):
        state = facilities.advance(state, commands, period, *robots)
    return state


def test_everything_has_a_name_and_begins_shut(facilities):
    assert facilities.names == ("door", "lift/entrance", "lift")
    assert facilities.initial_state() == {"door": 0.0, "lift/entrance": 0.0, "lift": 0.0}


def test_doors_without_a_name_or_with_one_name_get_one():
    doors = tuple(Door(name=name, start=(0, y), end=(1, y)) for y, name in enumerate(["", "a", "b"]))
    levels = (Level(name="L1", doors=doors), Level(name="L2", doors=doors[1:2]))
    assert Facilities(World(name="w", levels=levels)).names == ("L1/#0", "L1/a#1", "b", "L2/a#0")


def test_doors_and_cabins_take_their_time(facilities):
    state = run(facilities, facilities.initial_state(), {"door": 1.0, "lift": RISE}, 1.0)
    assert state == {"door": pytest.approx(0.5), "lift/entrance": 0.0, "lift": pytest.approx(1.0)}
    state = run(facilities, state, {"door": 1.0, "lift": RISE}, 2.5)
    assert (state["door"], state["lift"]) == (1.0, RISE)
    assert run(facilities, state, {}, 1.0) == state


def test_a_leaf_stops_before_a_robot_and_goes_on_when_it_is_gone(facilities):
    opened = facilities.initial_state() | {"door": 1.0}
    robot = np.array([[2.0, 1.5, 0.0]]), np.zeros(1, np.int16), np.array([0.1])
    stopped = run(facilities, opened, {"door": 0.0}, 10.0, robot)["door"]
    assert 0.5 < stopped < 0.7  # its edge is at y = 1 + (1 - opening)
    assert run(facilities, opened, {"door": 0.0}, 10.0)["door"] == 0.0
    elsewhere = robot[0], np.ones(1, np.int16), robot[2]
    assert run(facilities, opened, {"door": 0.0}, 10.0, elsewhere)["door"] == 0.0


def test_a_robot_that_touches_a_closed_door_does_not_keep_it_closed(facilities):
    robot = np.array([[1.885, 1.5, 0.0]]), np.zeros(1, np.int16), np.array([0.1])
    assert run(facilities, facilities.initial_state(), {"door": 1.0}, 3.0, robot)["door"] == 1.0


def test_cabins_carry_the_robots_in_them_on_their_level(facilities):
    pose = np.array([[*CABIN, 0.0], [*CABIN, 0.0], [1.0, 1.0, 0.0]])
    before, after = facilities.initial_state(), facilities.initial_state() | {"lift": 2.0}
    assert facilities.carry(before, after, pose, np.array([0, 1, 0], np.int16)).tolist() == [1, 1, 0]


def test_doors_of_a_lift_are_shut_where_the_cabin_is_not(facilities):
    here, elsewhere = (
        facilities.outlines(facilities.initial_state() | {"lift/entrance": 1.0, "lift": height}, 0)
        for height in (0.0, RISE)
    )
    assert not np.array_equal(here, elsewhere)
    assert np.array_equal(elsewhere, facilities.outlines(facilities.initial_state(), 0))


def test_levels_without_elevations_are_a_storey_apart():
    world = building()
    flat = attrs.evolve(world, levels=tuple(attrs.evolve(level, elevation=0.0) for level in world.levels))
    assert Facilities(flat).heights == {"lift": {0: 0.0, 1: STOREY_HEIGHT}}
    assert ride_time(world, world.lifts[0], 0, 1) == pytest.approx(2 * 0.8 + RISE)


def test_levels_are_out_of_reach_of_each_other():
    layout = LevelLayout(building(), reach=10.0)
    places = np.array([[0.0, 0.0, 0.3], [4.0, 3.0, 0.2]])
    low, high = (layout.to_plane(places, np.full(2, level, np.int16)) for level in (0, 1))
    assert np.array_equal(low, places)
    assert high[:, 0].min() - low[:, 0].max() > 10.0
    assert layout.to_levels(high, np.ones(2, np.int16)) == pytest.approx(places)
    assert len(layout.segments) == 2 * 6 * 4
