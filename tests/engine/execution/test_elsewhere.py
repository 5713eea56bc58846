"""Robots that take no tasks for now, because their stream sends them elsewhere."""

import numpy as np
import pytest
from mrpbench_tests.execution.task_steps import TaskSteps, until_done
from mrpbench_tests.instances.problems import grid_of, problem_on

from mrpbench_core.builtin.task_sources.listed import ListedStream
from mrpbench_core.model.planning.scenario import Task

prioritized = pytest.importorskip("mrpbench_planners_mapf.prioritized")
greedy = pytest.importorskip("mrpbench_assigners_greedy")
ROOM = grid_of(["......", "......"])
END = 5
"""The vertex at the right end of the first row."""


class Sending(ListedStream):
    """A stream that sends robots where the test says."""

    def __init__(self, tasks):
        super().__init__(tasks)
        self.sent, self.poses = {}, []

    def elsewhere(self, now, state):
        self.poses.append(state.pose[:, :2].tolist())
        return dict(self.sent)


def task_to(vertex, index, service=0.0, release=0.0):
    return Task(goals=[(*ROOM.position[vertex], np.nan)], service=[service], index=index, release=release)


def place_of(vertex):
    return (*ROOM.position[vertex].tolist(), 0)


def steps(tasks, starts=(0,)):
    stream = Sending(tasks)
    return TaskSteps(problem_on(ROOM, starts, starts), stream, greedy.Greedy(), prioritized.Prioritized()), stream


def test_a_robot_goes_to_its_place_and_its_task_to_another():
    run, stream = steps([task_to(END, 0)], starts=(4, 0))
    stream.sent = {0: place_of(6)}
    assert until_done(run, 40) < np.inf
    for _ in range(10):
        run.step()
    assert run.at.tolist() == [6, END]
    assert not run.ledger.faults


def test_a_task_that_is_begun_is_finished_first():
    run, stream = steps([task_to(1, 0, service=6.0), task_to(2, 1, release=4.0)])
    while not any(task.begun for task in run.ledger.open.values()):
        run.step()
    stream.sent = {0: place_of(END)}
    for _ in range(20):
        run.step()
    assert [*run.ledger.open] == [1], "the other task waits"
    assert run.at.tolist() == [END]
    stream.sent = {}
    assert until_done(run, 20) < np.inf


def test_without_a_place_a_robot_stays_and_takes_nothing():
    run, stream = steps([task_to(END, 0)])
    stream.sent = {0: None}
    for _ in range(10):
        run.step()
    assert run.at.tolist() == [0]
    assert [*run.ledger.open] == [0]


def test_robots_that_are_sent_to_one_place_come_one_after_the_other():
    run, stream = steps([task_to(3, 0), task_to(9, 1)], starts=(0, 6))
    stream.sent = {1: place_of(END)}
    for _ in range(20):
        run.step()
    stream.sent = {0: None, 1: place_of(END)}
    for _ in range(5):
        run.step()
    stream.sent = {0: place_of(END)}
    assert until_done(run, 40) < np.inf
    for _ in range(15):
        run.step()
    assert run.at.tolist()[0] == END
    assert not run.ledger.faults


def test_the_stream_is_told_the_true_state():
    run, stream = steps([task_to(2, 0)])
    until_done(run, 10)
    assert stream.poses[0] == [ROOM.position[0].tolist()]
    assert ROOM.position[1].tolist() in [pose[0] for pose in stream.poses]
