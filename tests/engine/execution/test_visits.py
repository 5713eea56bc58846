from itertools import pairwise

import attrs
import numpy as np
from mrpbench_tests.instances.problems import problem_on
from mrpbench_tests.instances.roadmaps import grid_of

from mrpbench_core.engine.execution.visits import Visits
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.testing.drawing import unit_path

ROADMAP = grid_of(["....."])
LEVELS = np.zeros(2, np.int16)
GOALS = (((1,), (3, 4), (0,)), ((2,),))
THERE_AND_BACK = (0, 1, 2, 3, 2, 1, 0)


def asked(goals, start=0):
    return attrs.evolve(problem_on(ROADMAP, [start, 2], [0, 2]), goals=goals)


def plan(*vertices):
    ends = ROADMAP.edges.tolist()
    edges = [ends.index(list(step)) for step in pairwise(vertices)]
    return Plan(paths=(unit_path(edges), unit_path([])))


def update(visits, column, reached, level=0):
    visits.update(np.array([[column, 0.0], [2.0, 0.0]]), LEVELS + level, np.array([reached, 0], np.int32))
    return int(visits.count[0])


def test_goals_count_in_order_where_the_robot_truly_is_and_reports_them():
    visits = Visits(asked(GOALS), plan(*THERE_AND_BACK), 0.25)
    assert visits.complete.tolist() == [False, True]
    assert update(visits, 0.9, 0) == 0, "the segment is not reported"
    assert update(visits, 0.5, 1) == 0, "the robot is elsewhere"
    assert update(visits, 0.9, 1, level=1) == 0, "it is on another level"
    assert visits.contradiction() == "robot 0 did not come within 0.25 m of goal 0 of its sequence"
    assert update(visits, 0.9, 1) == 1
    assert update(visits, 4.0, 2) == 1, "this plan visits the other goal of the set"
    assert update(visits, 3.1, 3) == 2
    assert visits.complete.all()
    assert visits.remaining == (((0,),), ((2,),))
    assert visits.contradiction() is None


def test_a_plan_to_what_is_left_goes_on_counting():
    visits = Visits(asked(GOALS), plan(*THERE_AND_BACK), 0.25)
    update(visits, 1.0, 1)
    visits.follow(asked(visits.remaining, start=2), plan(2, 3, 2, 1, 0))
    assert update(visits, 3.0, 1) == 2


def test_a_plan_that_leads_elsewhere_visits_no_goal():
    visits = Visits(asked(GOALS), plan(*THERE_AND_BACK), 0.25)
    visits.follow(asked((((1,),), ((2,),))), plan(0, 1))
    assert update(visits, 1.0, 1) == 0


def test_other_goals_begin_with_what_is_done_already():
    visits = Visits(asked(GOALS), plan(*THERE_AND_BACK), 0.25)
    goals = (((1,), (2,), (3,)), ((2,),))
    visits.lead_to(goals, np.array([1, 0]))
    visits.follow(asked(goals), plan(0, 1, 2, 3))
    assert update(visits, 2.0, 2) == 2
    assert visits.complete.all()
