"""Planners of robots that visit goals in order: valid plans, and what one robot costs as brute force finds it."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_planners_mapf.pbs import Pbs
from mrpbench_planners_mapf.prioritized import Prioritized
from mrpbench_tests.instances.variations import with_plan_released
from mrpbench_tests.oracles.judge import AMPLE, ask, compare_with_optimum
from mrpbench_tests.oracles.optimum import least_sum_of_costs

from mrpbench_core.model.planning.plan import PlanStatus
from mrpbench_core.model.planning.problem import Feature, features_of
from mrpbench_core.testing.drawing import problem
from mrpbench_core.testing.strategies import problems, roadmaps

DRAWN = problems(
    roadmaps(3, 4),
    most_robots=2,
    features=frozenset({Feature.GOAL_SEQUENCES, Feature.GOAL_SETS, Feature.FOOTPRINTS, Feature.FOLLOWING_FORBIDDEN}),
)
planners = st.sampled_from([Prioritized(), Pbs()])


@settings(max_examples=100, deadline=None)
@given(asked=DRAWN, planner=planners)
def test_plans_visit_all_goals_in_order_and_are_not_cheaper_than_the_optimum(asked, planner):
    compare_with_optimum(planner, asked)


@settings(max_examples=60, deadline=None)
@given(asked=DRAWN.filter(lambda drawn: len(drawn) == 1 and len(drawn.goals[0]) > 1), planner=planners)
def test_a_robot_alone_takes_the_shortest_way_over_its_goals(asked, planner):
    optimum = least_sum_of_costs(asked)
    result = ask(planner, asked, optimum)
    assert result.status is (PlanStatus.UNSOLVABLE if np.isinf(optimum) else PlanStatus.SOLVED)
    assert result.plan is None or result.plan.sum_of_costs == result.lower_bound == optimum


@settings(max_examples=60, deadline=None)
@given(asked=DRAWN, planner=planners, seed=st.integers(0, 2**32 - 1))
def test_goals_that_were_visited_on_the_released_way_are_not_visited_again(asked, planner, seed):
    first = ask(planner, asked)
    if first.plan is None:
        return
    released = with_plan_released(np.random.default_rng(seed), asked, first.plan)
    again = ask(planner, released, budget=AMPLE)
    assert again.plan is None or len(asked) > 1 or again.plan.sum_of_costs == first.plan.sum_of_costs


@pytest.mark.parametrize("planner", [Prioritized(), Pbs()])
def test_within_a_window_robots_go_on_from_goal_to_goal(planner):
    drawn = problem("a . . . b\n . . . . .")
    goals = (((2,), (0,)), ((2,), (4,)))
    asked = attrs.evolve(drawn, goals=goals, horizon=3)
    asked = attrs.evolve(asked, features=features_of(asked))
    result = ask(planner, asked, budget=AMPLE)
    moves = [int((path.edge >= 0).sum()) for path in result.plan.paths]
    assert max(moves) == 3  # one has been at the middle after two moves, and is on its way back


@pytest.mark.parametrize("planner", [Prioritized(), Pbs()])
def test_a_robot_without_goals_ends_anywhere(planner):
    drawn = problem(". . .\n a b A")
    asked = attrs.evolve(drawn, goals=(drawn.goals[0], ()))
    result = ask(planner, attrs.evolve(asked, features=features_of(asked)), budget=AMPLE)
    assert result.status is PlanStatus.SOLVED
