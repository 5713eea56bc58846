"""Cost matrices against sums computed by hand and a plain Dijkstra search."""

import heapq
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_tests.instances.problems import grid_of

from mrpbench_core.engine.prepare.costs import cost_matrix
from mrpbench_core.engine.travel import travel_ticks
from mrpbench_core.model.common.fleet import Fleet, RobotModel
from mrpbench_core.model.planning.assignment import AssignmentProblem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario, Task

SQUARE = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]]
SLOW = RobotModel(name="slow", footprint=SQUARE, max_speed=0.5, max_turn_rate=1.0)
FAST = RobotModel(name="fast", footprint=SQUARE, max_speed=1.0, max_turn_rate=1.0)


def scenario(starts, *tasks):
    return Scenario(
        start=[(x, y, np.nan) for x, y in starts],
        start_level=[0] * len(starts),
        tasks=tuple(Task(goals=[(x, y, np.nan) for x, y in goals], levels=[0] * len(goals)) for goals in tasks),
    )


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), kind=st.sampled_from(["euclidean", "manhattan", "roadmap"]))
def test_of_several_places_those_count_that_make_the_whole_cheapest(seed, kind):
    random = np.random.default_rng(seed)
    road = grid_of(["".join(random.choice([".", "#"], 4, p=[0.8, 0.2])) for _ in range(3)] + ["...."])
    pose = np.column_stack([road.position, np.full(len(road.position), np.nan)])
    sets = [random.integers(len(pose), size=random.integers(1, 4)).tolist() for _ in range(random.integers(1, 4))]
    errand = np.repeat(np.arange(len(sets)), [len(places) for places in sets])
    whole = Task(goals=pose[np.concatenate(sets)], errand=errand, levels=np.zeros(len(errand), np.int16))
    choices = [Task(goals=pose[[*way]], levels=[0] * len(way)) for way in product(*sets)]
    drawn = Scenario(start=pose[:2], start_level=[0, 0], tasks=(whole, *choices))
    costs = cost_matrix(kind, road, Fleet(robots=(SLOW, SLOW)), drawn)
    assert costs[:, 0] == pytest.approx(costs[:, 1:].min(axis=1))


@pytest.fixture
def triangle() -> Roadmap:
    """A one-way ring 0 -> 1 -> 2 -> 0 and, for the first profile only, a short cut 0 -> 2."""
    return Roadmap(
        position=[[0, 0], [4, 0], [0, 3]],
        level=[0, 0, 0],
        heading=[np.nan] * 3,
        edges=[[0, 1], [1, 2], [2, 0], [0, 2]],
        duration=[[4, 5, 3, 20], [2, 3, 2, -1]],
        tick=0.5,
    )


def test_straight_lines_go_through_all_goals_of_a_task(triangle):
    drawn = scenario([(0, 0), (0, 3)], [(4, 0)], [(4, 0), (0, 3)])
    fleet = Fleet(robots=(SLOW, SLOW))
    assert cost_matrix("euclidean", triangle, fleet, drawn) == pytest.approx(np.array([[4, 4 + 5], [5, 5 + 5]]))
    assert cost_matrix("manhattan", triangle, fleet, drawn) == pytest.approx(np.array([[4, 4 + 7], [7, 7 + 7]]))


def test_travel_times_are_seconds_of_each_robots_own_profile(triangle):
    drawn = scenario([(0, 0), (0, 0)], [(0, 3)], [(4, 0), (0, 0)])
    costs = cost_matrix("roadmap", triangle, Fleet(robots=(SLOW, FAST)), drawn)
    assert costs.tolist() == [[4.5, 6.0], [2.5, 3.5]]  # ticks (4+5, 4+5+3), (2+3, 2+3+2)


def test_the_cost_of_an_unreachable_goal_is_infinite(corridor):
    one_way = Roadmap(
        position=corridor.position,
        level=corridor.level,
        heading=corridor.heading,
        edges=[[0, 1], [1, 2]],
        duration=[[1, 1]],
        tick=2.0,
        grid=corridor.grid,
    )
    drawn = scenario([(0.5, 0.5), (2.5, 0.5), (9, 9)], [(1.5, 0.5)], [(7, 7)], [(2.5, 0.5), (0.5, 0.5)])
    costs = cost_matrix("roadmap", one_way, Fleet(robots=(SLOW,) * 3), drawn)
    assert costs.tolist() == [[2, np.inf, np.inf], [np.inf] * 3, [np.inf] * 3]


@pytest.mark.parametrize("kind", ["euclidean", "manhattan", "roadmap"])
def test_no_robots_or_no_tasks_give_an_empty_matrix(corridor, kind):
    assert cost_matrix(kind, corridor, Fleet(robots=(SLOW,)), scenario([(0.5, 0.5)])).shape == (1, 0)
    empty = Scenario(start=np.empty((0, 3)), start_level=[], tasks=(Task(goals=[[0.5, 0.5, 0.0]]),))
    assert cost_matrix(kind, corridor, Fleet(robots=()), empty).shape == (0, 1)


def dijkstra(count, arcs, source):
    """Ticks from `source` to every vertex, the plain way."""
    distance = {source: 0}
    queue = [(0, source)]
    while queue:
        so_far, vertex = heapq.heappop(queue)
        if so_far > distance[vertex]:
            continue
        for tail, head, ticks in arcs:
            if tail == vertex and ticks >= 0 and so_far + ticks < distance.get(head, np.inf):
                distance[head] = so_far + ticks
                heapq.heappush(queue, (so_far + ticks, head))
    return [distance.get(vertex, np.inf) for vertex in range(count)]


ARCS = st.integers(1, 7).flatmap(
    lambda count: st.tuples(
        st.just(count),
        st.lists(
            st.tuples(st.integers(0, count - 1), st.integers(0, count - 1), st.integers(-1, 6)), min_size=1, max_size=20
        ),
    )
)


@settings(deadline=None, max_examples=200)
@given(graph=ARCS, together=st.sampled_from([1, 2**24]))
def test_travel_times_are_those_of_dijkstra(graph, together):
    count, arcs = graph
    roadmap = Roadmap(
        position=np.zeros((count, 2)),
        level=[0] * count,
        heading=[np.nan] * count,
        edges=[(tail, head) for tail, head, _ in arcs],
        duration=[[ticks for _, _, ticks in arcs]],
        tick=1.0,
    )
    everyone = range(count)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("mrpbench_core.engine.travel.STATES", together)
        ticks = travel_ticks(roadmap, 0, everyone, everyone)
    assert ticks.T.tolist() == [dijkstra(count, arcs, source) for source in everyone]


@pytest.mark.parametrize("kind", ["euclidean", "manhattan", "roadmap"])
def test_the_problem_of_an_assigner_holds_no_copy_of_the_matrix(kind):
    road = grid_of(["..."])
    there = [tuple(place) for place in road.position.tolist()]
    costs = cost_matrix(kind, road, Fleet(robots=(SLOW, SLOW)), scenario(there[:2], there[1:2], there[2:]))
    assert AssignmentProblem(costs=costs).costs is costs
