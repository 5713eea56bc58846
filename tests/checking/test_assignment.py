"""Assignments that are none are found and named."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.checking.assignment import check_assignment
from mrpbench_core.model.assignment import Assignment, AssignmentProblem

COSTS = [[1.0, 2.0, np.inf], [3.0, 1.0, 1.0]]


def faults(task, costs=COSTS):
    return check_assignment(AssignmentProblem(costs=costs), Assignment(task=task, cost=0.0))


@pytest.mark.parametrize("task", [[0, 1], [1, 0], [0, 2], [1, 2]])
def test_an_assignment_of_the_smaller_side_is_sound(task):
    assert faults(task) == []


@pytest.mark.parametrize(
    ("task", "said"),
    [
        ([0], ["assigns 1 robots instead of 2"]),
        ([0, 3], ["names a task that does not exist"]),
        ([-2, 1], ["names a task that does not exist"]),
        ([1, 1], ["gives task 1 to 2 robots"]),
        ([2, 0], ["gives robot 0 the forbidden task 2"]),
        ([-1, 0], ["assigns 1 robots instead of 2"]),
        ([2, 2], ["gives task 2 to 2 robots", "gives robot 0 the forbidden task 2"]),
    ],
)
def test_each_fault_is_named(task, said):
    assert faults(task) == said


def test_more_robots_than_tasks_leave_robots_without_one():
    tall = np.transpose(COSTS)
    assert faults([0, 1, -1], tall) == []
    assert faults([0, -1, -1], tall) == ["assigns 1 robots instead of 2"]
    assert faults([-1, -1], np.empty((2, 0))) == []


@settings(deadline=None, max_examples=200)
@given(st.integers(0, 2**32 - 1))
def test_soundness_means_a_matching_as_large_as_the_smaller_side(seed):
    random = np.random.default_rng(seed)
    robots, tasks = random.integers(0, 4, 2)
    costs = np.where(random.random((robots, tasks)) < 0.2, np.inf, 1.0)
    task = random.integers(-1, tasks + 1, robots)
    given_tasks = [index for index in task.tolist() if index != -1]
    sound = (
        all(index < tasks for index in given_tasks)
        and len(set(given_tasks)) == len(given_tasks) == min(robots, tasks)
        and all(costs[robot, index] < np.inf for robot, index in enumerate(task.tolist()) if index != -1)
    )
    assert (not faults(task, costs)) == sound
