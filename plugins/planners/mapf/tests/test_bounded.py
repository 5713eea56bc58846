"""Bounded-suboptimal conflict-based search: valid plans within their bounds, against oracles and published optima.

`soak_planners.py` does the same on thousands of instances.
"""

import csv

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_planners_mapf.bounded import Ecbs, Eecbs
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_tests.instances.problems import movingai, problem_on
from mrpbench_tests.instances.random_problems import random_graph_problem, random_grid_problem, random_rules
from mrpbench_tests.instances.roadmaps import grid_of
from mrpbench_tests.instances.variations import with_plan_released
from mrpbench_tests.oracles.judge import AMPLE, ask, compare_with_optimum

from mrpbench_core.model.planning.plan import PlanStatus

seeds = st.integers(0, 2**32 - 1)
bounds = st.sampled_from([1.0, 1.01, 1.05, 1.1, 1.2, 1.5, 2.0, 3.0, 5.0])
switches = st.booleans()
planners = st.one_of(
    st.builds(Ecbs, w=bounds),
    st.builds(
        Eecbs,
        w=bounds,
        prioritize=switches,
        bypass=switches,
        heuristic=switches,
        target=switches,
        corridor=switches,
        rectangle=switches,
        flex=switches,
        incumbent_after=st.sampled_from([None, 0, 500]),
        distance_weight=st.sampled_from([1.0, 1.2, 3.0]),
        conflict_weight=st.sampled_from([0.0, 2.0, 20.0]),
    ),
)


@settings(max_examples=60, deadline=None)
@given(planner=planners, seed=seeds, robots=st.integers(2, 4), size=st.integers(3, 4))
def test_bounds_hold_on_grids(planner, seed, robots, size):
    compare_with_optimum(planner, random_grid_problem(np.random.default_rng(seed), robots, size=size))


@settings(max_examples=50, deadline=None)
@given(planner=planners, seed=seeds, robots=st.integers(2, 3))
def test_bounds_hold_on_graphs_with_durations_profiles_goal_sets_and_footprints(planner, seed, robots):
    random = np.random.default_rng(seed)
    ready = random.integers(0, 3, robots)
    compare_with_optimum(planner, random_graph_problem(random, robots, ready=ready, **random_rules(random)))


@settings(max_examples=40, deadline=None)
@given(planner=planners, seed=seeds, robots=st.integers(2, 3))
def test_bounds_hold_on_graphs_of_unit_moves_with_one_way_lanes(planner, seed, robots):
    random = np.random.default_rng(seed)
    asked = random_graph_problem(random, robots, longest=1)
    goals = [int(goal) for goal in random.choice(len(asked.roadmap.position), robots, replace=False)]
    compare_with_optimum(planner, problem_on(asked.roadmap, asked.start, goals))


@settings(max_examples=15, deadline=None)
@given(planner=planners, seed=seeds)
def test_crowds_get_valid_plans_within_the_bound(planner, seed):
    asked = random_grid_problem(np.random.default_rng(seed), 20, size=9)
    ask(planner, asked)


@settings(max_examples=20, deadline=None)
@given(planner=planners, seed=seeds)
def test_plans_begin_with_what_was_released(planner, seed):
    random = np.random.default_rng(seed)
    before = random_graph_problem(random, 3, **random_rules(random))
    first = ask(planner, before)
    if first.plan is not None:
        ask(planner, with_plan_released(random, before, first.plan))


@pytest.mark.parametrize("planner", [Ecbs(w=1.0), Eecbs(w=1.0)])
def test_a_bound_of_one_is_optimal(planner):
    statuses = [
        compare_with_optimum(planner, random_grid_problem(np.random.default_rng(seed), 3, size=4)) for seed in range(20)
    ]
    assert statuses.count(PlanStatus.SOLVED) > 5


@pytest.mark.parametrize("corridor", [True, False])
def test_robots_that_meet_in_a_corridor_let_each_other_out(corridor):
    # Two robots meet head-on in a corridor of eight cells with a bay at each end.
    road = grid_of(["#.########.#", "............"])
    asked = problem_on(road, [2, 13], [13, 2])
    result = ask(Eecbs(w=1.0, corridor=corridor), asked, budget=AMPLE)
    assert result.status is PlanStatus.SOLVED
    assert result.plan.sum_of_costs == result.lower_bound
    if corridor:
        assert result.statistics["expansions"] < 10


def test_a_robot_that_has_arrived_makes_way():
    # Robot 0 arrives at once in the corridor through which robot 1 has to pass; the bay is beside its goal.
    asked = problem_on(grid_of(["##.##", "....."]), [2, 1], [3, 5])
    assert compare_with_optimum(Eecbs(w=1.5), asked) is PlanStatus.SOLVED


@pytest.mark.parametrize("seed", [1, 2, 4])
@pytest.mark.parametrize("planner", [Cbs(), Eecbs()])
def test_the_later_robot_waits_until_the_earlier_one_has_left_a_junction_of_long_lanes(planner, seed):
    # Split lane by lane, the same conflicts take 12 to 360 expansions, and cbs at least 30.
    random = np.random.default_rng(seed)
    road = grid_of(["...", "...", "..."])
    starts, goals = random.choice(9, 4, replace=False), random.choice(9, 4, replace=False).tolist()
    result = planner.plan(problem_on(attrs.evolve(road, duration=20 * road.duration), starts, goals, radius=0.2), AMPLE)
    assert result.status is PlanStatus.SOLVED
    assert result.statistics["expansions"] <= 20


@pytest.mark.parametrize("planner", [Ecbs(), Eecbs(), Eecbs(w=1.05, flex=True)])
def test_the_same_input_gives_the_same_output(planner):
    asked = random_grid_problem(np.random.default_rng(5), 12, size=7)
    one, other = planner.plan(asked, AMPLE), planner.plan(asked, AMPLE)
    assert one.status is PlanStatus.SOLVED
    assert one.plan == other.plan
    assert one.statistics == other.statistics


@pytest.mark.parametrize("w", [0.99, float("inf"), float("nan")])
def test_bounds_that_make_no_sense_are_refused(w):
    with pytest.raises(ValueError, match="w"):
        Eecbs(w=w)


@pytest.mark.parametrize("planner", [Ecbs(w=1.2), Eecbs(w=1.05)])
def test_published_optima_lie_within_the_bounds(shared_data, planner):
    with (shared_data / "mapf_optimal.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if int(row["agents"]) <= 30][::14]
    solved = 0
    for row in rows:
        asked = movingai(shared_data, row["map"], row["scen"], int(row["agents"]))
        solved += ask(planner, asked, int(row["soc"])).status is PlanStatus.SOLVED
    assert solved > len(rows) / 2
