"""The Hungarian method finds the same cost as trying all assignments."""

import numpy as np
import pytest
from hypothesis import given, settings
from mrpbench_assigners_hungarian import Hungarian

from mrpbench_core.api import AssignmentError
from mrpbench_core.checking.assignment import check_assignment
from mrpbench_core.model.planning.assignment import AssignmentProblem
from mrpbench_core.testing.strategies import assignment_problems
from mrpbench_core.testing.suites.assigner import assignments

OBJECTIVES = ("sum", "bottleneck")


def worth(paid, objective):
    """The primary objective, and the secondary one."""
    return (sum(paid) if objective == "sum" else max(paid, default=0.0)), sum(paid)


@pytest.mark.parametrize("objective", OBJECTIVES)
@settings(deadline=None, max_examples=200)
@given(problem=assignment_problems())
def test_the_assignment_is_the_best_of_all(problem, objective):
    expected = min((worth(paid, objective) for paid in assignments(problem.costs)), default=None)
    if expected is None:
        with pytest.raises(AssignmentError, match="not forbidden"):
            Hungarian(objective=objective).assign(problem)
        return
    assignment = Hungarian(objective=objective).assign(problem)
    assert check_assignment(problem, assignment) == []
    found = worth([problem.costs[robot, task] for robot, task in enumerate(assignment.task) if task >= 0], objective)
    assert assignment.cost == pytest.approx(found[0])
    assert found == pytest.approx(expected, rel=1e-6, abs=1e-5)


@pytest.mark.parametrize("objective", OBJECTIVES)
def test_costs_of_any_magnitude_and_sign_are_told_apart(objective):
    costs = np.array([[1.0, 2.0], [3.0, 5.0]])  # 2 + 3 beats 1 + 5, and 3 beats 5
    for scaled in (costs * 1e-9, costs * 1e12, costs - 10):
        assert Hungarian(objective=objective).assign(AssignmentProblem(costs=scaled)).task.tolist() == [1, 0]


def test_the_same_matrix_gives_the_same_assignment():
    costs = np.random.default_rng(5).integers(0, 3, (9, 9)).astype(float)  # many ties
    recipe = Hungarian()
    assert recipe.assign(AssignmentProblem(costs=costs)) == recipe.assign(AssignmentProblem(costs=costs))


@pytest.mark.parametrize("objective", OBJECTIVES)
@pytest.mark.parametrize("forbidden", [np.inf, -np.inf, np.nan])
def test_a_pair_without_a_finite_cost_is_forbidden(objective, forbidden):
    problem = AssignmentProblem(costs=[[forbidden, 9.0], [1.0, 1.0]])
    assert Hungarian(objective=objective).assign(problem).task.tolist() == [1, 0]
