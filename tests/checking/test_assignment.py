"""Assignments that are none are found and named."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.checking.assignment import check_assignment, check_choice, check_queues
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.planning.assignment import Assignment, AssignmentProblem, QueueProblem
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Rules
from mrpbench_core.model.planning.scenario import Task

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


def test_robots_that_choose_one_goal_are_found_even_where_they_disappear_there(make):
    lane = make.grid(1, 5)
    asked = make.problem(lane, [0, 1, 4], goals=(((2, 3, 4),),) * 3, rules=Rules(at_goal="disappear"))
    stays, short, other = make.path(lane), make.path(lane, (1, 2, 1)), make.path(lane, (0, 1, 1), (1, 2, 2))
    shared = Plan(paths=(other, short, stays))
    assert check_plan(asked, shared).valid
    assert check_choice(asked, shared) == ["robots 0 and 1 take the same goal, vertex 2, so that a task is left undone"]
    apart = Plan(paths=(make.path(lane, (0, 1, 1), (1, 2, 2), (2, 3, 3)), short, stays))
    assert check_choice(asked, apart) == []


@pytest.mark.parametrize(
    ("queues", "said"),
    [
        ([(0,), (1,)], None),
        ([(1, 0), ()], None),
        (None, "returned None instead of one queue for each of 2 robots"),
        ([(0,)], "instead of one queue for each of 2 robots"),
        ([(0,), "ab"], "gave robot 1 'ab' instead of a queue"),
        ([(0,), ("a",)], "gave robot 1 task a, which does not exist"),
        ([(np.nan,), ()], "gave robot 0 task nan, which does not exist"),
        ([(2,), ()], "gave robot 0 task 2, which does not exist"),
        ([(0, 1), (0,)], "gave task 0 twice"),
        ([(), (1, 0)], "gave task 0 to robot 1, which cannot do it"),
        ([(), ()], None),
    ],
)
def test_queues_hold_each_task_at_most_once(queues, said):
    problem = QueueProblem(
        now=0.0,
        tasks=tuple(Task(goals=[[0.0, 0.0, 0.0]], index=index) for index in range(2)),
        queues=((), ()),
        free_in=np.zeros(2),
        approach=np.array([[0.0, 0.0], [np.inf, 0.0]]),
        length=np.zeros((2, 2)),
        between=np.zeros((0, 0, 0)),
        profile=np.zeros(2, np.int32),
    )
    found = check_queues(problem, queues)
    assert found == said or said in found
