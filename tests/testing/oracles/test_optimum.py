"""Brute force against optima found by hand, and against walks of chance."""

import math

import pytest
from hypothesis import given, settings
from mrpbench_tests.oracles.optimum import UNSUPPORTED, least_sum_of_costs

from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.testing.drawing import grid, problem
from mrpbench_core.testing.named_problems import BAY, CROSSING, OPTIMA, solvable, unsolvable
from mrpbench_core.testing.strategies import plans

BY_HAND = {
    "a robot alone": 3,
    "a robot at its goal": 0,
    "a crossing": 5,  # 2 + 2, and one waits a tick
    "a corridor with a bay": 11,  # 4 for one; 1 + 1 into the bay, 1 wait, 1 + 3 out for the other
    "a parked robot in the way": 7,  # the parked one: 1 to the side, 1 wait... and back by tick 3
    "a ring of four": 4,
    "robots that disappear at their goals": 5,  # 1 for the first; the second follows it at once: 4
    "following forbidden": 7,  # 3, and 3 after a wait
    "commitments": 7,  # 2 for the first; the second is ready at 3: 5
    "goal sequences": 4,  # one back, three forth
    "resources": 5,  # the mutex is one vertex, which has room for one robot anyway
    "goal sets": 3,
}


@pytest.mark.parametrize("name", BY_HAND)
def test_optima_are_those_found_by_hand(name):
    assert least_sum_of_costs(solvable()[name]) == BY_HAND[name]


@pytest.mark.parametrize("name", OPTIMA)
def test_the_optima_of_the_conformance_kit_are_right(name):
    assert least_sum_of_costs(solvable()[name], 400_000) == OPTIMA[name]


def test_the_conformance_kit_lacks_only_optima_that_brute_force_cannot_find():
    assert {name for name, drawn in solvable().items() if drawn.features & UNSUPPORTED} == {*solvable()} - {*OPTIMA}


@pytest.mark.parametrize("name", unsolvable())
def test_an_instance_without_a_plan_has_no_optimum(name):
    assert least_sum_of_costs(unsolvable()[name]) == math.inf


def test_footprints_that_touch_at_the_start_have_no_plan():
    assert least_sum_of_costs(problem("a b . A B", radius=0.6, features={Feature.FOOTPRINTS})) == math.inf


def test_wide_robots_wait_longer():
    thin, wide = (
        least_sum_of_costs(problem(CROSSING, radius=radius, features={Feature.FOOTPRINTS})) for radius in (0.0, 0.3)
    )
    assert (thin, wide) == (5, 6)


def test_features_it_does_not_know_are_refused():
    with pytest.raises(ValueError, match="horizon"):
        least_sum_of_costs(problem(BAY, horizon=3))


@settings(deadline=None, max_examples=40)
@given(plans(most_robots=3))
def test_no_walk_is_cheaper(drawn):
    asked, plan = drawn
    best = least_sum_of_costs(asked)
    assert best is not None
    assert best <= plan.sum_of_costs


def test_a_drawing_is_read_from_top_to_bottom():
    drawn = problem("""
        a  #  B
        .  b  A
    """)
    roadmap = drawn.roadmap
    assert roadmap.position[drawn.start].tolist() == [[0.5, 1.5], [1.5, 0.5]]
    assert [roadmap.position[goal[0][0]].tolist() for goal in drawn.goals] == [[2.5, 0.5], [2.5, 1.5]]
    assert len(roadmap.position) == 5
    assert len(roadmap.edges) == 8
    assert roadmap.grid.shape == (2, 3)


def test_a_drawing_with_ragged_lines_is_refused():
    with pytest.raises(ValueError, match="different lengths"):
        problem("a A\n .")


def test_a_grid_without_free_cells_is_one():
    assert len(grid(1, 1, [(0, 0)]).position) == 0
