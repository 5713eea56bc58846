"""The doors and lifts that plans use."""

import itertools

import attrs
import pytest

from mrpbench_core.checking.facility_use import check_facility_use
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.roadmap import Resource


def uses(make, kind, vertex, *routes):
    """The doors and lifts that robots use on routes along a line of six vertices, one of which is a resource."""
    line = attrs.evolve(make.grid(1, 6), resources=(Resource(name="gate", kind=kind, vertices=(vertex,)),))
    paths = [
        make.path(line, *((a, b, tick + 1) for tick, (a, b) in enumerate(itertools.pairwise(route))))
        for route in routes
    ]
    return check_facility_use(make.problem(line, [route[0] for route in routes]), Plan(paths=tuple(paths)))


@pytest.mark.parametrize("kind", ["door", "lift"])
def test_each_robot_that_enters_a_door_or_lift_is_named_once(make, kind):
    twice = [0, 1, 2, 1, 0, 1, 2, 1]
    assert uses(make, kind, 2, twice, [5, 5, 5, 5, 5, 5, 5, 5, 5, 4, 3, 2]) == [
        f"robot 0 uses the {kind} gate",
        f"robot 1 uses the {kind} gate",
    ]


def test_a_robot_that_starts_in_a_doorway_uses_the_door(make):
    assert uses(make, "door", 0, [0, 1]) == ["robot 0 uses the door gate"]


def test_mutexes_and_doors_beside_the_path_do_not_count(make):
    assert uses(make, "mutex", 2, [0, 1, 2]) == []
    assert uses(make, "door", 4, [0, 1, 2]) == []
