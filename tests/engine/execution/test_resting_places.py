"""Robots come to rest where they leave room for one another, whether or not all are of one size."""

import attrs
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_tests.instances.problems import grid_of, problem_on

from mrpbench_core.engine.execution.resting_places import Neighbourhoods, RestingPlaces

ROOM = grid_of([".....", "....."])
SPACING = float(np.hypot(*(ROOM.position[1] - ROOM.position[0])))


@settings(deadline=None, max_examples=60)
@given(
    st.lists(st.sampled_from([0.3, 0.6, 0.8]), min_size=4, max_size=4),
    st.booleans(),
    st.lists(st.integers(0, 9), min_size=3, max_size=3),
)
def test_a_place_is_left_to_a_robot_that_overlaps_no_other_there(sizes, equal, vertices):
    radius = SPACING * np.array([sizes[0]] * 4 if equal else sizes)
    problem = attrs.evolve(problem_on(ROOM, (0, 1, 2, 3), (0, 1, 2, 3)), radius=radius)
    taken = RestingPlaces(Neighbourhoods(problem))
    for robot, vertex in enumerate(vertices):
        taken.add(robot, vertex)
    for robot in range(4):
        for vertex in range(10):
            apart = [
                vertex != at
                and np.hypot(*(ROOM.position[vertex] - ROOM.position[at])) >= radius[robot] + radius[other] - 1e-6
                for other, at in enumerate(vertices)
                if other != robot
            ]
            assert taken.leaves(robot, vertex) == all(apart)
    assert taken.free(3).tolist() == [taken.leaves(3, vertex) for vertex in range(10)]
