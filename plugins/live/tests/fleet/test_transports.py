"""Transports count as done by where robots were, whatever anybody says; steps end when they pile up."""

import json
import os

import numpy as np
import pytest
from mrpbench_live.fleet.paths import FleetPaths, FleetState
from mrpbench_live.fleet.steps import LoadSteps
from mrpbench_live.fleet.transports import LoadStream, Transports

from mrpbench_core.api import InputError, Roadmap, Task, TaskStream

PAIRS = [(i, i + 1) for i in range(9)]
LINE = Roadmap(
    position=[(float(i), 0.0) for i in range(10)],
    level=[0] * 10,
    heading=np.full(10, np.nan),
    edges=PAIRS + [(head, tail) for tail, head in PAIRS],
    duration=[[10] * 18],
    tick=0.1,
)


class Listed(TaskStream):
    """Gives each task at its release."""

    def __init__(self, *tasks):
        self.left = list(tasks)

    def released(self, now, finished):
        del finished
        due = [task for task in self.left if task.release <= now + 1e-9]
        self.left = [task for task in self.left if task not in due]
        return due


class Hall:
    """Robots on the line, which a test puts where it likes."""

    def __init__(self, starts, *tasks, window=1000.0, growth=2.0):
        self.paths = FleetPaths(LINE, np.array(starts))
        self.steps = LoadSteps(growth, window, 0)
        self.transports = Transports(Listed(*tasks), LINE, self.steps)
        self.now, self.driving = 0.0, np.zeros(len(starts), bool)

    def send(self, robot, to):
        start = self.paths.end(robot)
        way = range(start, to) if to > start else range(8 + start, 8 + to, -1)
        self.paths.append(robot, tuple(way))
        self.paths.allowed[robot] = self.paths.length[robot]

    def arrive(self, robot):
        self.paths.passed[robot] = self.paths.released[robot] = self.paths.length[robot]

    def step(self, seconds=1.0):
        self.now += seconds
        count = len(self.paths)
        state = FleetState(
            now=self.now,
            pose=np.zeros((count, 3)),
            level=np.zeros(count, np.int16),
            driving=self.driving.copy(),
            gave_up=np.zeros(count, bool),
            velocity=np.zeros((count, 3)),
        )
        _, events = self.transports.update(state, self.paths)
        self.paths.adopt(np.zeros(count, np.int64))
        return [(event.kind, event.robot) for event in events]


def task(*errands, release=0.0, service=0.0, index=0):
    places = [(number, x) for number, some in enumerate(errands) for x in some]
    return Task(
        goals=[(x, 0.0, np.nan) for _, x in places],
        errand=[number for number, _ in places],
        levels=[0] * len(places),
        release=release,
        service=[service] * len(errands),
        index=index,
    )


def test_one_robot_has_to_do_all_errands_in_order():
    hall = Hall([0, 9], task([3], [6]))
    assert hall.step() == [("transport_released", -1)]
    hall.send(1, 6)
    hall.arrive(1)
    assert hall.step() == []  # the second errand first
    hall.send(0, 3)
    assert hall.step() == [("transport_ordered", 0)]
    hall.arrive(0)
    assert hall.step() == []
    hall.send(1, 4)
    hall.arrive(1)
    assert hall.step() == []  # robot 1 has not been at the first
    hall.send(0, 6)
    hall.arrive(0)
    assert hall.step() == [("transport_done", 0)]
    assert hall.transports.open == {}


def test_a_robot_rests_for_as_long_as_the_task_says():
    hall = Hall([0], task([2, 4], service=3.0))
    hall.step()
    hall.send(0, 4)
    hall.driving[:] = True
    hall.step()
    hall.arrive(0)
    assert hall.step(5.0) == []  # it is there, and drives
    hall.driving[:] = False
    assert hall.step() == []
    assert hall.step(2.0) == []
    assert hall.step() == [("transport_done", 0)]


def test_a_robot_that_is_there_already_needs_no_order():
    hall = Hall([3], task([3]))
    assert hall.step() == [("transport_released", -1), ("transport_ordered", 0), ("transport_done", 0)]


def test_the_rate_rises_until_transports_pile_up():
    tasks = [task([9], release=float(number), index=number) for number in range(100)]
    hall = Hall([9], *tasks, window=20.0)
    found = []
    for second in range(60):
        if second == 40:
            hall.send(0, 0)
            hall.arrive(0)
        found += [kind for kind, _ in hall.step() if kind == "load_step"]
        if hall.steps.ended:
            break
    assert len(found) == 3
    assert hall.steps.ended
    assert LoadStream(hall.steps).ended
    assert not LoadStream().ended
    assert hall.step() == []  # nothing is released any more


def test_a_step_says_what_it_came_to():
    hall = Hall([0, 5], *(task([5], release=float(number), index=number) for number in range(3)), window=5.0)
    hall.paths.append(0, (0, 1, 2))  # whose base is nothing yet
    details = []
    for _ in range(5):
        hall.now += 1.0
        state = FleetState(
            now=hall.now,
            pose=np.zeros((2, 3)),
            level=np.zeros(2, np.int16),
            driving=np.zeros(2, bool),
            gave_up=np.zeros(2, bool),
            velocity=np.zeros((2, 3)),
        )
        details += [event.detail for event in hall.transports.update(state, hall.paths)[1] if event.kind == "load_step"]
    (found,) = map(json.loads, details)
    assert (found["offered"], found["done"], found["open"], found["kept_up"]) == (3, 3, 0, True)
    assert found["offered_per_hour"] == pytest.approx(2160)
    assert found["starved"] == pytest.approx(0.5)
    assert found["cpu"] is None


def test_the_outside_party_is_measured():
    steps = LoadSteps(2.0, 1.0, os.getpid())
    hall = Hall([0])
    hall.steps = hall.transports.steps = steps
    sum(number * number for number in range(300_000))
    hall.step(0.5)
    hall.step(0.5)
    assert steps.factor == 2.0
    with pytest.raises(InputError, match="there is no process"):
        LoadSteps(2.0, 1.0, 2**22 + 1)
