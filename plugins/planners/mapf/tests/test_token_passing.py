"""Token passing finishes all tasks that are well-formed, and keeps the paths of robots with the same goals."""

import math

import attrs
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mrpbench_assigners_greedy.token_passing import TokenPassing as Choosing
from mrpbench_planners_mapf.token_passing import TokenPassing
from mrpbench_planners_rolling_horizon.rolling_horizon import RollingHorizon
from mrpbench_tests.execution.task_steps import BUDGET, TaskSteps, until_done
from mrpbench_tests.instances.problems import grid_of, problem_on

from mrpbench_core.builtin.task_sources.listed import ListedStream
from mrpbench_core.checking.well_formed import ill_formed
from mrpbench_core.model.planning.plan import Paths
from mrpbench_core.model.planning.scenario import Task

ROOM = grid_of([".......", ".#.#.#.", ".......", ".#.#.#.", "......."])


@st.composite
def well_formed(draw):
    """Robots and the places of tasks, at random on a small map."""
    free = draw(st.permutations(range(len(ROOM.position))))
    robots = draw(st.integers(1, 4))
    places = np.array(free[robots : robots + draw(st.integers(2, 5))])
    problem = problem_on(ROOM, free[:robots], free[:robots])
    assume(ill_formed(problem, places) is None)
    errands = st.lists(st.sampled_from(places.tolist()), min_size=1, max_size=3)
    tasks = draw(st.lists(st.tuples(st.integers(0, 20), errands), min_size=1, max_size=12))
    return problem, [
        Task(
            goals=np.column_stack([ROOM.position[visited], np.full(len(visited), np.nan)]),
            levels=np.zeros(len(visited), np.int16),
            release=float(release),
            index=index,
        )
        for index, (release, visited) in enumerate(sorted(tasks))
    ]


@settings(max_examples=12, deadline=None)
@given(well_formed(), st.booleans())
def test_all_well_formed_tasks_are_done_without_conflicts_and_alike_each_time(given_, swaps):
    problem, tasks = given_
    ends = []
    for _ in range(2):
        run = TaskSteps(problem, ListedStream(tasks), Choosing(task_swaps=swaps), TokenPassing(), parking="home")
        ends.append(until_done(run, 2000))
        assert run.ledger.faults == []
        assert run.ledger.finished == len(tasks)
    assert ends[0] == ends[1] < math.inf


def test_only_robots_with_other_goals_get_other_paths():
    planner, problem = TokenPassing(), problem_on(ROOM, [0, 6, 20], [26, 2, 20])
    first = planner.plan(problem, BUDGET).plan
    other = attrs.evolve(problem, goals=(*problem.goals[:2], ((0,),)), remaining=first.paths)
    second = planner.plan(other, BUDGET).plan
    for robot in (0, 1):
        assert np.array_equal(second.paths[robot].edge, first.paths[robot].edge)
        assert np.array_equal(second.paths[robot].leave, first.paths[robot].leave)
    assert second.paths[2].end(ROOM, 20) == 0


def test_a_path_that_may_not_be_used_any_more_is_not_kept():
    planner, road = TokenPassing(), grid_of(["...", "..."])
    problem = problem_on(road, [0], [2])
    first = Paths.of(planner.plan(problem, BUDGET).plan.paths)
    closed = attrs.evolve(road, duration=np.where(np.arange(len(road.edges)) == first.edge[0], -1, road.duration))
    after = planner.plan(attrs.evolve(problem, roadmap=closed, remaining=first), BUDGET).plan
    assert len(after.paths[0]) > len(first)
    assert first.edge[0] not in after.paths[0].edge


def test_tasks_that_are_not_well_formed_are_refused_with_the_reason():
    problem = problem_on(ROOM, [0, 6], [0, 6])
    planner = RollingHorizon(planner=TokenPassing())
    assert planner.skip_tasks(problem, np.array([8, 9])) is None
    reason = planner.skip_tasks(problem, np.array([6, 9]))
    assert reason.startswith("needs well-formed tasks: robot 1 starts at (")
    assert "does not say where" in planner.skip_tasks(problem, None)


@pytest.mark.parametrize("swaps", [False, True])
def test_robots_that_stay_where_they_are_also_finish(swaps):
    """Robots without a task are in the way, and are sent home in the end."""
    problem = problem_on(ROOM, [0, 6], [0, 6])
    goals = np.array([[*ROOM.position[vertex], np.nan] for vertex in (8, 9, 8)])
    tasks = [Task(goals=goals[[k % 3]], levels=np.zeros(1, np.int16), index=k) for k in range(6)]
    run = TaskSteps(problem, ListedStream(tasks), Choosing(task_swaps=swaps), TokenPassing())
    assert until_done(run, 500) < math.inf
