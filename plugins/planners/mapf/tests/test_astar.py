"""Decentralised A*: shortest paths, which may conflict."""

import numpy as np
import pytest
from mrpbench_planners_mapf.astar import Astar
from mrpbench_tests.instances.problems import problem_on
from mrpbench_tests.instances.random_problems import random_graph_problem, random_rules
from mrpbench_tests.instances.roadmaps import grid_of
from mrpbench_tests.oracles.optimum import earliest_arrival

from mrpbench_core.api.planner import Promise
from mrpbench_core.checking.paths import path_faults
from mrpbench_core.model.planning.plan import Budget, PlanStatus

BUDGET = Budget(wall_s=5, memory_bytes=1 << 30)


@pytest.mark.parametrize("heuristic", ["exact", "zero", "manhattan", "octile", "euclidean"])
def test_every_robot_takes_a_shortest_path(heuristic):
    random = np.random.default_rng(2)
    for _ in range(60):
        asked = random_graph_problem(random, 4, longest=9, ready=random.integers(0, 4, 4), **random_rules(random))
        result = Astar(heuristic=heuristic).plan(asked, BUDGET)
        wanted = [earliest_arrival(asked, robot) for robot in range(4)]
        if np.inf in wanted:
            assert result.status is PlanStatus.UNSOLVABLE
            continue
        assert not path_faults(asked, result.plan.paths)
        assert [path.arrival for path in result.plan.paths] == wanted
        assert result.lower_bound == sum(wanted)


def test_paths_ignore_the_other_robots_and_it_does_not_promise_otherwise():
    result = Astar().plan(problem_on(grid_of(["..."]), [0, 2], [2, 0]), BUDGET)
    assert [path.arrival for path in result.plan.paths] == [2, 2]
    assert Promise.CONFLICT_FREE not in Astar.promises


def test_better_estimates_expand_less():
    asked = problem_on(grid_of(["." * 20] * 20), [0], [399])
    effort = {
        name: Astar(heuristic=name).plan(asked, BUDGET).statistics["low_level_expansions"]
        for name in ("exact", "zero", "euclidean")
    }
    assert effort["exact"] == 38
    assert effort["exact"] < effort["euclidean"] < effort["zero"]
