"""Robots that would meet if they drove alone, on a straight aisle."""

import math

import attrs
import numpy as np
import pytest
from mrpbench_search.hunting.cases import Case
from mrpbench_search.hunting.meetings import drives, meetings
from mrpbench_search.hunting.space import Space, _kinds, _ways

from mrpbench_core.model.planning.scenario import Scenario, Task

LENGTH, INF = 9, math.inf
POSITION = np.array([(float(x), 0.0) for x in range(LENGTH)] + [(float(x), 5.0) for x in range(LENGTH)])
EDGES = np.array(
    [edge for row in (0, LENGTH) for x in range(row, row + LENGTH - 1) for edge in ((x, x + 1), (x + 1, x))]
)
ROADMAP = {
    "position": POSITION,
    "level": np.zeros(2 * LENGTH, np.int16),
    "edges": EDGES,
    "duration": np.full((1, len(EDGES)), 2),
}


def case_of(*ways):
    """Robots from one vertex to another."""
    start = [(*POSITION[one], np.nan) for one, _ in ways]
    tasks = tuple(Task(goals=[(*POSITION[other], np.nan)]) for _, other in ways)
    return Case(scenario=Scenario(start=start, start_level=[0] * len(ways), tasks=tasks), seed=0)


SPACE = Space(
    scenarios=(case_of((0, 1)).scenario,),
    streams=None,
    position=POSITION,
    level=ROADMAP["level"],
    vertex_position=POSITION,
    kinds=_kinds(EDGES, len(POSITION), []),
    room=0.5,
    tick=0.5,
    **_ways(ROADMAP, POSITION, ROADMAP["level"]),
)


@pytest.mark.parametrize(
    ("ways", "gaps"),
    [
        ([(0, 8), (8, 0)], [0]),  # head on, in the middle at the same time
        ([(0, 8), (7, 0)], [1]),  # head on, half an edge from a vertex
        ([(0, 7), (3, 8)], [3]),  # one after the other
        ([(0, 8), (9, 17)], []),  # in different aisles
        ([(0, 8), (8, 0), (4, 5)], [0, 0, 0]),  # the third robot stands where the others come later
        ([(0, 8), (4, 4)], [0]),  # through the goal of a robot that stands there
        ([(0, 3), (8, 4)], []),
        ([(0, 4), (5, 8)], []),
        ([(1, 8), (0, 3)], [1]),
    ],
)
def test_the_least_gaps_of_pairs_count(ways, gaps):
    assert meetings(SPACE, case_of(*ways)) == pytest.approx(sum(math.exp(-gap) for gap in gaps))


def over_time(starts, tasks):
    """Robots at vertices, and tasks as (release in seconds, vertex, seconds of service)."""
    case = case_of(*((start, start) for start in starts))
    stream = tuple(Task(goals=[(*POSITION[goal], np.nan)], release=at, service=[rest]) for at, goal, rest in tasks)
    return attrs.evolve(case, scenario=attrs.evolve(case.scenario, tasks=()), stream=stream)


@pytest.mark.parametrize(
    ("starts", "tasks", "drives_of"),
    [
        (
            [0, 8],
            [(0, 2, 0), (0, 6, 0)],
            [[{0: (0, 0), 1: (2, 2), 2: (4, INF)}], [{8: (0, 0), 7: (2, 2), 6: (4, INF)}]],
        ),
        ([0, 8], [(3, 1, 0)], [[{0: (0, 6), 1: (8, INF)}], [{8: (0, INF)}]]),  # a tick is half a second
        ([0, 8], [(0, 1, 2), (1, 2, 0)], [[{0: (0, 0), 1: (2, 6)}, {1: (6, 6), 2: (8, INF)}], [{8: (0, INF)}]]),
        ([0, 4], [(0, 1, 20), (1, 2, 0)], [[{0: (0, 0), 1: (2, INF)}], [{4: (0, 2), 3: (4, 4), 2: (6, INF)}]]),
        ([4], [(0, 4, 1), (9, 13, 0)], [[{4: (0, INF)}]]),  # no robot comes to the other aisle
    ],
)
def test_tasks_over_time_are_done_by_the_robot_that_is_there_first(starts, tasks, drives_of):
    assert drives(SPACE, over_time(starts, tasks)) == drives_of


def test_tasks_over_time_that_bring_robots_together_count_more():
    apart = over_time([0, 8], [(0, 1, 0), (0, 7, 0)])
    together = over_time([0, 8], [(0, 5, 20), (0, 6, 0)])
    later = over_time([0, 8], [(0, 4, 0), (90, 3, 0)])
    assert meetings(SPACE, apart) == 0
    assert meetings(SPACE, together) == 1
    assert meetings(SPACE, later) == 0


def test_a_robot_that_cannot_reach_its_goal_stands_at_its_start():
    assert meetings(SPACE, case_of((0, 17), (8, 0))) == 1
    assert meetings(SPACE, case_of((0, 17), (8, 1))) == 0
