"""Prioritised planning: valid plans, never cheaper than optimal, and honest when it fails."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_planners_mapf.prioritized import Prioritized
from mrpbench_tests.instances.problems import problem_on
from mrpbench_tests.instances.random_problems import random_graph_problem, random_grid_problem, random_rules
from mrpbench_tests.instances.roadmaps import grid_of
from mrpbench_tests.instances.variations import with_plan_released
from mrpbench_tests.oracles.judge import AMPLE, BUDGET, ask

from mrpbench_core.model.planning.plan import PlanStatus

seeds = st.integers(0, 2**32 - 1)
orders = st.sampled_from(["index", "longest_first", "shortest_first", "random"])


@settings(max_examples=150, deadline=None)
@given(seed=seeds, robots=st.integers(2, 4), order=orders)
def test_plans_on_graphs_are_valid_and_not_better_than_optimal(seed, robots, order):
    random = np.random.default_rng(seed)
    asked = random_graph_problem(random, robots, ready=random.integers(0, 3, robots), **random_rules(random))
    result = ask(Prioritized(order=order, seed=seed % 7), asked)
    best = ask(Cbs(), asked)
    if result.status is PlanStatus.SOLVED:
        assert result.lower_bound <= best.lower_bound <= result.plan.sum_of_costs
    elif result.status is PlanStatus.UNSOLVABLE:
        assert best.status in {PlanStatus.UNSOLVABLE, PlanStatus.TIMEOUT}
    else:
        assert result.status is PlanStatus.GAVE_UP
        assert 0 <= result.statistics["failed_robot"] < robots


@pytest.mark.parametrize("radius", [None, 0.4])
def test_crowds_are_planned_without_conflict(radius):
    random = np.random.default_rng(11)
    solved = 0
    for _ in range(10):
        asked = random_grid_problem(random, 12, size=9, radius=radius)
        solved += ask(Prioritized(), asked, budget=AMPLE).status is PlanStatus.SOLVED
    assert solved >= 5


@settings(max_examples=60, deadline=None)
@given(seed=seeds)
def test_plans_begin_with_what_was_released(seed):
    random = np.random.default_rng(seed)
    before = random_graph_problem(random, 3, **random_rules(random))
    first = ask(Prioritized(), before)
    if first.plan is not None:
        ask(Prioritized(), with_plan_released(random, before, first.plan))


def test_a_robot_that_blocks_another_plans_after_it():
    # Robot 0 would park at once in the corridor that robot 1 has to take; in the bay it can wait.
    road = grid_of(["####", "....", "#.##"])
    asked = problem_on(road, [1, 0], [2, 3])
    assert Prioritized(order="index", restarts=0).plan(asked, BUDGET).status is PlanStatus.GAVE_UP
    assert Prioritized(order="index", restarts=1).plan(asked, BUDGET).status is PlanStatus.SOLVED


def test_robots_that_park_in_one_anothers_way_start_late_by_chance_and_are_hurried_afterwards():
    # Robot 0 has to be past 1 before robot 1 parks there, and robot 1 past 2 before robot 0 parks there.
    road = grid_of(["#.#", "...", "#.#", "#.#"])  # 0; 1 2 3; 4; 5
    asked = problem_on(road, [5, 1], [2, 4])
    assert Prioritized(restarts=100).plan(asked, BUDGET).status is PlanStatus.GAVE_UP
    result = ask(Prioritized(), asked)
    assert 8 == Cbs().plan(asked, BUDGET).plan.sum_of_costs <= result.plan.sum_of_costs <= 10


def test_seeds_change_random_orders_and_repeat_themselves():
    asked = random_grid_problem(np.random.default_rng(3), 10, size=5)
    plans = [Prioritized(order="random", seed=seed).plan(asked, BUDGET).plan for seed in range(8)]
    assert plans == [Prioritized(order="random", seed=seed).plan(asked, BUDGET).plan for seed in range(8)]
    assert len({plan.sum_of_costs for plan in plans if plan}) > 1
