"""Insertion builds queues in which tasks are done early."""

from itertools import permutations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_assigners_greedy.insertion import Insertion

from mrpbench_core.model.planning.assignment import QueueProblem
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.testing import AssignerConformance


class TestRegret(AssignerConformance):
    def make(self):
        return Insertion(regret=True)


def on_a_line(robots, pairs, free_in=None):
    """Robots at x, tasks from x to x, one second per metre."""
    robots, pairs = np.array(robots, float), np.array(pairs, float)
    return QueueProblem(
        now=0.0,
        tasks=tuple(Task(goals=[[a, 0, 0], [b, 0, 0]], levels=[0, 0]) for a, b in pairs),
        queues=((),) * len(robots),
        free_in=np.zeros(len(robots)) if free_in is None else free_in,
        approach=abs(robots[:, None] - pairs[None, :, 0]),
        length=np.tile(abs(pairs[:, 1] - pairs[:, 0]), (len(robots), 1)),
        between=abs(pairs[:, None, 1] - pairs[None, :, 0])[None],
        profile=np.zeros(len(robots), np.int32),
    )


def sum_of_times(problem, queues):
    total = 0.0
    for robot, queue in enumerate(queues):
        time, last = problem.free_in[robot], None
        for task in queue:
            time += problem.approach[robot, task] if last is None else problem.between[0, last, task]
            time += problem.length[robot, task]
            total, last = total + time, task
    return total


@pytest.mark.parametrize("regret", [False, True])
@given(x=st.integers(0, 20), pairs=st.lists(st.tuples(st.integers(0, 20), st.integers(0, 20)), min_size=1, max_size=2))
def test_one_robot_does_two_tasks_in_the_better_order(regret, x, pairs):
    problem = on_a_line([x], pairs)
    best = min(sum_of_times(problem, [order]) for order in permutations(range(len(pairs))))
    assert sum_of_times(problem, Insertion(regret=regret).assign_queues(problem)) == pytest.approx(best)


def test_a_busy_robot_nearby_gets_a_task_before_a_free_one_far_away():
    problem = on_a_line([0, 100], [(5, 6)], free_in=np.array([10.0, 0.0]))
    assert Insertion().assign_queues(problem) == ((0,), ())


def test_a_robot_that_gave_up_gets_no_task():
    problem = on_a_line([0, 100], [(5, 6), (7, 8)], free_in=np.array([np.inf, 0.0]))
    assert Insertion().assign_queues(problem)[0] == ()


def test_with_regret_the_task_that_has_only_one_good_robot_gets_it():
    problem = on_a_line([0, 18], [(9, 19), (0, 10)])
    oldest_first, regret = (Insertion(regret=on).assign_queues(problem) for on in (False, True))
    assert sum_of_times(problem, regret) <= sum_of_times(problem, oldest_first)
    assert regret == ((1,), (0,))
