"""A robot that is late loses its turn where that helps, and only there."""

import attrs
import numpy as np
import pytest
from mrpbench_dispatchers_reordering import Btpg, Gses, Sadg
from mrpbench_tests.instances.roadmaps import two_way, two_way_grid

from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Feature, Rules
from mrpbench_core.model.planning.roadmap import Resource
from mrpbench_core.testing.drawing import build, path_through
from mrpbench_core.testing.execution.delayed_executor import DelayedExecutor
from mrpbench_core.testing.execution.drain import drain
from mrpbench_core.testing.execution.resource_manager import ResourceManager

LATE = 60
"""steps for which robot 0 does not move."""


class FirstIsLate(DelayedExecutor):
    """Robot 0 does not move at first; all others make a move per step."""

    def __init__(self, problem, plan):
        super().__init__(problem, plan)
        self._stuck_until[0] = LATE
        self.arrival = {}

    def step(self, now, released):
        """Move all robots a little."""
        alive = super().step(now, released)
        for robot, path in enumerate(self.plan.paths):
            if self.reached[robot] == len(path):
                self.arrival.setdefault(robot, now)
        return alive


def crossing(rules=None, features=frozenset(), radius=0.1):
    """Robot 0 goes right through the middle of a grid before robot 1 goes up through it."""
    grid = two_way_grid(7, 7)
    routes = [(21, 22, 23, 24, 25, 26), (3, 3, 3, 10, 17, 24, 31, 38)]
    return planned(grid, routes, rules or Rules(), features, radius)


def planned(roadmap, routes, rules, features=frozenset(), radius=0.1):
    plan = Plan(paths=tuple(path_through(roadmap, route) for route in routes))
    problem = build(roadmap, [route[0] for route in routes], [()] * len(routes))
    goals = tuple(((route[-1],),) for route in routes)
    problem = attrs.evolve(problem, goals=goals, rules=rules, features=features, radius=np.full(len(routes), radius))
    assert check_plan(problem, plan).valid, check_plan(problem, plan)
    return problem, plan


def arrivals(dispatcher, problem, plan):
    executor = FirstIsLate(problem, plan)
    drain(dispatcher.start(problem, plan), executor)
    assert executor.fault is None, executor.fault
    return executor.arrival, executor.reordered


@pytest.mark.parametrize("dispatcher", [Btpg, Gses, Sadg])
@pytest.mark.parametrize("following", ["allowed", "forbidden"])
@pytest.mark.parametrize("at_goal", ["stay", "disappear"])
@pytest.mark.parametrize("features", [frozenset(), frozenset({Feature.FOOTPRINTS})])
def test_a_robot_does_not_wait_for_one_that_does_not_come(following, at_goal, features, dispatcher):
    situation = crossing(Rules(following=following, at_goal=at_goal), features)
    kept, _ = arrivals(Adg(lookahead=1), *situation)
    changed, reordered = arrivals(dispatcher(lookahead=1), *situation)
    assert kept[1] > LATE
    assert reordered
    assert changed[1] < 25
    assert changed[0] <= kept[0]


@pytest.mark.parametrize("dispatcher", [Btpg, Gses, Sadg])
def test_lanes_that_cross_between_their_ends_are_used_in_a_new_order(dispatcher):
    points = [(-5, 0), (-3, 0), (-1, 0), (1, 0), (3, 0), (0, -3), (0, -1), (0, 1), (0, 3)]
    lanes = [(0, 1), (1, 2), (2, 3), (3, 4), (5, 6), (6, 7), (7, 8)]
    routes = [(0, 1, 2, 3, 4), (5, 5, 5, 6, 7, 8)]
    situation = planned(two_way(points, lanes), routes, Rules(), frozenset({Feature.FOOTPRINTS}))
    kept, _ = arrivals(Adg(lookahead=1), *situation)
    changed, _ = arrivals(dispatcher(lookahead=1), *situation)
    assert kept[1] > LATE > changed[1]


@pytest.mark.parametrize("dispatcher", [Btpg, Gses, Sadg])
def test_robots_that_are_released_into_a_place_keep_their_turn(dispatcher):
    changed, reordered = arrivals(dispatcher(lookahead=8), *crossing())
    assert changed[1] > LATE
    assert not reordered


def test_places_that_are_not_searched_keep_their_order():
    assert not arrivals(Btpg(lookahead=1, group_limit=0), *crossing())[1]


@pytest.mark.parametrize("options", [{"horizon": 0.0}, {"gain": 1e6}, {"lateness": 1e6}])
def test_options_limit_what_is_searched_and_changed(options):
    assert not arrivals(Gses(lookahead=1, **options), *crossing())[1]


@pytest.mark.parametrize("dispatcher", [Btpg, Gses, Sadg])
def test_a_resource_is_used_in_the_order_of_the_plan(dispatcher):
    problem, plan = crossing()
    edges = tuple(np.flatnonzero((problem.roadmap.edges == 24).any(axis=1)).tolist())
    middle = Resource(name="middle", kind="mutex", vertices=(24,), edges=edges)
    session_problem = attrs.evolve(problem, roadmap=attrs.evolve(problem.roadmap, resources=(middle,)))
    assert check_plan(session_problem, plan).valid
    executor = FirstIsLate(session_problem, plan)
    manager = ResourceManager(session_problem, np.random.default_rng(0))
    drain(dispatcher(lookahead=1).start(session_problem, plan), executor, manager)
    assert executor.fault is None
    assert manager.fault is None
    assert not executor.reordered
