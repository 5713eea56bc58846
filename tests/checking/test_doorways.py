"""Robots that start where doors would hit them."""

import attrs
import numpy as np
import pytest

from mrpbench_core.checking.doorways import check_doorways
from mrpbench_core.model.planning.roadmap import Resource, Roadmap
from mrpbench_core.model.worlds.world import Door, Level, World

HINGED = Door(name="ward", start=(0, 0), end=(1, 0), motion="hinged", motion_direction=-1)
"""Its leaf turns up around (0, 0)."""
PLACES = {"in it": (0.5, 0.05), "in the swing": (0.5, 0.5), "beyond the swing": (0.9, 0.9), "below": (0.5, -0.5)}


def faults(door, place, used=True, level=0, radius=0.1):
    roadmap = Roadmap(
        position=[PLACES[place]],
        level=[level],
        heading=[np.nan],
        edges=np.empty((0, 2)),
        duration=np.empty((1, 0)),
        tick=1.0,
        resources=(Resource(name=door.name, kind="door"),) if used else (),
    )
    world = World(name="w", levels=(Level(name="L1", doors=(door,)), Level(name="L2")))
    return check_doorways(world, roadmap, np.zeros(1, int), np.array([radius]), [place])


@pytest.mark.parametrize(
    ("place", "found"),
    [
        ("in it", ["robot 0 starts at in it, in the closed door ward"]),
        ("in the swing", ["robot 0 starts at in the swing, where the leaf of door ward opens"]),
        ("beyond the swing", []),
        ("below", []),
    ],
)
def test_robots_that_start_in_a_door_or_in_its_swing_are_named(place, found):
    assert faults(HINGED, place) == found


def test_a_door_that_slides_or_is_not_in_use_blocks_no_start():
    assert faults(attrs.evolve(HINGED, motion="sliding"), "in the swing") == []
    assert faults(HINGED, "in the swing", used=False) == []
    assert faults(HINGED, "in it", used=False) == ["robot 0 starts at in it, in the closed door ward"]


def test_larger_robots_reach_farther_and_other_levels_do_not():
    assert faults(HINGED, "beyond the swing", radius=0.5) != []
    assert faults(HINGED, "in the swing", level=1) == []


def test_a_start_off_the_roadmap_is_for_others_to_name():
    empty = Roadmap(
        position=np.empty((0, 2)),
        level=[],
        heading=[],
        edges=np.empty((0, 2)),
        duration=np.empty((1, 0)),
        tick=1.0,
    )
    assert check_doorways(World(name="w", levels=(Level(name="L1"),)), empty, np.array([-1]), np.ones(1)) == []
