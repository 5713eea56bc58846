"""Infeasible scenarios are found and said in words."""

import attrs
import numpy as np
import pytest

from mrpbench_core.checking.scenario import check_scenario, check_travel
from mrpbench_core.model.planning.problem import Feature, Problem, Rules
from mrpbench_core.model.planning.roadmap import Roadmap


@pytest.fixture
def roadmap() -> Roadmap:
    """0 <-> 1 -> 2, an island 3, and 4 straight above 0 on another level; the second profile may not use 1 -> 2."""
    return Roadmap(
        position=[[0, 0], [1, 0], [2, 0], [5, 5], [0, 0]],
        level=[0, 0, 0, 0, 1],
        heading=[np.nan] * 5,
        edges=[[0, 1], [1, 0], [1, 2]],
        duration=[[1, 1, 1], [1, 1, -1]],
        tick=1.0,
    )


def problem(roadmap, start, goals, profile=None, radius=0.2, **rest):
    return Problem(
        roadmap=roadmap,
        profile=profile or [0] * len(start),
        radius=[radius] * len(start),
        start=start,
        ready=[0] * len(start),
        goals=tuple(tuple(tuple(goal_set) for goal_set in sequence) for sequence in goals),
        **rest,
    )


def test_a_feasible_scenario_has_no_faults(roadmap):
    assert check_scenario(problem(roadmap, [0, 1], [[[1]], [[2]]])) == []


def test_robots_on_one_vertex_are_named(roadmap):
    posed = problem(roadmap, [0, 1, 0], [[[0]], [[1]], [[2]]])
    assert check_scenario(posed, ["puffin", "seal", "puffin_2"]) == ["robots 0 and 2 both start at puffin"]
    assert check_scenario(posed) == ["robots 0 and 2 both start at (0.00, 0.00)"]


def test_a_shared_goal_is_named_unless_robots_disappear_there(roadmap):
    posed = problem(roadmap, [0, 1], [[[2]], [[2]]])
    assert check_scenario(posed, goal_names=["frog", "frog"]) == ["robots 0 and 1 share the goal frog"]
    assert check_scenario(attrs.evolve(posed, rules=Rules(at_goal="disappear"))) == []


def test_passing_anothers_goal_and_choosing_among_goals_are_allowed(roadmap):
    assert check_scenario(problem(roadmap, [0, 1], [[[1], [0]], [[1]]])) == []
    assert check_scenario(problem(roadmap, [0, 1], [[[0, 1]], [[0, 1]]])) == []


def test_discs_that_overlap_are_a_fault_only_where_footprints_count(roadmap):
    posed = problem(roadmap, [0, 1], [[[0]], [[1]]], radius=0.6)
    assert check_scenario(posed) == []
    assert check_scenario(attrs.evolve(posed, features=frozenset({Feature.FOOTPRINTS})), ["a", "b"], ["c", "d"]) == [
        "robots 0 and 1 start at a and b, 1.00 m apart, and need 1.20 m",
        "robots 0 and 1 have the goals c and d, 1.00 m apart, and need 1.20 m",
    ]
    touching = attrs.evolve(posed, radius=[0.5, 0.5], features=frozenset({Feature.FOOTPRINTS}))
    assert check_scenario(touching) == []


def test_robots_above_one_another_are_apart(roadmap):
    posed = problem(roadmap, [0, 4], [[[0]], [[4]]], features=frozenset({Feature.FOOTPRINTS}))
    assert check_scenario(posed) == []


def test_an_unreachable_goal_is_named_with_its_robot(roadmap):
    posed = problem(roadmap, [0, 2], [[[3]], [[1]]])
    assert check_scenario(posed, ["a", "b"], ["c", "d"]) == [
        "robot 0 cannot reach its goal c from its start a",
        "robot 1 cannot reach its goal d from its start b",
    ]


def test_reach_is_that_of_each_robots_profile(roadmap):
    assert check_scenario(problem(roadmap, [0, 1], [[[2]], [[0]]], profile=[1, 0])) == [
        "robot 0 cannot reach its goal (2.00, 0.00) from its start (0.00, 0.00)"
    ]


def test_a_sequence_must_be_reachable_in_order(roadmap):
    assert check_scenario(problem(roadmap, [0], [[[1], [2]]])) == []
    assert check_scenario(problem(roadmap, [0], [[[2], [1]]])) == [
        "robot 0 cannot reach its goal (1.00, 0.00) from its start (0.00, 0.00)"
    ]
    assert check_scenario(problem(roadmap, [0], [[[2, 1], [0]]])) == []
    assert check_scenario(problem(roadmap, [0], [[[3], [1]]])) == [
        "robot 0 cannot reach goal 0 of its sequence from its start (0.00, 0.00)"
    ]


def test_places_off_the_roadmap_are_named(roadmap):
    assert check_scenario(problem(roadmap, [-1, 0], [[[1]], [[-1]]]), ["coe", ""], ["", "lounge"]) == [
        "robot 0 starts at coe, which is not on the roadmap",
        "robot 1 is to reach its goal lounge, which is not on the roadmap",
    ]


def test_a_robot_without_goals_is_feasible_anywhere(roadmap):
    assert check_scenario(problem(roadmap, [3, 0], [[], [[2]]])) == []


def test_travel_times_name_goals_that_no_assignment_can_reach():
    way, no = 1.0, np.inf
    square = np.array([[way, no], [no, no]])
    assert check_travel(square) == [
        "robot 1 can reach no goal from its start",
        "no robot can reach the goal of task 1",
    ]
    assert check_travel(square, ["a", "b"], ["c", "d"])[1] == "no robot can reach the goal of task 1 d"
    assert check_travel(np.array([[way, no]])) == []  # the robot does the other task
    assert check_travel(np.array([[way], [no]])) == []
    assert check_travel(np.array([[no, no]])) == ["robot 0 can reach no goal from its start"]
