"""Doors, lifts and mutexes: plans keep to them, and the least costs are those of the joint-space oracle."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_planners_mapf.bounded import Ecbs, Eecbs
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_planners_mapf.cbs_ta import CbsTa, ItaCbs
from mrpbench_planners_mapf.ecbs_ta import EcbsTa, ItaEcbs
from mrpbench_planners_mapf.lacam import Lacam
from mrpbench_planners_mapf.lns import Lns
from mrpbench_planners_mapf.pbs import Pbs
from mrpbench_planners_mapf.pibt import Pibt
from mrpbench_planners_mapf.prioritized import Prioritized
from mrpbench_tests.instances.problems import problem_on
from mrpbench_tests.instances.random_problems import random_graph_problem, random_grid_problem, random_rules
from mrpbench_tests.instances.roadmaps import grid_of
from mrpbench_tests.instances.variations import with_late_release, with_resources
from mrpbench_tests.oracles.judge import AMPLE, BUDGET, ask, compare_with_optimum
from mrpbench_tests.oracles.optimum import least_sum_of_costs

from mrpbench_core.model.planning.plan import PlanStatus
from mrpbench_core.model.planning.roadmap import Resource

BOUNDED = (Ecbs(w=1.0), Ecbs(w=1.5), Eecbs(w=1.0), Eecbs(w=1.05, flex=True), Eecbs(w=1.5, target=False))
TECHNIQUES = ("heuristic", "target", "corridor", "rectangle", "precedence", "prioritize", "bypass")
ABLATIONS = (Cbs(), Cbs(**dict.fromkeys(TECHNIQUES, False)), *(Cbs(**{name: False}) for name in TECHNIQUES))
ANYTIME = (Pibt(), Lacam(), Lns(), Lns(initial="repair"), Lns(objective="makespan", neighbourhood=2))
PLANNERS = (*ABLATIONS, *BOUNDED, Pbs(), Prioritized(restarts=20), *ANYTIME)
seeds = st.integers(0, 2**32 - 1)


def hall(setup: int = 0, **fields):
    """Two rooms of four cells with a passage of three between them, which belongs to a door."""
    road = grid_of(["..###..", "......."])  # 0 1 . . . 2 3 above 4 5 [6 7 8] 9 10
    inside = {6, 7, 8}
    edges = tuple(edge for edge, ends in enumerate(road.edges.tolist()) if inside.issuperset(ends))
    door = Resource(name="door", kind="door", vertices=tuple(inside), edges=edges, setup_ticks=setup, **fields)
    return attrs.evolve(road, resources=(door,))


@settings(max_examples=60, deadline=None)
@given(seed=seeds, planner=st.sampled_from(PLANNERS))
def test_plans_on_graphs_keep_to_resources_and_none_is_missed(seed, planner):
    random = np.random.default_rng(seed)
    asked = random_graph_problem(random, int(random.integers(2, 4)), **random_rules(random))
    compare_with_optimum(planner, with_resources(random, asked))


@settings(max_examples=30, deadline=None)
@given(seed=seeds, planner=st.sampled_from(PLANNERS))
def test_plans_on_grids_keep_to_resources_and_none_is_missed(seed, planner):
    random = np.random.default_rng(seed)
    asked = random_grid_problem(
        random, int(random.integers(2, 4)), size=3, at_goal=str(random.choice(["stay", "disappear"]))
    )
    compare_with_optimum(planner, with_resources(random, asked))


@settings(max_examples=30, deadline=None)
@given(seed=seeds, capacity=st.integers(1, 3), planner=st.sampled_from((Pbs(), Prioritized(restarts=20), *ANYTIME)))
def test_resources_that_hold_several_robots_are_respected(seed, capacity, planner):
    random = np.random.default_rng(seed)
    asked = with_resources(random, random_grid_problem(random, 4, size=4), capacity)
    if planner.skip(asked) is None:
        ask(planner, asked, budget=attrs.evolve(BUDGET, iterations=20))


@pytest.mark.parametrize("planner", [Cbs(), Eecbs(), Ecbs(), Pbs(), Lns()])
def test_what_has_a_simple_plan_is_solved(planner):
    random = np.random.default_rng(1)
    asked = [with_resources(random, random_graph_problem(random, 3)) for _ in range(40)]
    solvable = [it for it in asked if Prioritized(restarts=50).plan(it, BUDGET).status is PlanStatus.SOLVED]
    assert len(solvable) > 10
    solved = [planner.plan(it, attrs.evolve(AMPLE, iterations=20)).status is PlanStatus.SOLVED for it in solvable]
    assert all(solved)


@settings(max_examples=30, deadline=None)
@given(seed=seeds, planner=st.sampled_from((Cbs(), Eecbs(), Pbs())))
def test_late_and_slow_releases_are_planned_around(seed, planner):
    random = np.random.default_rng(seed)
    before = with_resources(random, random_graph_problem(random, 2, **random_rules(random)))
    compare_with_optimum(planner, with_late_release(random, before))


@pytest.mark.parametrize("planner", [Cbs(), Ecbs(w=1.0), Eecbs(w=1.0)])
@pytest.mark.parametrize("setup", [0, 5, 12])
def test_two_robots_pass_a_door_one_after_the_other(planner, setup):
    asked = problem_on(hall(setup), [4, 10], [3, 0])
    optimum = least_sum_of_costs(asked, most_states=100_000)
    assert ask(planner, asked, optimum, AMPLE).plan.sum_of_costs == optimum


@pytest.mark.parametrize("planner", [Cbs(), Eecbs(w=1.0), Ecbs(w=1.0), Pbs(), Prioritized(), Lns()])
def test_a_robot_that_ends_in_a_doorway_lets_the_others_through_first(planner):
    asked = problem_on(hall(setup=3), [5, 0, 2], [7, 3, 1])
    result = ask(planner, asked, budget=attrs.evolve(AMPLE, iterations=20))
    assert result.status is PlanStatus.SOLVED


@pytest.mark.parametrize("planner", [Cbs(), Cbs(target=False), Eecbs(), Ecbs(), Pbs(), Prioritized(), Pibt(), Lns()])
@pytest.mark.parametrize(("starts", "goals"), [([6, 8], [4, 10]), ([4, 10], [6, 8])])
def test_more_robots_than_a_resource_holds_at_the_start_or_for_good_are_seen_at_once(planner, starts, goals):
    assert planner.plan(problem_on(hall(), starts, goals), AMPLE).status is PlanStatus.UNSOLVABLE


@pytest.mark.parametrize("planner", [CbsTa(), ItaCbs(), EcbsTa(), ItaEcbs()])
def test_planners_that_assign_send_only_one_robot_into_a_resource(planner):
    asked = problem_on(hall(setup=2), [4, 10], [(5, 6, 8), (5, 6, 8)])
    result = ask(planner, asked, budget=AMPLE)
    assert result.status is PlanStatus.SOLVED
    assert result.plan.sum_of_costs == 3


def test_conflict_based_search_says_that_it_knows_no_roomy_resources():
    asked = problem_on(hall(capacity=2), [0, 3], [3, 0])
    assert Cbs().skip(asked) == Eecbs().skip(asked) == Ecbs().skip(asked) == "resource 'door' holds more than one robot"
    assert Pbs().skip(asked) is None
    assert Pbs().plan(asked, AMPLE).status is PlanStatus.SOLVED
