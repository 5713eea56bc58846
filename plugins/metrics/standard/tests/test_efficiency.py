"""The metric `efficiency` on ways measured by hand."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_metrics_standard import Efficiency
from mrpbench_metrics_standard.shortest import shortest_lengths

from mrpbench_core.model.planning.plan import Plan, PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Roadmap


def asked(run, starts, goals):
    """The run, as if it had been planned on the roadmap of the fixtures."""
    problem = attrs.evolve(run.context.problem, start=starts, goals=goals)
    result = PlanResult(status=PlanStatus.SOLVED, plan=Plan(paths=()))
    return attrs.evolve(run, context=attrs.evolve(run.context, problem=problem, result=result))


@pytest.fixture
def driving(executed):
    """On the line 3 m + 3 m: robot 0 drives 8 m for 6 m, then on; robot 1 gets 1 m of 3 m far; robot 2 is at home."""
    tracks = [[(0, 0), (0, 1), (6, 1), (6, 0), (6, 5)], [(3, 0), (3, 0), (4, 0), (4, 0), (4, 0)], [(0, 4)] * 5]
    reached = [[0, 0, 1, 2, 2], [0] * 5, [0] * 5]
    points = [[(0, 0), (3, 0), (6, 0)], [(3, 0), (6, 0), (3, 0), (6, 0)], [(0, 4)]]
    return asked(executed(range(5), tracks, reached, points), [0, 1, 3], (((2,),), ((2,),), ()))


def test_true_ways_are_compared_with_planned_and_shortest_ones(driving):
    values = Efficiency().measure(driving)
    assert values["spl"] == pytest.approx((6 / 8 + 0) / 2)
    assert values["path_efficiency"] == pytest.approx(6 / 8)
    assert values["detour"] == pytest.approx(8 / 6)
    assert values["planned_detour"] == pytest.approx((6 + 9) / (6 + 3))


def test_cutting_corners_gains_no_spl(executed):
    run = asked(executed([0, 1], [[(0, 0), (6, 0)]], [[0, 2]], [[(0, 0), (3, 4), (6, 0)]]), [0], (((2,),),))
    values = Efficiency().measure(run)
    assert (values["spl"], values["path_efficiency"]) == (1.0, 10 / 6)


@pytest.mark.parametrize("goals", [((),), (((0,),),)])
def test_without_a_robot_that_has_to_move_there_is_no_efficiency(executed, goals):
    run = asked(executed([0, 1], [[(0, 0)] * 2], [[0, 0]], [[(0, 0)]]), [0], goals)
    assert set(Efficiency().measure(run).values()) == {None}


def test_a_goal_out_of_reach_leaves_nothing_to_compare(executed):
    run = asked(executed([0, 1], [[(0, 4)] * 2], [[0, 0]], [[(0, 4), (0, 0)]]), [3], (((0,),),))
    assert set(Efficiency().measure(run).values()) == {None}


def test_shortest_lengths_take_the_best_of_each_goal_set_in_order():
    """0 -> {1, 3} -> 2 on a line 0, 1, 2 of 3 m each with 3 at (0, 4) off 0, one way."""
    roadmap = Roadmap(
        position=[[0, 0], [3, 0], [6, 0], [0, 4]],
        level=[0] * 4,
        heading=[np.nan] * 4,
        edges=[[0, 1], [1, 2], [0, 3], [0, 1], [1, 0], [2, 0]],
        duration=[[1] * 6, [1, -1, 1, -1, 1, 1]],
        tick=1.0,
    )
    problem = Problem(
        roadmap=roadmap,
        profile=[0, 0, 1, 1],
        radius=[0.1] * 4,
        start=[0, 2, 0, 1],
        ready=[0] * 4,
        goals=(((3, 1), (2,)), ((1, 3),), ((2,),), ((3,),)),
    )
    assert shortest_lengths(problem).tolist() == [6, 9, np.inf, 7]


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 2**32 - 1))
def test_shortest_lengths_are_those_of_floyd_and_warshall(seed):
    random = np.random.default_rng(seed)
    position = random.integers(0, 3, (6, 2)).astype(float)  # some at one place: edges of no length
    edges = random.integers(0, 6, (12, 2))
    length = np.where(np.eye(6) > 0, 0.0, np.inf)
    for start, end in edges:
        length[start, end] = np.hypot(*(position[end] - position[start]))
    for via in range(6):
        length = np.minimum(length, length[:, [via]] + length[[via]])
    start, goal = random.integers(0, 6, (2, 4))
    roadmap = Roadmap(
        position=position, level=[0] * 6, heading=[np.nan] * 6, edges=edges, duration=[[1] * 12], tick=1.0
    )
    problem = Problem(
        roadmap=roadmap,
        profile=[0] * 4,
        radius=[0.1] * 4,
        start=start,
        ready=[0] * 4,
        goals=tuple(((int(vertex),),) for vertex in goal),
    )
    assert shortest_lengths(problem) == pytest.approx(length[start, goal])
