"""Plans as messages: what blocks whom."""

import attrs
import numpy as np
import pytest
from mrpbench_live.rmf.traffic.posting import blockers_of, waypoints_of

from mrpbench_core.api import DispatchError, Feature, Plan, Problem, Roadmap, RobotPath
from mrpbench_core.model.planning.occupations import occupations_of, resource_edges
from mrpbench_core.model.planning.type2_edges import moves_of, type2_edges

SQUARE = Roadmap(  # 0 - 1 - 2 - 3 on a line, and 4 above 1, 5 above 2
    position=[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0), (1.0, 1.0), (2.0, 1.0)],
    level=[0] * 6,
    heading=np.full(6, np.nan),
    edges=[(0, 1), (1, 2), (2, 3), (4, 1), (1, 4), (5, 2), (2, 5), (1, 0), (4, 5)],
    duration=[[1] * 9],
    tick=1.0,
)


def path(*segments):
    """Edges, or None for a wait, each for one tick."""
    edge = [-1 if it is None else SQUARE.edges.tolist().index(list(it)) for it in segments]
    return RobotPath(edge=edge, enter=np.arange(len(edge)), leave=np.arange(len(edge)) + 1)


def problem(*starts, radius=0.3, features=frozenset()):
    count = len(starts)
    return Problem(
        roadmap=SQUARE,
        profile=[0] * count,
        radius=[radius] * count,
        start=list(starts),
        ready=[0] * count,
        goals=((),) * count,
        features=features,
    )


FIRST, SECOND = path((0, 1), (1, 2), (2, 3)), path(None, None, (4, 1), (1, 0))
NOTHING = np.zeros(2, np.int64)


def test_waypoints_are_where_a_robot_is_and_the_ends_of_its_moves():
    plan = Plan(paths=[FIRST, SECOND])
    first, second = waypoints_of(problem(0, 4), plan, np.array([1, 0]))
    assert (first.segments.tolist(), first.vertex.tolist()) == ([1, 2, 3], [1, 2, 3])
    assert (second.segments.tolist(), second.vertex.tolist()) == ([0, 3, 4], [4, 1, 0])
    assert [second.last(segments) for segments in range(5)] == [0, 0, 0, 1, 2]


def test_who_comes_later_waits_until_the_other_is_out_of_the_way():
    asked, plan = problem(0, 4), Plan(paths=[FIRST, SECOND])
    found = blockers_of(asked, plan, waypoints_of(asked, plan, NOTHING), NOTHING, NOTHING)
    assert found == [{}, {0: {0: 2}}]  # at the vertex after that which they share


def test_wide_robots_have_to_be_farther_away():
    asked = problem(0, 4, radius=0.6)
    plan = Plan(paths=[FIRST, SECOND])
    found = blockers_of(asked, plan, waypoints_of(asked, plan, NOTHING), NOTHING, NOTHING)
    assert found == [{}, {0: {0: 3}}]  # 1 m from the shared vertex is less than 1.2 m


def test_blockers_are_counted_from_where_a_plan_begins():
    asked, plan = problem(0, 4), Plan(paths=[FIRST, SECOND])
    reached = np.array([1, 0])
    assert blockers_of(asked, plan, waypoints_of(asked, plan, reached), reached, reached) == [{}, {0: {0: 1}}]


def test_what_is_released_has_no_blockers():
    asked, plan = problem(0, 4), Plan(paths=[FIRST, SECOND])
    waypoints = waypoints_of(asked, plan, NOTHING)
    assert blockers_of(asked, plan, waypoints, NOTHING, np.array([0, 3])) == [{}, {}]


def test_a_rotation_is_refused():
    starts, moves = (1, 2, 5, 4), [(1, 2), (2, 5), None, (4, 1)]
    back = attrs.evolve(SQUARE, edges=[*SQUARE.edges.tolist(), (5, 4)], duration=[[1] * 10])
    asked = attrs.evolve(problem(*starts, features=frozenset({Feature.COMMITMENTS})), roadmap=back)
    turning = RobotPath(edge=[9], enter=[0], leave=[1])
    plan = Plan(paths=[turning if move is None else path(move) for move in moves])
    nothing = np.zeros(4, np.int64)
    with pytest.raises(DispatchError, match="robots 0, 1, 2, 3 rotate"):
        blockers_of(asked, plan, waypoints_of(asked, plan, nothing), nothing, nothing)


@pytest.mark.parametrize("seed", range(20))
def test_blockers_are_those_of_the_order_of_the_plan_edge_by_edge(seed):
    draws = np.random.default_rng(seed)
    robots, radius = 4, draws.uniform(0.2, 0.8)
    asked = problem(*draws.choice(6, robots, replace=False).tolist(), radius=radius)
    plan = Plan(paths=[path(*steps) for steps in zip(*wander(asked.start.tolist(), draws), strict=True)])
    begun = draws.integers(0, 3, robots)
    waypoints = waypoints_of(asked, plan, begun)
    moves = moves_of(asked, plan)
    order = type2_edges(asked, moves, resource_edges(asked, occupations_of(asked, moves)))
    place, expected = SQUARE.position, [{} for _ in range(robots)]
    for before, after, completed in zip(*(column.tolist() for column in order), strict=True):
        robot, other, segment = moves.robot[after], moves.robot[before], moves.segment[after]
        ways = waypoints[other]
        enough = [
            at
            for at, (over, vertex) in enumerate(zip(ways.segments, ways.vertex, strict=True))
            if over > moves.segment[before]
            and (completed or np.linalg.norm(place[vertex] - place[moves.tail[before]]) >= 2 * radius)
        ]
        required = enough[0] if enough else len(ways.vertex) - 1
        if segment >= begun[robot] and required:
            others = expected[robot].setdefault(waypoints[robot].last(segment), {})
            others[other] = max(others.get(other, 0), required)
    assert blockers_of(asked, plan, waypoints, begun, NOTHING.repeat(2)) == expected


def wander(at, draws):
    """Eight steps of robots, each an edge to a vertex that is free before and after it, or None."""
    for _ in range(8):
        taken, step = set(at), []
        for robot, here in enumerate(at):
            free = [head for tail, head in SQUARE.edges.tolist() if tail == here and head not in taken]
            if free and draws.random() < 0.7:
                at = [*at[:robot], int(draws.choice(free)), *at[robot + 1 :]]
                taken.add(at[robot])
            step.append((here, at[robot]) if at[robot] != here else None)
        yield step
