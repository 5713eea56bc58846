"""PIBT asked anew in every step, as a fleet does that plans in each second."""

import attrs
import numpy as np
from mrpbench_planners_mapf.native import KnownRoadmap
from mrpbench_planners_mapf.pibt import Pibt
from mrpbench_tests.instances.problems import grid_of, problem_on

from mrpbench_core.model.planning.plan import Budget
from mrpbench_core.model.planning.problem import Feature

BUDGET = Budget(wall_s=100, memory_bytes=1 << 30)
RING = ["......", ".####.", "......"]


class Steps:
    """Robots that make the first step of each plan of one session, which are for a window of four."""

    def __init__(self, start, goals):
        self.session, self.road = Pibt().start(), grid_of(RING)
        self.at, self.goals = np.array(start), list(goals)

    def __call__(self):
        asked = problem_on(self.road, self.at, self.goals)
        asked = attrs.evolve(asked, horizon=4, features=asked.features | {Feature.HORIZON})
        plan = self.session.plan(asked, BUDGET).plan
        for robot, path in enumerate(plan.paths):
            if len(path) and path.edge[0] >= 0:
                self.at[robot] = self.road.edges[path.edge[0], 1]
        return [path.end(self.road, start) for path, start in zip(plan.paths, asked.start, strict=True)]


def test_robots_that_meet_do_not_give_way_in_turns_for_ever():
    steps = Steps([2, 3], [5, 0])
    arrived = set()
    for _ in range(30):
        steps()
        arrived |= set(np.flatnonzero(steps.at == steps.goals).tolist())
    assert arrived == {0, 1}


def test_a_robot_that_has_come_to_its_goal_stays_until_another_has_been_under_way_for_longer():
    steps = Steps([0, 4], [3, 4])
    for _ in range(4):
        steps()
    assert steps.at.tolist() == [3, 4]
    steps.goals[1] = 2
    assert steps()[0] == 3
    for _ in range(12):
        steps()
    assert steps.at[1] == 2


def test_a_robot_that_would_step_back_for_another_waits_for_it():
    """In a corridor, the second robot could step forward twice, and would be pushed back as often."""
    road = grid_of(["......"])
    asked = problem_on(road, [5, 1], [0, 5], horizon=4)
    rank = np.array([0, 1], np.int32)
    paths = Pibt().solve(asked, BUDGET, rank).plan.paths
    assert paths[0].vertices(road, 5).tolist() == [5, 4, 3, 2, 1]
    assert paths[1].vertices(road, 1).tolist() == [1, 1, 0]


def test_what_is_known_of_a_roadmap_changes_no_plan():
    random, planner = np.random.default_rng(0), Pibt()
    whole, known = grid_of(RING), KnownRoadmap(planner.solvers)
    slow = attrs.evolve(whole, duration=np.where(np.arange(len(whole.edges)) % 3 == 0, 2, whole.duration))
    goals = [0, 5, 8]
    for call in range(12):
        goals[call % 3] = int(random.integers(len(whole.position)))
        problem = problem_on((whole, slow)[call // 3 % 2], random.permutation(len(whole.position))[:3], goals)
        problem = attrs.evolve(problem, horizon=6, features=problem.features | {Feature.HORIZON})
        one, other = planner.solve(problem, BUDGET, known=known), planner.solve(problem, BUDGET)
        assert (one.status, one.plan) == (other.status, other.plan)
