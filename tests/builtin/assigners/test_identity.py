"""Identity gives robot i task i."""

import numpy as np
import pytest

from mrpbench_core.builtin.assigners.identity import Identity
from mrpbench_core.checking.assignment import check_assignment
from mrpbench_core.model.planning.assignment import AssignmentProblem


@pytest.mark.parametrize(
    ("robots", "tasks", "expected"),
    [(3, 3, [0, 1, 2]), (2, 3, [0, 1]), (3, 2, [0, 1, -1]), (2, 0, [-1, -1]), (0, 2, [])],
)
def test_robot_i_gets_task_i(robots, tasks, expected):
    problem = AssignmentProblem(costs=np.ones((robots, tasks)))
    assignment = Identity().assign(problem)
    assert assignment.task.tolist() == expected
    assert np.isnan(assignment.cost)
    assert check_assignment(problem, assignment) == []
