"""Which goals of their sequences robots visit on their way."""

import numpy as np

from mrpbench_core.model.common.arrays import Int, Int32
from mrpbench_core.model.planning.problem import GoalSet, Problem


def advance(sequence: tuple[GoalSet, ...], visited: int, vertex: int) -> int:
    """Return how many leading goals a robot has visited once it is at `vertex`, where it had visited so many before.

    One visit counts for equal goals in a row.
    """
    while visited < len(sequence) and vertex in sequence[visited]:
        visited += 1
    return visited


def left(sequence: tuple[GoalSet, ...], visited: int) -> tuple[GoalSet, ...]:
    """Return what is left of a sequence after so many goals; the last one stays."""
    return sequence[min(visited, max(len(sequence) - 1, 0)) :]


def visited_goals(problem: Problem, robot: Int, head: Int | Int32) -> dict[int, int]:
    """Return how many leading goals of their sequences robots visit, of those with several.

    Args:
        problem: with their goals and starts.
        robot: i8[m] the robot of each move, in ascending order, those of a robot in the order of its path.
        head: i4[m] or i8[m] vertex at the end of each move.
    """
    visits: dict[int, int] = {}
    if max(map(len, problem.goals), default=0) < 2:
        return visits
    first = np.searchsorted(robot, np.arange(len(problem) + 1)).tolist()
    for index, sequence in enumerate(problem.goals):
        if len(sequence) > 1:
            visits[index] = 0
            for vertex in (int(problem.start[index]), *head[first[index] : first[index + 1]].tolist()):
                visits[index] = advance(sequence, visits[index], vertex)
    return visits
