"""Planners that assign: against all assignments one by one, against published optima, and against one another."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_planners_mapf.cbs_ta import CbsTa, ItaCbs
from mrpbench_planners_mapf.ecbs_ta import EcbsTa, ItaEcbs
from mrpbench_tests.instances.problems import endless_swap, problem_on
from mrpbench_tests.instances.random_problems import random_graph_problem, random_grid_problem, random_rules
from mrpbench_tests.instances.roadmaps import grid_of
from mrpbench_tests.instances.variations import with_candidates
from mrpbench_tests.oracles.judge import AMPLE, ask, compare_with_optimum

from mrpbench_core.model.planning.plan import Budget, PlanStatus

SLACK_S = 5.0
"""Far more than the planners need; other work may share the machine."""
KINDS = (CbsTa, ItaCbs, EcbsTa, ItaEcbs)
seeds = st.integers(0, 2**32 - 1)
switches = st.booleans()
bounds = st.sampled_from([1.0, 1.02, 1.1, 1.3, 2.0])
techniques = dict.fromkeys(("prioritize", "bypass", "target", "corridor", "rectangle"), switches)
planners = st.one_of(
    st.builds(CbsTa, heuristic=switches, **techniques),
    st.builds(ItaCbs, **techniques),
    st.builds(EcbsTa, w=bounds, **techniques),
    st.builds(ItaEcbs, w=bounds, **techniques),
)


@settings(max_examples=40, deadline=None)
@given(planner=planners, seed=seeds, robots=st.integers(2, 3))
def test_no_assignment_on_grids_is_better(planner, seed, robots):
    random = np.random.default_rng(seed)
    compare_with_optimum(planner, with_candidates(random, random_grid_problem(random, robots, size=4)))


@settings(max_examples=40, deadline=None)
@given(planner=planners, seed=seeds, robots=st.integers(2, 3))
def test_no_assignment_on_graphs_is_better(planner, seed, robots):
    random = np.random.default_rng(seed)
    asked = random_graph_problem(random, robots, ready=random.integers(0, 3, robots), **random_rules(random))
    compare_with_optimum(planner, with_candidates(random, asked))


@settings(max_examples=40, deadline=None)
@given(seed=seeds, w=bounds)
def test_all_agree_on_crowds(seed, w):
    random = np.random.default_rng(seed)
    asked = with_candidates(random, random_grid_problem(random, 6, size=5))
    one, other = ask(CbsTa(), asked), ask(ItaCbs(), asked)
    if one.status is other.status is PlanStatus.SOLVED:
        assert one.plan.sum_of_costs == other.plan.sum_of_costs
        for planner in (EcbsTa(w=w), ItaEcbs(w=w)):
            ask(planner, asked, one.plan.sum_of_costs)


@pytest.mark.parametrize("kind", KINDS)
def test_most_small_instances_are_solved(kind):
    statuses = []
    for seed in range(10):
        random = np.random.default_rng(seed)
        statuses.append(compare_with_optimum(kind(), with_candidates(random, random_grid_problem(random, 3, size=4))))
    assert statuses.count(PlanStatus.SOLVED) > 7


@settings(max_examples=20, deadline=None)
@given(seed=seeds)
def test_with_one_goal_each_they_do_what_cbs_does(seed):
    asked = random_grid_problem(np.random.default_rng(seed), 5, size=5)
    wanted = ask(Cbs(), asked)
    for planner in (CbsTa(), ItaCbs()):
        result = ask(planner, asked)
        if PlanStatus.TIMEOUT not in (wanted.status, result.status):
            assert result.status is wanted.status
            assert wanted.plan is None or result.plan.sum_of_costs == wanted.plan.sum_of_costs


@pytest.mark.parametrize("kind", KINDS)
def test_robots_that_meet_take_one_anothers_goals(kind):
    # In a dead end they could never change places.
    result = kind().plan(problem_on(grid_of(["......"]), [0, 5], [(0, 5), (0, 5)]), AMPLE)
    assert result.status is PlanStatus.SOLVED
    assert result.plan.sum_of_costs == 0


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("goals", "rows"),
    [
        ([(1,), (1,)], ["...."]),  # one goal for two
        ([(0, 1), (0, 1), (0, 1)], ["...."]),  # two goals for three
        ([(2, 3), (2, 3)], ["..#.."]),  # no way
        ([(0, 3), (0, 3)], ["..#.."]),  # a way to one only
    ],
)
def test_without_goals_for_all_there_is_no_solution(kind, goals, rows):
    result = kind().plan(problem_on(grid_of(rows), list(range(len(goals))), goals), AMPLE)
    assert result.status is PlanStatus.UNSOLVABLE


@pytest.mark.parametrize("kind", KINDS)
def test_goals_too_near_one_another_are_not_taken_together(kind):
    # Robots of half a cell and more exclude one another on neighbouring cells.
    road = grid_of(["......."])
    asked = problem_on(road, [1, 5], [(2, 3), (3, 4)], radius=0.6)
    assert ask(kind(), asked, 2, AMPLE).status is PlanStatus.SOLVED
    unsolvable = problem_on(road, [1, 5], [(3,), (4, 3)], radius=0.6)
    assert kind().plan(unsolvable, AMPLE).status is PlanStatus.UNSOLVABLE


@pytest.mark.parametrize("kind", KINDS)
def test_the_same_input_gives_the_same_output(kind):
    random = np.random.default_rng(5)
    asked = with_candidates(random, random_grid_problem(random, 8, size=7))
    one, other = kind().plan(asked, AMPLE), kind().plan(asked, AMPLE)
    assert one.status is PlanStatus.SOLVED
    assert one.plan == other.plan
    assert one.statistics == other.statistics


@pytest.mark.parametrize("kind", KINDS)
def test_limits_hold_where_the_search_never_ends(kind):
    asked = endless_swap(6)
    late = kind().plan(asked, Budget(wall_s=0.1, memory_bytes=1 << 30))
    assert late.status is PlanStatus.TIMEOUT
    assert late.lower_bound >= 20
    planner = CbsTa(heuristic=False) if kind is CbsTa else kind()  # with it few nodes are made
    assert planner.plan(asked, Budget(wall_s=20, memory_bytes=1 << 21)).status is PlanStatus.OUT_OF_MEMORY


def test_they_always_assign():
    assert all(kind().assigns for kind in KINDS)
