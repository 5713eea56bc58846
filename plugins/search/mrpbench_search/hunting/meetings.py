"""How much robots of a case would meet if each of them drove alone, from the roadmap and without a run."""

from itertools import combinations

import numpy as np

from mrpbench_search.hunting.cases import Case
from mrpbench_search.hunting.space import Space


def meetings(space: Space, case: Case) -> float:
    """Return the sum over pairs of robots of exp(-gap): the least time between them at a vertex that both pass.

    The gap is in durations of an edge. A pair that shares no vertex adds 0, and so do all pairs where tasks come over
    time, as it is not known which robot does them.
    """
    if case.stream is not None:
        return 0.0
    times = []
    for robot, task in enumerate(case.tasks[: case.robots]):
        x, y = case.scenario.start[robot, :2].tolist()
        goal_x, goal_y = task.goals[0, :2].tolist()
        start = space.place_of(x, y, int(case.scenario.start_level[robot]))
        goal = space.place_of(goal_x, goal_y, int(task.levels[0]))
        times.append(_times(space, start, int(space.vertex[goal])))
    step = float(np.median(space.ways.data)) if space.ways.nnz else 1.0
    total = 0.0
    for one, other in combinations(times, 2):
        gaps = [abs(one[vertex] - other[vertex]) for vertex in one.keys() & other.keys()]
        total += float(np.exp(-min(gaps) / step)) if gaps else 0.0
    return total


def _times(space: Space, start: int, vertex: int) -> dict[int, float]:
    """Ticks at which a robot passes each vertex of a shortest way from a place to a vertex; empty if there is none."""
    distance = space.distance[start]
    if not np.isfinite(distance[vertex]):
        return {}
    passed = {vertex: float(distance[vertex])}
    while distance[vertex] > 0:
        first, last = space.back.indptr[vertex : vertex + 2]
        before = space.back.indices[first:last]
        vertex = int(before[np.argmin(distance[before] + space.back.data[first:last])])
        passed[vertex] = float(distance[vertex])
    return passed
