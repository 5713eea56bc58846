"""Fleets from entries."""

import pytest

from mrpbench_core.config.settings import FleetEntry, LidarOptions
from mrpbench_core.engine.prepare.fleet import build_fleet
from mrpbench_core.files.errors import InputError


def names(*entries, size):
    return [robot.name for robot in build_fleet(entries, size).robots]


BURGER, WAFFLE = "turtlebot3_burger", "turtlebot3_waffle"


def test_one_entry_makes_the_whole_fleet():
    assert names(FleetEntry(robot=BURGER), size=3) == [BURGER] * 3


def test_entries_without_a_count_share_the_remaining_robots():
    entries = FleetEntry(robot=BURGER), FleetEntry(robot=WAFFLE, count=1), FleetEntry(robot=WAFFLE)
    assert names(*entries, size=6) == [BURGER] * 3 + [WAFFLE] + [WAFFLE] * 2


@pytest.mark.parametrize("size", [1, 4])
def test_counts_that_do_not_add_up_are_refused(size):
    with pytest.raises(InputError, match=f"the counts add up to 3, the scenario has {size} robots"):
        build_fleet([FleetEntry(robot=BURGER, count=3)], size)


def test_the_lidar_can_be_changed_or_taken_off():
    changed = FleetEntry(robot=BURGER, lidar=LidarOptions(beams=90))
    first, second = build_fleet([changed, FleetEntry(robot=BURGER, lidar="none")], 2).robots
    assert (first.lidar.beams, first.lidar.range) == (90, 3.5)
    assert second.lidar is None


def test_a_lidar_that_sees_nothing_is_refused():
    with pytest.raises(InputError, match="is not below"):
        build_fleet([FleetEntry(robot=BURGER, lidar=LidarOptions(range=0.1))], 1)
