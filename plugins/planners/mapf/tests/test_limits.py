"""Common to all native planners: limits, quick proofs of infeasibility, refusals."""

import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_planners_mapf.astar import Astar
from mrpbench_planners_mapf.bounded import Ecbs, Eecbs
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_planners_mapf.lacam import Lacam
from mrpbench_planners_mapf.lns import Lns
from mrpbench_planners_mapf.pbs import Pbs
from mrpbench_planners_mapf.pibt import Pibt
from mrpbench_planners_mapf.prioritized import Prioritized
from mrpbench_tests.instances.problems import endless_swap, movingai, problem_on
from mrpbench_tests.instances.random_problems import random_grid_problem
from mrpbench_tests.instances.roadmaps import grid_of, roadmap
from mrpbench_tests.oracles.judge import answer_faults
from mrpbench_tests.oracles.optimum import least_sum_of_costs

from mrpbench_core.model.planning.plan import Budget, PlanStatus

PLANNERS = [Astar(), Prioritized(), Cbs()]
COOPERATIVE = PLANNERS[1:]
BUDGET = Budget(wall_s=5, memory_bytes=1 << 30)
SLACK_S = 5.0
"""Far more than the planners need; other work may share the machine."""


def timed(planner, asked, budget):
    start = time.monotonic()
    result = planner.plan(asked, budget)
    return result, time.monotonic() - start


def test_a_swap_that_nothing_rules_out_ends_at_the_deadline_with_a_bound():
    result, seconds = timed(Cbs(), endless_swap(4), Budget(wall_s=0.3, memory_bytes=1 << 30))
    assert result.status is PlanStatus.TIMEOUT
    assert 0.25 < seconds < 0.3 + SLACK_S
    assert result.lower_bound > 12
    assert result.plan is None


@pytest.mark.parametrize("planner", [*COOPERATIVE, Ecbs(), Eecbs(), Lacam(), Lns(), Pbs(), Pibt()])
@pytest.mark.parametrize(
    ("rows", "starts", "goals"),
    [
        (["." * 200], [0, 199], [199, 0]),  # no room to pass
        (["..", ".."], [0, 1, 2], [1, 0, 2]),  # round and round, always in the same order
        (["..#", "...", "#.#"], [0, 1, 2, 3, 4, 5], [0, 1, 2, 3, 5, 4]),  # no room to move apart from turning
        (["." * 100, "#" * 49 + "." + "#" * 50], range(99), [1, 0, *range(2, 99)]),  # too far from where they could
    ],
)
def test_robots_that_can_never_pass_one_another_are_unsolvable(planner, rows, starts, goals):
    asked = problem_on(grid_of(rows), starts, goals)
    result = planner.plan(asked, Budget(wall_s=60, memory_bytes=1 << 30))
    assert result.status is PlanStatus.UNSOLVABLE


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), planner=st.sampled_from([Prioritized(), Pbs(), Lns(), Cbs()]))
def test_problems_reported_as_unsolvable_without_following_have_no_plan(seed, planner):
    random = np.random.default_rng(seed)
    rows = ["".join("#" if random.random() < 0.2 else "." for _ in range(3)) for _ in range(2)]
    road = grid_of(rows)
    vertices = len(road.position)
    robots = vertices - int(random.integers(0, 3))
    if robots < 1:
        return
    starts, goals = random.permutation(vertices)[:robots], random.permutation(vertices)[:robots]
    asked = problem_on(road, starts, goals.tolist(), following="forbidden")
    optimum = least_sum_of_costs(asked)
    budget = Budget(wall_s=0.2, memory_bytes=1 << 30, iterations=20)
    assert not answer_faults(asked, planner, planner.plan(asked, budget), optimum)


@pytest.mark.parametrize("planner", [Prioritized(), Pbs(), Cbs()])
def test_a_sliding_puzzle_of_the_wrong_parity_is_unsolvable(planner):
    goals = [1, 0, *range(2, 99)]
    asked = problem_on(grid_of(["." * 10] * 10), range(99), goals, following="forbidden")
    assert planner.plan(asked, Budget(wall_s=60, memory_bytes=1 << 30)).status is PlanStatus.UNSOLVABLE


