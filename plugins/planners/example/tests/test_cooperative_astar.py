"""The example planner: valid plans, correct statuses."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_planners_example import Example

from mrpbench_core.api import Budget, Feature, PlanStatus, Problem, Roadmap, Rules, check_plan
from mrpbench_core.model.planning.problem import features_of

AMPLE = Budget(wall_s=60.0, memory_bytes=1 << 30)


def grid(rows, columns, blocked=()):
    cells = range(rows * columns)
    pairs = [(v, v + 1) for v in cells if (v + 1) % columns] + [(v, v + columns) for v in cells[:-columns]]
    edges = [edge for a, b in pairs if not {a, b} & set(blocked) for edge in ((a, b), (b, a))]
    return Roadmap(
        position=[(v % columns, v // columns) for v in cells],
        level=np.zeros(rows * columns),
        heading=np.full(rows * columns, np.nan),
        edges=edges,
        duration=np.ones((1, len(edges))),
        tick=1.0,
    )


def problem(roadmap, starts, goals, **fields):
    robots = len(starts)
    made = Problem(
        roadmap=roadmap,
        profile=np.zeros(robots),
        radius=np.full(robots, 0.1),
        start=starts,
        ready=np.zeros(robots),
        goals=tuple(((goal,),) for goal in goals),
        **fields,
    )
    return attrs.evolve(made, features=features_of(made))


@st.composite
def problems(draw):
    rows, columns = draw(st.integers(1, 5)), draw(st.integers(2, 5))
    cells = range(rows * columns)
    robots = draw(st.integers(1, min(7, rows * columns)))
    starts = draw(st.permutations(cells))[:robots]
    goals = draw(st.permutations(cells))[:robots]
    blocked = draw(st.sets(st.sampled_from(cells), max_size=rows * columns // 4)) - set(starts) - set(goals)
    return problem(grid(rows, columns, blocked), starts, goals)


def earliest_arrival(asked, robot, others):
    """Breadth first, tick by tick, over where `robot` can be: independent of the planner's search."""
    length = max((len(route) for route in others), default=1)
    at = [lambda tick, route=route: route[min(tick, len(route) - 1)] for route in others]
    edges = {(int(a), int(b)) for a, b in asked.roadmap.edges}
    here, goal = {int(asked.start[robot])}, asked.goals[robot][0][0]
    for tick in range(length + len(asked.roadmap.position) + 1):
        if goal in here and all(goal != where(later) for where in at for later in range(tick, tick + length)):
            return tick
        moves = {(a, b) for a in here for b in [a, *(b for c, b in edges if c == a)]}
        for where in at:
            moves -= {
                (a, b) for a, b in moves if b == where(tick + 1) or (where(tick), where(tick + 1)) == (b, a) != (b, b)
            }
        here = {b for _, b in moves}
    return None


@settings(deadline=None, max_examples=150)
@given(problems())
def test_each_robot_comes_as_early_as_those_before_it_let_it(asked):
    result = Example().plan(asked, AMPLE)
    if result.status is PlanStatus.SOLVED:
        report = check_plan(asked, result.plan)
        assert report.valid, report
        routes = [
            path.vertices(asked.roadmap, start).tolist()
            for path, start in zip(result.plan.paths, asked.start.tolist(), strict=True)
        ]
        for robot, route in enumerate(routes):
            assert len(route) - 1 == earliest_arrival(asked, robot, routes[:robot])
        assert result.lower_bound <= result.plan.sum_of_costs
        assert result.lower_bound == sum(earliest_arrival(asked, robot, []) for robot in range(len(asked)))
    else:
        alone = [earliest_arrival(asked, robot, []) for robot in range(len(asked))]
        assert (None in alone) == (result.status is PlanStatus.UNSOLVABLE)


@settings(deadline=None, max_examples=50)
@given(problems(), st.sampled_from(["given", "farthest_first"]))
def test_the_same_problem_gives_the_same_sound_plan(asked, order):
    first, second = Example(order=order).plan(asked, AMPLE), Example(order=order).plan(asked, AMPLE)
    assert first == second
    assert first.plan is None or check_plan(asked, first.plan).valid


def test_a_robot_lets_another_pass_in_a_bay():
    corridor = grid(2, 5, blocked=(5, 6, 7, 9))  # a corridor of five cells with a bay at the fourth
    asked = problem(corridor, [0, 4], [4, 0])
    result = Example().plan(asked, AMPLE)
    assert result.status is PlanStatus.SOLVED
    assert check_plan(asked, result.plan).valid
    assert result.plan.sum_of_costs > 8


def test_giving_up_is_not_a_proof():
    asked = problem(grid(1, 3), [0, 2], [2, 0])
    assert Example().plan(asked, AMPLE).status is PlanStatus.GAVE_UP


def test_priority_decides():
    asked = problem(grid(2, 4, blocked=(4, 5, 7)), [1, 0], [2, 3])  # a bay beside the first robot's goal
    assert Example(order="given").plan(asked, AMPLE).status is PlanStatus.GAVE_UP
    result = Example(order="farthest_first").plan(asked, AMPLE)
    assert result.status is PlanStatus.SOLVED
    assert check_plan(asked, result.plan).valid


def test_an_unreachable_goal_is_proved():
    asked = problem(grid(1, 3, blocked=(1,)), [0], [2])
    assert Example().plan(asked, AMPLE).status is PlanStatus.UNSOLVABLE


def test_an_edge_the_robot_may_not_use_is_not_used():
    roadmap = grid(2, 2)
    forbidden = [[-1 if tuple(edge) == (0, 1) else 1 for edge in roadmap.edges.tolist()]]
    asked = problem(attrs.evolve(roadmap, duration=forbidden), [0], [1])
    assert asked.features <= Example.supports
    assert Example().plan(asked, AMPLE).plan.sum_of_costs == 3


def test_time_is_kept():
    asked = problem(grid(30, 30), list(range(200)), list(range(899, 699, -1)))
    assert Example().plan(asked, attrs.evolve(AMPLE, wall_s=0.0)).status is PlanStatus.TIMEOUT


@pytest.mark.parametrize(
    ("fields", "missing"),
    [
        ({"rules": Rules(following="forbidden")}, "following_forbidden"),
        ({"horizon": 5}, "horizon"),
    ],
)
def test_problems_that_it_does_not_support_are_skipped(fields, missing):
    assert Example().skip(problem(grid(1, 2), [0], [1], **fields)) == f"does not support {missing}"
    footprints = attrs.evolve(problem(grid(1, 2), [0], [1]), features={Feature.FOOTPRINTS})
    assert Example().skip(footprints) == "does not support footprints"


def test_a_problem_without_robots_is_solved():
    result = Example().plan(problem(grid(1, 2), [], []), AMPLE)
    assert result.status is PlanStatus.SOLVED
    assert len(result.plan.paths) == 0
