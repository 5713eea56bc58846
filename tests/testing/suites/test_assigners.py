"""The suites catch faults of assigners: each plugin here has one and fails its check."""

import attrs
import numpy as np
from mrpbench_tests.variant import variant

from mrpbench_core.api import (
    Assigner,
    AssignmentError,
)
from mrpbench_core.model.planning.assignment import Assignment
from mrpbench_core.testing import failed_checks, suite_for


@attrs.frozen(kw_only=True)
class Greedy(Assigner):
    """Takes the cheapest pair that is left: feasible but not optimal."""

    def assign(self, problem):
        costs, task = problem.costs.copy(), np.full(len(problem.costs), -1)
        for _ in range(min(costs.shape)):
            robot, chosen = np.unravel_index(costs.argmin(), costs.shape)
            if not np.isfinite(costs[robot, chosen]):
                raise AssignmentError("stuck")
            task[robot] = chosen
            costs[robot], costs[:, chosen] = np.inf, np.inf
        rows = np.flatnonzero(task >= 0)
        return Assignment(task=task, cost=problem.costs[rows, task[rows]].sum())


def test_an_assigner_that_is_greedy_keeps_its_contract():
    assert failed_checks(suite_for(Greedy())) == {}


def test_an_assigner_that_promises_to_be_optimal_and_is_greedy():
    found = failed_checks(suite_for(variant(Greedy, optimal=True)()))
    assert found.keys() == {"is optimal", "avoids forbidden pairs"}
    assert "must not declare `optimal`" in found["is optimal"]


def test_an_assigner_that_names_another_cost():
    def assign(self, problem):
        return attrs.evolve(Greedy().assign(problem), cost=0.0)

    assert failed_checks(suite_for(variant(Greedy, assign=assign)())).keys() == {"says what its assignment costs"}


def test_an_assigner_that_gives_all_the_first_task():
    def assign(self, problem):
        return Assignment(task=np.zeros(len(problem.costs), int), cost=0.0)

    found = failed_checks(suite_for(variant(Greedy, assign=assign)()))
    assert {
        "gives each task to one robot",
        "says what its assignment costs",
        "avoids forbidden pairs",
        "raises an assignment error when nothing is feasible",
    } <= found.keys()
