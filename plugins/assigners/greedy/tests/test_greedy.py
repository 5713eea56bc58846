"""Greedy takes the cheapest pair again and again."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_assigners_greedy.greedy import Greedy

from mrpbench_core.api.assigner import AssignmentError
from mrpbench_core.model.planning.assignment import AssignmentProblem


@given(st.integers(1, 5), st.integers(1, 5), st.integers(0, 2**32 - 1))
def test_each_pair_is_the_cheapest_of_those_left(robots, tasks, seed):
    costs = np.random.default_rng(seed).integers(0, 6, (robots, tasks)) * 1.0
    found = Greedy().assign(AssignmentProblem(costs=costs)).task
    left = costs.copy()
    for robot in sorted(np.flatnonzero(found >= 0), key=lambda robot: costs[robot, found[robot]]):
        assert costs[robot, found[robot]] == left.min()
        left[robot], left[:, found[robot]] = np.inf, np.inf


def test_a_choice_that_leaves_only_forbidden_pairs_is_an_error():
    with pytest.raises(AssignmentError, match="only forbidden ones after 1 pairs"):
        Greedy().assign(AssignmentProblem(costs=np.array([[1.0, 2.0], [2.0, np.inf]])))
