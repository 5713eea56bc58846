"""Robots choose tasks one after another, and leave each other's places alone."""

import attrs
import numpy as np
from mrpbench_assigners_greedy.token_passing import TokenPassing

from mrpbench_core.model.planning.assignment import QueueProblem
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.testing import AssignerConformance


class TestTaskSwaps(AssignerConformance):
    def make(self):
        return TokenPassing(task_swaps=True)


def sets(vertices):
    """Errands at one place each, or at any of several."""
    return tuple(it if isinstance(it, tuple) else (it,) for it in vertices)


def queue_problem(approach, errands, free_in=None, queues=None, ahead=None):
    """Tasks whose errands are at vertices `errands`."""
    approach = np.array(approach, float)
    robots = len(approach)
    return QueueProblem(
        now=0.0,
        tasks=tuple(Task(goals=np.zeros((len(it), 3)), index=index) for index, it in enumerate(errands)),
        queues=queues or ((),) * robots,
        free_in=np.zeros(robots) if free_in is None else np.array(free_in, float),
        approach=approach,
        length=np.ones(approach.shape),
        between=np.empty((0, 0, 0)),
        profile=np.zeros(robots, np.int32),
        errands=tuple(map(sets, errands)),
        ahead=tuple(map(sets, ahead or ((),) * robots)),
    )


def test_each_robot_in_turn_takes_the_nearest_task_that_is_left():
    problem = queue_problem([[1, 2], [0, 9]], [(5, 6), (7, 8)])
    assert TokenPassing().assign_queues(problem) == ((0,), (1,))


def test_a_task_with_a_place_to_which_another_robot_goes_waits():
    shared = queue_problem([[1, 2], [1, 2]], [(5, 6), (7, 6)])
    assert TokenPassing().assign_queues(shared) == ((0,), ())
    busy = queue_problem([[1, 2], [1, 2]], [(5, 6), (7, 8)], free_in=[0, 9], ahead=[(), (6,)])
    assert TokenPassing().assign_queues(busy) == ((1,), ())


def test_a_task_waits_until_a_place_is_left_for_each_errand():
    docks = (5, 6)
    shared = queue_problem([[1, 2, 3]] * 3, [(docks, 7), (docks, 8), (docks, 9)])
    assert TokenPassing().assign_queues(shared) == ((0,), (1,), ())
    busy = queue_problem([[1, 2], [1, 2]], [(docks, 7), (4, 8)], free_in=[0, 9], ahead=[(), (5, 6)])
    assert TokenPassing().assign_queues(busy) == ((1,), ())


def test_a_nearer_robot_takes_a_task_over_only_with_swaps_and_the_other_chooses_again():
    problem = queue_problem([[5, 7], [2, 9]], [(5, 6), (7, 8)], queues=((0,), ()))
    assert TokenPassing().assign_queues(problem) == ((0,), (1,))
    assert TokenPassing(task_swaps=True).assign_queues(problem) == ((1,), (0,))


def test_a_robot_that_gave_up_loses_its_task():
    problem = queue_problem([[1], [2]], [(5,)], free_in=[np.inf, 0], queues=((0,), ()))
    assert TokenPassing().assign_queues(problem) == ((), (0,))
    assert TokenPassing().assign_queues(attrs.evolve(problem, free_in=np.full(2, np.inf))) == ((), ())
