"""Both solvers answer as trying all pairings does."""

from itertools import permutations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from mrpbench_assigners_ortools import OrToolsMip, OrToolsSat

from mrpbench_core.api import AssignmentError
from mrpbench_core.checking.assignment import check_assignment
from mrpbench_core.model.assignment import AssignmentProblem

COST = st.floats(0, 100) | st.integers(0, 5).map(float) | st.just(float("inf"))
MATRIX = st.tuples(st.integers(0, 5), st.integers(0, 5)).flatmap(lambda shape: arrays("f8", shape, elements=COST))
OBJECTIVES = ("sum", "bottleneck")
RECIPES = (OrToolsMip, OrToolsSat)


def best_by_trying_all(costs, objective):
    """(value, sum among the best), None if every pairing holds a forbidden pair."""
    table = costs if costs.shape[0] <= costs.shape[1] else costs.T
    rows = range(len(table))
    paid = [
        [table[row, column] for row, column in zip(rows, chosen, strict=True)]
        for chosen in permutations(range(table.shape[1]), len(table))
    ]
    values = [
        (sum(row) if objective == "sum" else max(row, default=0.0), sum(row)) for row in paid if np.isfinite(row).all()
    ]
    return min(values, default=None)


@pytest.mark.parametrize("objective", OBJECTIVES)
@pytest.mark.parametrize("recipe", RECIPES)
@settings(deadline=None, max_examples=60)
@given(costs=MATRIX)
def test_the_assignment_is_the_best_of_all(recipe, costs, objective):
    problem = AssignmentProblem(costs=costs)
    expected = best_by_trying_all(costs, objective)
    if expected is None:
        with pytest.raises(AssignmentError, match="not forbidden"):
            recipe(objective=objective).assign(problem)
        return
    assignment = recipe(objective=objective).assign(problem)
    assert check_assignment(problem, assignment) == []
    paid = [costs[robot, task] for robot, task in enumerate(assignment.task) if task >= 0]
    value = sum(paid) if objective == "sum" else max(paid, default=0.0)
    assert assignment.cost == pytest.approx(value)
    assert (value, sum(paid)) == pytest.approx(expected, rel=1e-6, abs=1e-5)


@pytest.mark.parametrize("objective", OBJECTIVES)
@pytest.mark.parametrize("recipe", RECIPES)
def test_costs_of_any_magnitude_and_sign_are_told_apart(recipe, objective):
    costs = np.array([[1.0, 2.0], [3.0, 5.0]])  # 2 + 3 beats 1 + 5, and 3 beats 5
    for scaled in (costs * 1e-9, costs * 1e12, costs - 10):
        assert recipe(objective=objective).assign(AssignmentProblem(costs=scaled)).task.tolist() == [1, 0]


@pytest.mark.parametrize("recipe", RECIPES)
def test_the_same_matrix_gives_the_same_assignment(recipe):
    costs = np.random.default_rng(5).integers(0, 3, (9, 9)).astype(float)  # many ties
    first, second = (recipe().assign(AssignmentProblem(costs=costs)) for _ in range(2))
    assert first == second
