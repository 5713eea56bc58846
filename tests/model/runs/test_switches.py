"""Orders that were executed the other way round than planned."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.model.planning.plan import Plan, RobotPath
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.runs.plans import RecordedPlan
from mrpbench_core.model.runs.switches import Switch, switches

TIME = np.arange(8.0)


@pytest.fixture(scope="module")
def crossing():
    """Robots 0 and 1 cross vertices 1 and 2 one after the other, robot 0 first: 0-1-2-3 and 4-1-2-5."""
    roadmap = Roadmap(
        position=[[0, 0], [1, 0], [2, 0], [3, 0], [0, 1], [3, 1]],
        level=[0] * 6,
        heading=[np.nan] * 6,
        edges=[[0, 1], [1, 2], [2, 3], [4, 1], [2, 5]],
        duration=[[1] * 5],
        tick=1.0,
    )
    goals = (((3,),), ((5,),))
    problem = Problem(roadmap=roadmap, profile=[0, 0], radius=[0.2, 0.2], start=[0, 4], ready=[0, 0], goals=goals)
    first = RobotPath(edge=[0, 1, 2], enter=[0, 1, 2], leave=[1, 2, 3])
    second = RobotPath(edge=[-1, 3, 1, 4], enter=[0, 2, 3, 4], leave=[2, 3, 4, 5])
    return problem, [RecordedPlan(time=0.0, routes=(), plan=Plan(paths=(first, second)))]


def reached(first, second):
    return np.array([first, second]).T


def test_an_order_that_is_kept_is_no_switch(crossing):
    assert switches(*crossing, TIME, reached([0, 0, 1, 2, 3, 3, 3, 3], [0, 1, 1, 1, 2, 3, 4, 4])) == []


def test_places_one_after_another_are_one_switch(crossing):
    found = switches(*crossing, TIME, reached([0, 0, 0, 0, 0, 1, 2, 3], [1, 2, 3, 4, 4, 4, 4, 4]))
    assert found == [Switch(time=1.0, robot=1, other=0)]


def test_a_robot_that_never_comes_is_passed(crossing):
    assert len(switches(*crossing, TIME, reached([0] * 8, [1, 2, 3, 4, 4, 4, 4, 4]))) == 1


@given(st.permutations("aaabbb"))
def test_robots_that_visit_all_places_in_the_other_order_have_switched(crossing, order):
    """Compared with the visits themselves; robot 1 passes no place alone that robot 0 does not visit as well."""
    steps = np.array([[step == "a", step == "b"] for step in order]).cumsum(axis=0)
    counts = np.vstack([[0, 0], steps]) + [0, 1]
    counts[0, 1] = 0
    visits = [[int(np.argmax(counts[:, robot] >= need)) for robot, need in ((0, k), (1, k + 1))] for k in (1, 2)]
    found = switches(*crossing, TIME[:7], counts)
    passed = [late > early for late, early in visits]
    assert len(found) == sum(now and not before for before, now in zip([False, *passed], passed, strict=False))
