"""LaCAM and PIBT where moves take several ticks and robots have footprints or use resources."""

import attrs
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from mrpbench_planners_mapf.bounded import Eecbs
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_planners_mapf.lacam import Lacam
from mrpbench_planners_mapf.lns import Lns
from mrpbench_planners_mapf.pibt import Pibt
from mrpbench_tests.instances.problems import endless_swap, problem_on
from mrpbench_tests.instances.random_problems import random_building_problem, random_corridor_problem
from mrpbench_tests.instances.roadmaps import grid_of, roadmap, two_way
from mrpbench_tests.instances.variations import with_releases
from mrpbench_tests.oracles.judge import ask, compare_with_optimum

from mrpbench_core.model.planning.plan import Budget, PlanStatus
from mrpbench_core.model.planning.roadmap import Resource

BUDGET = Budget(wall_s=100, memory_bytes=1 << 30, iterations=20)
seeds = st.integers(0, 2**32 - 1)


@settings(max_examples=20, deadline=None)
@given(
    seed=seeds, planner=st.sampled_from([Lacam(), Lacam(swap=False, neighbourhoods=False), Pibt(), Pibt(swap=False)])
)
def test_plans_in_corridors_of_slow_lanes_are_valid_and_none_is_missed(seed, planner):
    random = np.random.default_rng(seed)
    following = str(random.choice(["allowed", "forbidden"]))
    asked = random_corridor_problem(random, int(random.integers(2, 4)), 3, radius=0.3, following=following)
    compare_with_optimum(planner, asked, most_states=500)


@pytest.mark.parametrize("capacity", [1, 2])
def test_lacam_solves_buildings_and_all_plans_keep_to_doors(capacity):
    for seed in range(10):
        asked = random_building_problem(np.random.default_rng(seed), 3 + seed % 6, capacity)
        result = ask(Lacam(), asked, budget=BUDGET)
        assert result.status is PlanStatus.SOLVED
        assert Lacam().plan(asked, BUDGET).plan == result.plan
        for planner in (Pibt(), Lns(), Lns(initial="repair")):
            ask(planner, asked, budget=BUDGET)


@pytest.mark.parametrize("planner", [Lacam(), Lns(), Pibt()])
def test_no_plan_in_a_building_costs_less_than_the_optimum(planner):
    for seed in range(6):
        asked = random_building_problem(np.random.default_rng(seed), 4)
        best = Cbs().plan(asked, BUDGET).plan
        ask(planner, asked, None if best is None else best.sum_of_costs, BUDGET)


def test_a_swap_on_a_slow_path_has_no_plan_and_with_a_bay_it_has_one():
    path = endless_swap(5)
    asked = problem_on(path.roadmap, [0, 4], [4, 0], radius=0.3)
    assert Lacam().plan(asked, BUDGET).status is PlanStatus.UNSOLVABLE
    bay = two_way(
        [(0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (2, 1)], [(0, 1), (1, 2), (2, 3), (3, 4), (2, 5)], [7, 3, 5, 2, 4]
    )
    for planner in (Lacam(), Pibt()):
        assert ask(planner, problem_on(bay, [0, 4], [4, 0], radius=0.3), budget=BUDGET).status is PlanStatus.SOLVED


def test_robots_rotate_on_a_cycle_where_a_mutex_elsewhere_forbids_unit_steps():
    ring = grid_of(["..", ".."])
    asked = problem_on(
        attrs.evolve(ring, resources=(Resource(name="a", kind="mutex", edges=(0,)),)), range(4), [1, 3, 0, 2]
    )
    assert ask(Lacam(), asked, budget=BUDGET).plan.sum_of_costs == 4


@settings(max_examples=40, deadline=None)
@given(seed=seeds)
@example(seed=1073)  # a robot stands where another one is committed to go
def test_pibt_goes_on_from_released_segments(seed):
    random = np.random.default_rng(seed)
    asked = with_releases(random, random_corridor_problem(random, 3, 3, radius=0.3))
    ask(Pibt(), asked, budget=BUDGET)
    ask(Lns(), asked, budget=BUDGET)


def test_problems_in_which_lacam_could_miss_plans_are_skipped_with_the_reason():
    slow = endless_swap(3)
    assert Lacam().skip(slow) == "supports edges of several ticks only for robots with footprints"
    assert Pibt().skip(slow) is None
    road = grid_of(["..."])
    mutex = Resource(name="middle", kind="mutex", vertices=(1,))
    through = problem_on(attrs.evolve(road, resources=(mutex,)), [0], [2])
    assert "'middle'" in Lacam().skip(through)
    assert Pibt().skip(through) is None
    double = roadmap([(0, 0), (1, 0)], [(0, 1), (0, 1)], [2, 3])
    assert "several edges" in Lacam().skip(problem_on(double, [0], [1], radius=0.3))


@pytest.mark.parametrize("planner", [Lacam(), Pibt()])
def test_robots_that_disappear_or_choose_goals_are_skipped_with_the_reason(planner):
    road = grid_of(["..."])
    assert planner.skip(problem_on(road, [0], [2])) is None
    assert "disappear" in planner.skip(problem_on(road, [0], [2], at_goal="disappear"))
    assert "goal_sets" in planner.skip(problem_on(road, [0], [(1, 2)]))


def test_eecbs_has_a_plan_in_a_building_long_before_its_tree_has_one():
    asked = random_building_problem(np.random.default_rng([9, 2]), 9, junctions=16)
    result = ask(Eecbs(w=1.2), asked, budget=BUDGET)
    assert result.status is PlanStatus.SOLVED
    assert result.statistics["expansions"] < 600  # alone, it needs more than 1,200
