"""The commitments of a new plan. The tests of `adg` show that they never conflict."""

import attrs
import numpy as np
import pytest

from mrpbench_core.engine.execution.commitments import commitments, not_ahead
from mrpbench_core.model.planning.plan import Plan, RobotPath
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Roadmap

LINE = Roadmap(
    position=[(0, 0), (1, 0), (2, 0)],
    level=[0, 0, 0],
    heading=[np.nan] * 3,
    edges=[(0, 1), (1, 2)],
    duration=[[2, 3]],
    tick=1.0,
)
PROBLEM = Problem(roadmap=LINE, profile=[0], radius=[0.1], start=[0], ready=[0], goals=(((2,),),))
PLAN = Plan(paths=(RobotPath(edge=[0, -1, 1], enter=[0, 2, 4], leave=[2, 4, 7]),))


def committed(released, reached, ready, due):
    (path,) = commitments(PROBLEM, PLAN, np.array([released]), np.array([reached]), np.array([ready]), due)
    return [path.edge.tolist(), path.enter.tolist(), path.leave.tolist()]


@pytest.mark.parametrize(
    ("now", "expected"),
    [
        pytest.param((3, 1, 3, 3), [[0, -1, 1], [0, 2, 4], [2, 4, 7]], id="a robot on time keeps its times"),
        pytest.param((3, 0, 10, 9), [[0, -1, 1], [0, 10, 10], [10, 10, 13]], id="a late robot makes up no wait"),
        pytest.param((1, 1, 20, 20), [[0, -1], [0, 2], [2, 20]], id="who has nothing released waits"),
        pytest.param((0, 0, 5, 5), [[-1], [0], [5]], id="also at its start"),
        pytest.param((3, 3, 30, 30), [[0, -1, 1, -1], [0, 2, 4, 7], [2, 4, 7, 30]], id="and at its goal"),
        pytest.param((3, 2, 1, 1), [[0, -1, 1], [0, 2, 4], [2, 4, 7]], id="nothing becomes earlier"),
        pytest.param((0, 0, 0, 0), [[], [], []], id="nothing at all before the start"),
    ],
)
def test_released_segments_keep_their_index_and_take_the_time_they_will_need(now, expected):
    assert committed(*now) == expected


def test_all_times_are_earlier_where_a_robot_is_ahead_of_them():
    two = attrs.evolve(PROBLEM, profile=[0, 0], radius=[0.1, 0.1], start=[0, 0], ready=[0, 0], goals=PROBLEM.goals * 2)
    plan = Plan(paths=(*PLAN.paths, *PLAN.paths))
    problem, earlier = not_ahead(two, plan, np.array([1, 3]), 5)
    assert problem.begins.tolist() == problem.ready.tolist() == [-2, -2]
    assert [path.leave.tolist() for path in earlier.paths] == [[0, 2, 5], [0, 2, 5]]
    assert not_ahead(two, plan, np.array([1, 2]), 5) == (two, plan)