@pytest.mark.parametrize("planner", PLANNERS)
def test_no_time_at_all_is_a_timeout(planner):
    asked = random_grid_problem(np.random.default_rng(1), 30, size=60)
    result, seconds = timed(planner, asked, Budget(wall_s=0.0, memory_bytes=1 << 30))
    assert result.status is PlanStatus.TIMEOUT
    assert seconds < SLACK_S


def test_a_large_crowd_stops_in_time(shared_data):
    asked = movingai(shared_data, "den520d", "random-1", 200)
    result, seconds = timed(Cbs(), asked, Budget(wall_s=0.2, memory_bytes=1 << 30))
    assert result.status is PlanStatus.TIMEOUT
    assert seconds < 0.2 + SLACK_S


def test_memory_is_counted():
    plain = Cbs(heuristic=False, target=False, corridor=False)
    assert plain.plan(endless_swap(4), Budget(wall_s=60, memory_bytes=4 << 20)).status is PlanStatus.OUT_OF_MEMORY


@pytest.mark.parametrize("planner", PLANNERS)
def test_a_goal_out_of_reach_is_unsolvable(planner):
    result, seconds = timed(planner, problem_on(grid_of([".#."]), [0], [1]), BUDGET)
    assert result.status is PlanStatus.UNSOLVABLE
    assert result.statistics["failed_robot"] == 0
    assert seconds < SLACK_S


@pytest.mark.parametrize("planner", COOPERATIVE)
@pytest.mark.parametrize(
    ("starts", "goals", "radius"),
    [
        ([0, 2], [1, 1], None),  # one goal for two that stay
        ([0, 0], [1, 2], None),  # one start
        ([0, 1], [3, 2], 0.6),  # starts too near for the footprints
        ([0, 3], [1, 2], 0.6),  # goals too near
        ([0, 1, 2], [(3, 4), (4, 3), (3, 4)], None),  # two goals for three
    ],
)
def test_robots_that_exclude_one_another_are_unsolvable(planner, starts, goals, radius):
    result, seconds = timed(planner, problem_on(grid_of(["....."]), starts, goals, radius=radius), BUDGET)
    assert result.status is PlanStatus.UNSOLVABLE
    assert seconds < SLACK_S


@pytest.mark.parametrize("planner", PLANNERS)
def test_no_robots_have_an_empty_plan(planner):
    result = planner.plan(problem_on(grid_of(["."]), [], []), BUDGET)
    assert result.status is PlanStatus.SOLVED
    assert len(result.plan.paths) == 0


@pytest.mark.parametrize("planner", PLANNERS)
def test_a_robot_at_its_goal_needs_no_path(planner):
    result = planner.plan(problem_on(grid_of(["."]), [0], [0]), BUDGET)
    assert len(result.plan.paths[0]) == 0
    assert result.lower_bound == 0


@pytest.mark.parametrize("planner", PLANNERS)
def test_what_is_not_supported_is_named(planner):
    asked = problem_on(grid_of([".."]), [0], [1], since=[1])
    assert planner.skip(asked) == "does not support since"
    assert planner.skip(problem_on(grid_of([".."]), [0], [1], radius=0.1, following="forbidden")) is None


@pytest.mark.parametrize(
    ("edges", "duration", "start", "fault"),
    [
        ([(0, 2)], [1], 0, "edge 0 leads from or to a vertex that does not exist"),
        ([(0, 1)], [0], 0, "edge 0 takes 0 ticks"),
        ([(0, 1)], [1], 2, "robot 0: starts at a vertex that does not exist"),
    ],
)
def test_data_that_make_no_sense_are_refused(edges, duration, start, fault):
    with pytest.raises(ValueError, match=fault):
        Cbs().plan(problem_on(roadmap([(0, 0), (1, 0)], edges, duration), [start], [1]), BUDGET)
