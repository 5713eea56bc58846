"""Robots that would meet if they drove alone, on a straight aisle."""

import math

import attrs
import numpy as np
import pytest
from mrpbench_search.hunting.cases import Case
from mrpbench_search.hunting.meetings import meetings
from mrpbench_search.hunting.space import Space, _kinds, _ways

from mrpbench_core.model.planning.scenario import Scenario, Task

LENGTH = 9
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
    tick=1.0,
    **_ways(ROADMAP, POSITION, ROADMAP["level"]),
)


@pytest.mark.parametrize(
    ("ways", "gaps"),
    [
        ([(0, 8), (8, 0)], [0]),  # head on, in the middle at the same time
        ([(0, 8), (7, 0)], [1]),  # head on, half an edge from a vertex
        ([(0, 7), (3, 8)], [3]),  # one after the other
        ([(0, 8), (3, 6)], [0]),  # the goal of one lies on the way of the other one
        ([(0, 8), (9, 17)], []),  # in different aisles
        ([(0, 8), (8, 0), (4, 5)], [0, 0, 0]),
    ],
)
def test_the_least_gaps_of_pairs_count(ways, gaps):
    assert meetings(SPACE, case_of(*ways)) == pytest.approx(sum(math.exp(-gap) for gap in gaps))


def over_time(*goals):
    """Two robots at the ends of an aisle, and tasks: when each is released, and its goals."""
    tasks = [
        Task(goals=[(*POSITION[goal], np.nan) for goal in each], levels=[0] * len(each), release=release, index=index)
        for index, (release, each) in enumerate(goals)
    ]
    return attrs.evolve(case_of((0, 0), (8, 8)), stream=tuple(tasks))


def test_a_task_over_time_is_done_by_the_robot_that_comes_to_it_first():
    assert meetings(SPACE, over_time((0, [1]), (0, [7]))) == 0.0
    assert meetings(SPACE, over_time((0, [1, 5]), (0, [7, 4]))) == 1.0  # one stays at 5, on the way of the other one
    late = over_time((0, [3]), (100, [2]))  # the robot at 3 is nearer than the one at 8
    assert meetings(SPACE, late) == 0.0


def test_tasks_over_time_that_cannot_be_done_at_the_same_time_meet_less():
    near = meetings(SPACE, over_time((0, [3, 0]), (0, [5, 2])))
    assert near > meetings(SPACE, over_time((0, [3, 0]), (60, [5, 2]))) > 0


def test_a_goal_that_cannot_be_reached_meets_no_robot():
    assert meetings(SPACE, case_of((0, 17), (8, 0))) == 0.0
