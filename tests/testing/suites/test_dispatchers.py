"""The suites catch faults of dispatchers: each plugin here has one and fails its check."""

import copy

import numpy as np
from mrpbench_tests.variant import variant

from mrpbench_core.api import (
    BatchSession,
    Dispatcher,
    DispatcherSession,
)
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.model.execution.orders import BatchOrders, Orders
from mrpbench_core.testing import DispatcherConformance, failed_checks, suite_for


class Session(DispatcherSession):
    """Releases everything."""

    def __init__(self, problem, plan):
        self.adopt(problem, plan)

    def adopt(self, problem, plan, cut=None):
        self.length = np.array([len(path) for path in plan.paths])

    def update(self, now, view):
        return Orders(released=self.length)


def session(**methods):
    made = type("Changed", (Session,), methods)
    return variant(Dispatcher, start=lambda self, problem, plan: made(problem, plan))()


def test_a_dispatcher_that_takes_back():
    found = failed_checks(
        suite_for(session(update=lambda self, now, view: Orders(released=self.length if now < 1 else 0 * self.length)))
    )
    assert "takes back" in found["releases ever more of each path"]


def test_a_dispatcher_that_releases_nothing():
    found = failed_checks(suite_for(session(update=lambda self, now, view: Orders(released=0 * self.length))))
    assert "wait forever" in found["plans drain under delays and robots do not meet"]
    assert "goes on with a new plan" in found


def test_a_dispatcher_that_claims_to_keep_robots_apart():
    def start(self, problem, plan):
        Adg().start(problem, plan)  # refuses conflicts
        return Session(problem, plan)

    found = failed_checks(suite_for(variant(Dispatcher, start=start)()))
    assert set(found) == {
        "plans drain under delays and robots do not meet",
        "requests mutexes",
        "refuses plans through doors or requests the doors",
    }


def test_a_dispatcher_that_says_it_keeps_robots_apart():
    class Suite(DispatcherConformance):
        keeps_apart = True

        def make(self):
            return made

    made = session()
    assert failed_checks(Suite()).keys() == {
        "plans drain under delays and robots do not meet",
        "refuses or survives plans with conflicts",
        "requests mutexes",
        "refuses plans through doors or requests the doors",
    }


def test_a_dispatcher_that_ignores_mutexes_need_not_keep_robots_apart():
    assert set(failed_checks(suite_for(session()))) == {"refuses plans through doors or requests the doors"}


def test_a_dispatcher_that_releases_more_in_many_executions():
    class Everything(BatchSession):
        def __init__(self, executions, length):
            self.orders = BatchOrders(released=np.tile(length, (executions, 1)))

        def update(self, now, seen):
            return self.orders

    def update(self, now, view):
        return Orders(released=np.minimum(self.length, view.reached + 1))

    changes = {"batch": lambda self, executions: Everything(executions, self.length), "update": update}
    found = failed_checks(suite_for(session(**changes)))
    assert "releases other moves" in found["many executions at once are those of each session"]


def test_a_dispatcher_whose_copies_share_what_changes():
    def update(self, now, view):
        self.calls[0] += 1
        return Orders(released=np.minimum(self.length, self.calls[0]))

    def adopt(self, problem, plan, cut=None):
        Session.adopt(self, problem, plan)
        self.calls = [0]

    found = failed_checks(suite_for(session(update=update, adopt=adopt, copied=copy.copy)))
    assert "a copy returns other orders than the session" in found["copies go on as their sessions do"]
