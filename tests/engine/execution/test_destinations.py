from itertools import product

import attrs
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_tests.instances.problems import grid_of, problem_on

from mrpbench_core.engine.execution.destinations import Errand, Places

ROADMAP = grid_of([".....", "....."])


def places(radius, parking="stay", sets=False, starts=(0, 1, 2), rest=True):
    problem = attrs.evolve(problem_on(ROADMAP, list(starts), list(starts)), radius=np.full(3, radius))
    return Places(problem, [np.zeros(10, np.int64)], parking, sets, rest=rest)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.integers(0, 9), min_size=0, max_size=3),
    st.permutations(range(10)),
    st.sampled_from([0.2, 0.5]),
    st.booleans(),
)
def test_robots_can_stand_at_all_goals_at_once(wanted, heads, radius, home):
    errands = [Errand(robot, robot, 0, {vertex: np.nan}) for robot, vertex in enumerate(wanted)]
    made = places(radius, "home" if home else "stay").destinations([[it] for it in errands], np.array(heads[:3]))
    goals = [goal for ((goal,),) in made.goals]
    assert len(set(goals)) == 3
    for errand in errands:
        first = wanted.index(wanted[errand.robot]) == errand.robot
        assert (made.errands[errand.robot] == ((errand.task, 0),)) == first, (
            "of those for one place, the first goes there"
        )
        assert made.goals[errand.robot] == ((wanted[errand.robot],),) or not first


def test_a_robot_without_an_errand_stays_unless_it_is_in_the_way():
    here = np.array([0, 4, 9])
    assert places(0.2).destinations([], here).goals == (((0,),), ((4,),), ((9,),))
    away = places(0.2).destinations([[Errand(0, 0, 0, {4: np.nan})]], here).goals
    assert away[0] == ((4,),)
    assert away[1] != ((4,),)
    assert places(0.2, "home").destinations([], here).goals == (((0,),), ((1,),), ((2,),))


def test_a_planner_that_takes_sets_chooses_where_robots_make_room():
    made = places(0.2, sets=True).destinations([[Errand(0, 0, 0, {4: 1.5})]], np.array([0, 4, 9]))
    assert made.goals[1] == (tuple(vertex for vertex in range(10) if vertex != 4),)
    assert made.yaw[0] == 1.5
    assert np.isnan(made.yaw[1:]).all()


def test_a_planner_that_chooses_goals_gets_those_of_errands_only():
    made = places(0.2, sets=True, rest=False).destinations([[Errand(0, 0, 0, {4: 1.5})]], np.array([0, 4, 9]))
    assert made.goals == (((4,),), (), ())


def test_a_robot_goes_over_its_errands_to_the_last_at_which_there_is_room():
    first = [Errand(0, 5, 0, {4: np.nan})]
    second = [Errand(1, 6, 1, {4: np.nan}), Errand(1, 6, 2, {7: np.nan}), Errand(1, 8, 0, {4: 1.5})]
    made = places(0.2).destinations([first, second], np.array([0, 1, 2]))
    assert made.goals[1] == ((4,), (7,))
    assert made.errands[:2] == (((5, 0),), ((6, 1), (6, 2)))
    assert np.isnan(made.yaw[1]), "only the yaw at the end of the path is wanted"


CHOICES = st.lists(st.integers(0, 9), min_size=1, max_size=4, unique=True)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(CHOICES, min_size=3, max_size=3), st.permutations(range(10)), st.sampled_from([0.2, 0.5]), st.booleans()
)
def test_whatever_a_planner_chooses_for_some_robots_each_other_robot_has_a_place_of_its_own(sets, heads, radius, takes):
    """Brute force over all choices of the planner."""
    ways = [[Errand(robot, robot, 0, dict.fromkeys(places, np.nan))] for robot, places in enumerate(sets)]
    made = places(radius, sets=takes).destinations(ways, np.array(heads[:3]))
    going = [robot for robot in range(3) if made.errands[robot]]
    goals = {robot: made.goals[robot][0] for robot in going}
    assert all(set(goals[robot]) <= set(sets[robot]) for robot in going)
    assert takes or all(len(goal) == 1 for goal in goals.values())

    def apart(one, other):
        return np.hypot(*(ROADMAP.position[one] - ROADMAP.position[other])) >= 2 * radius - 1e-9 and one != other

    own = {}
    for robot in going:  # the engine's choice: the nearest that those before leave
        own[robot] = next(it for it in sets[robot] if all(apart(it, own[other]) for other in going if other < robot))
        assert own[robot] in goals[robot]
    for robot in going:
        others = [other for other in going if other != robot]
        for chosen in product(*(goals[other] for other in others)):
            assert all(apart(own[robot], place) for place in chosen)
    for robot in set(range(3)) - set(going):  # it makes room because nothing is left
        assert not any(all(apart(it, own[other]) for other in going if other < robot) for it in sets[robot])


def test_robots_that_share_goals_are_spread_over_the_places_of_an_errand():
    docks = [[Errand(robot, robot, 0, {4: np.nan, 9: np.nan})] for robot in range(3)]
    problem = attrs.evolve(problem_on(ROADMAP, [0, 1, 2], [0, 1, 2]), radius=np.full(3, 0.2))
    made = Places(problem, [np.zeros(10, np.int64)], "stay", False, shared=True).destinations(
        docks, np.array([0, 1, 2])
    )
    assert made.goals == (((4,),), ((9,),), ((4,),))
    docks[1][0] = attrs.evolve(docks[1][0], yaws={9: 0.0, 4: 1.0})
    made = Places(problem, [np.zeros(10, np.int64)], "stay", True).destinations(docks[1:2], np.array([0, 1, 2]))
    assert (made.goals[1], made.yaw[1]) == (((9,),), 0.0), "a planner does not choose between yaws"
