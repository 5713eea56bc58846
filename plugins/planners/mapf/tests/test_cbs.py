"""Conflict-based search against an oracle that searches the joint space, and against published optima."""

import csv
import math

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mapf_instances import grid, movingai, problem, random_graph_problem, random_grid_problem, random_rules
from mapf_oracle import TooLargeError, least_cost
from mrpbench_planners_mapf.cbs import Cbs

from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.plan import Budget, Path, PlanStatus
from mrpbench_core.model.problem import features_of

BUDGET = Budget(wall_s=0.2, memory_bytes=1 << 30)
EVERYTHING = Cbs()
TECHNIQUES = tuple(attrs.fields_dict(Cbs))
ABLATIONS = [
    Cbs(**dict.fromkeys(TECHNIQUES, False)),
    *(Cbs(**{technique: False}) for technique in TECHNIQUES),
    *(Cbs(**{other: other == technique for other in TECHNIQUES}) for technique in TECHNIQUES),
]
seeds = st.integers(0, 2**32 - 1)


def solve_and_compare(given_problem, planner: Cbs = EVERYTHING) -> PlanStatus:
    """Solve, validate the plan and compare its cost with the optimum."""
    result = planner.plan(given_problem, BUDGET)
    if result.status is PlanStatus.SOLVED:
        report = check_plan(given_problem, result.plan)
        assert report.valid, (report.faults, report.conflicts)
        assert result.lower_bound == result.plan.sum_of_costs
    try:
        optimum = least_cost(given_problem)
    except TooLargeError:
        return result.status
    if result.status is PlanStatus.SOLVED:
        assert result.plan.sum_of_costs == optimum
    elif result.status is PlanStatus.UNSOLVABLE:
        assert optimum == math.inf
    else:
        assert result.status is PlanStatus.TIMEOUT
        assert result.lower_bound <= optimum
    return result.status


def mostly_solved(statuses: list[PlanStatus]) -> bool:
    return statuses.count(PlanStatus.SOLVED) > len(statuses) / 2


@pytest.mark.parametrize("robots", [2, 3])
@pytest.mark.parametrize("rules", [{}, {"following": "forbidden"}, {"at_goal": "disappear"}, {"radius": 0.3}])
def test_plans_on_grids_are_optimal(robots, rules):
    random = np.random.default_rng([robots, len(rules), len(str(rules))])
    assert mostly_solved([solve_and_compare(random_grid_problem(random, robots, **rules)) for _ in range(8)])


@settings(max_examples=50, deadline=None)
@given(seed=seeds, robots=st.integers(2, 3))
def test_plans_on_graphs_with_durations_profiles_and_goal_sets_are_optimal(seed, robots):
    random = np.random.default_rng(seed)
    solve_and_compare(random_graph_problem(random, robots, **random_rules(random)))


@settings(max_examples=25, deadline=None)
@given(seed=seeds, planner=st.sampled_from(ABLATIONS))
def test_every_choice_of_techniques_is_optimal(seed, planner):
    random = np.random.default_rng(seed)
    solve_and_compare(random_grid_problem(random, int(random.integers(2, 5)), size=int(random.integers(3, 5))), planner)
    solve_and_compare(random_graph_problem(random, int(random.integers(2, 4)), **random_rules(random)), planner)


@settings(max_examples=30, deadline=None)
@given(seed=seeds)
def test_robots_stand_until_they_are_ready(seed):
    random = np.random.default_rng(seed)
    ready = random.integers(0, 5, 2)
    solve_and_compare(random_graph_problem(random, 2, ready=ready, **random_rules(random)))


@settings(max_examples=30, deadline=None)
@given(seed=seeds)
def test_plans_begin_with_what_was_released(seed):
    random = np.random.default_rng(seed)
    before = random_graph_problem(random, 3, **random_rules(random))
    first = Cbs().plan(before, BUDGET)
    if first.status is not PlanStatus.SOLVED:
        return
    released = tuple(cut(path, int(random.integers(0, 4))) for path in first.plan.paths)
    after = attrs.evolve(before, commitments=released)
    after = attrs.evolve(after, features=features_of(after) | before.features)
    again = Cbs().plan(after, BUDGET)
    assert again.status is PlanStatus.SOLVED
    assert check_plan(after, again.plan).valid
    assert again.plan.sum_of_costs == first.plan.sum_of_costs  # the first plan is still possible


@settings(max_examples=30, deadline=None)
@given(seed=seeds)
def test_delayed_releases_are_planned_around(seed):
    random = np.random.default_rng(seed)
    before = random_graph_problem(random, 2, **random_rules(random))
    edges = np.flatnonzero((before.roadmap.edges[:, 0] == before.start[0]) & (before.duration(0) > 0))
    if not len(edges):
        return
    edge = int(random.choice(edges))
    enter = int(random.integers(0, 3))
    leave = enter + int(before.duration(0)[edge]) + int(random.integers(0, 3))
    late = Path(edge=[-1, edge, -1], enter=[0, enter, leave], leave=[enter, leave, leave + int(random.integers(0, 2))])
    after = attrs.evolve(before, commitments=(late, cut(late, 0)))
    solve_and_compare(attrs.evolve(after, features=features_of(after) | before.features))


def cut(path: Path, size: int) -> Path:
    return Path(edge=path.edge[:size], enter=path.enter[:size], leave=path.leave[:size])


def test_a_slow_robot_is_not_overtaken_on_a_lane():
    road = grid(["...."])
    slow, fast = np.full(len(road.edges), 3), np.full(len(road.edges), 1)
    road = attrs.evolve(road, duration=np.array([slow, fast]))
    two = problem(road, [1, 0], [3, 2], profile=[0, 1])
    assert solve_and_compare(two) is PlanStatus.SOLVED
    result = Cbs().plan(two, BUDGET)
    assert result.plan.paths[1].arrival == 4  # behind the slow robot, which leaves vertex 2 at tick 3


def test_any_goal_of_a_set_will_do():
    road = grid([".....", "##.##"])
    result = Cbs().plan(problem(road, [0, 4], [(4, 1), (0, 3)]), BUDGET)
    assert [path.arrival for path in result.plan.paths] == [1, 1]


def test_the_same_input_gives_the_same_output():
    asked = random_grid_problem(np.random.default_rng(5), 6, size=5)
    one, other = Cbs().plan(asked, BUDGET), Cbs().plan(asked, BUDGET)
    assert one.plan == other.plan
    assert one.statistics == other.statistics


def test_published_optima(shared_data):
    with (shared_data / "mapf_optimal.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if int(row["agents"]) <= 30][::6]
    budget = Budget(wall_s=0.2, memory_bytes=1 << 30)
    solved = 0
    for row in rows:
        asked = movingai(shared_data, row["map"], row["scen"], int(row["agents"]))
        result = Cbs().plan(asked, budget)
        name = f"{row['map']} {row['scen']} {row['agents']}"
        assert not result.lower_bound > int(row["soc"]), name  # NaN if there was no time at all
        if result.status is PlanStatus.SOLVED:
            solved += 1
            assert result.plan.sum_of_costs == int(row["soc"]), name
            assert check_plan(asked, result.plan).valid, name
    assert solved > len(rows) / 2


def test_techniques_save_expansions(shared_data):
    asked = movingai(shared_data, "random-32-32-20", "random-2", 30)
    budget = Budget(wall_s=60, memory_bytes=1 << 30)
    expansions = {
        technique: Cbs(**{technique: False}).plan(asked, budget).statistics["expansions"]
        for technique in ("prioritize", "target", "corridor")
    }
    assert Cbs().plan(asked, budget).statistics["expansions"] < min(expansions.values())
