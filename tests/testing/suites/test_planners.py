"""The suites catch faults of planners: each plugin here has one and fails its check."""

import time

import attrs
import numpy as np
import pytest
from mrpbench_tests.variant import variant

from mrpbench_core.api import (
    Planner,
    Promise,
)
from mrpbench_core.model.planning.plan import Plan, PlanResult, PlanStatus, RobotPath
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.testing import failed_checks, suite_for
from mrpbench_core.testing.drawing import problem
from mrpbench_core.testing.faults import Fault
from mrpbench_core.testing.planner_call import call


@attrs.frozen(kw_only=True)
class Still(Planner):
    """Returns plans in which no robot moves."""

    def plan(self, problem, budget):
        nothing = RobotPath(edge=[], enter=[], leave=[])
        return PlanResult(status=PlanStatus.SOLVED, plan=Plan(paths=(nothing,) * len(problem)))


class Bfs:
    """Shortest paths of robots alone, with conflicts."""

    @staticmethod
    def plan(asked):
        paths = []
        if len(asked) > 10:
            return None
        for robot, start in enumerate(asked.start.tolist()):
            ways = {start: []}
            queue = [start]
            for vertex in queue:
                for edge, (tail, head) in enumerate(asked.roadmap.edges.tolist()):
                    if tail == vertex and head not in ways and asked.duration(robot)[edge] > 0:
                        ways[head] = [*ways[vertex], edge]
                        queue.append(head)
            edges = ways.get(asked.goals[robot][0][0])
            if edges is None:
                return None
            paths.append(RobotPath(edge=edges, enter=np.arange(len(edges)), leave=np.arange(len(edges)) + 1))
        return Plan(paths=tuple(paths))


def alone(self, asked, budget):
    plan = Bfs.plan(asked)
    return PlanResult(status=PlanStatus.SOLVED if plan else PlanStatus.UNSOLVABLE, plan=plan)


def gives_up(self, asked, budget):
    return PlanResult(status=PlanStatus.GAVE_UP)


def slow(self, asked, budget):
    plan = Bfs.plan(asked)
    if plan is None or len(asked) > 1:
        return PlanResult(status=PlanStatus.GAVE_UP)
    late = RobotPath(
        edge=[-1, *plan.paths[0].edge], enter=[0, *plan.paths[0].enter + 1], leave=[1, *plan.paths[0].leave + 1]
    )
    return PlanResult(status=PlanStatus.SOLVED, plan=Plan(paths=(late,)))


PLANNERS = {
    "finds the way of a robot alone": {"plan": gives_up},
    "plans are valid": {"plan": alone},
    "does not claim that a solvable problem is unsolvable": {
        "plan": lambda self, asked, budget: PlanResult(status=PlanStatus.UNSOLVABLE)
    },
    "is complete": {"plan": gives_up, "promises": frozenset({Promise.COMPLETE})},
    "declares features and promises": {"plan": gives_up, "supports": {"footprints"}},
    "skips features that it does not support": {"plan": gives_up, "skip": lambda self, asked: None},
    "has a problem for every feature it supports": {
        "plan": gives_up,
        "supports": frozenset({Feature.GOAL_SETS}),
        "skip": lambda self, asked: (
            "likes no choice" if Feature.GOAL_SETS in asked.features else Planner.skip(self, asked)
        ),
    },
    "bounds hold": {
        "plan": lambda self, asked, budget: PlanResult(status=PlanStatus.GAVE_UP, lower_bound=1000.0),
    },
    "gives every robot a task of its own": {
        "plan": alone,
        "assigns": True,
        "supports": frozenset({Feature.GOAL_SETS}),
        "promises": frozenset(),
    },
    "is within its bound": {"plan": slow, "promises": frozenset({Promise.BOUNDED}), "suboptimality": 1.0},
}


def test_a_planner_that_does_not_say_its_factor():
    found = failed_checks(suite_for(variant(Still, promises=frozenset({Promise.ROBUST}))()))
    assert found["declares features and promises"].endswith("promises `robust`, so it must override `robustness`")


@pytest.mark.parametrize("check", PLANNERS)
def test_a_planner(check):
    assert check in failed_checks(suite_for(variant(Still, **PLANNERS[check])()))


def test_a_planner_that_leaves_robots_where_they_are():
    assert "ends at vertex 0 instead of its goal" in failed_checks(suite_for(Still()))["plans are valid"]


def test_a_planner_whose_optimum_is_none():
    found = failed_checks(
        suite_for(variant(Still, plan=slow, promises=frozenset({Promise.CONFLICT_FREE, Promise.OPTIMAL}))())
    )
    assert found["is optimal"] == "a robot alone: costs 4, the optimum is 3"
    assert "plans are valid" not in found


def test_a_planner_that_changes_its_mind():
    calls = iter(range(10_000))

    def moody(self, asked, budget):
        return alone(self, asked, budget) if next(calls) % 2 else gives_up(self, asked, budget)

    promises = frozenset({Promise.DETERMINISTIC})
    assert "gives the same plan again" in failed_checks(suite_for(variant(Still, plan=moody, promises=promises)()))


def test_a_planner_that_ignores_its_budget(monkeypatch):
    monkeypatch.setattr("mrpbench_core.testing.planner_call.LATE_S", 0.05)
    monkeypatch.setattr("mrpbench_core.testing.planner_call.HANGS_S", 0.1)
    from threading import Event

    woken = Event()

    def sleeps(self, asked, budget):
        woken.wait(20)
        return PlanResult(status=PlanStatus.GAVE_UP)

    with pytest.raises(Fault, match="still runs"):
        call(variant(Still, plan=sleeps)(), problem("a A"), wall_s=0.05)
    woken.set()


def test_a_planner_that_is_late(monkeypatch):
    monkeypatch.setattr("mrpbench_core.testing.suites.planner.LATE_S", 0.05)

    def late(self, asked, budget):
        until = time.process_time() + budget.wall_s + 0.1
        while time.process_time() < until:
            pass
        return PlanResult(status=PlanStatus.TIMEOUT)

    with pytest.raises(Fault, match=r"after its limit of 0\.2 s in the best of 3 calls"):
        suite_for(variant(Still, plan=late)()).test_keeps_its_deadline()


def test_a_planner_that_raises_is_located():
    def breaks(self, asked, budget):
        raise KeyError("left")

    reason = failed_checks(suite_for(variant(Still, plan=breaks)()))["plans are valid"]
    assert reason.startswith("raises KeyError: 'left' (")
    assert "test_planners.py:" in reason
