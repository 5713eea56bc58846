"""How much robots of a case would meet if each of them drove alone, from the roadmap and without a run."""

from itertools import islice

import numpy as np

from mrpbench_search.hunting.cases import Case
from mrpbench_search.hunting.space import Space

FAR = 10.0
"""Durations of an edge: drives with more time between them do not count."""
Drive = dict[int, tuple[float, float]]
"""The ticks at which a robot comes to each vertex of a way and leaves it."""


def meetings(space: Space, case: Case) -> float:
    """Return the sum over pairs of drives of two robots of exp(-gap): the least time between them at one vertex.

    The gap is in durations of an edge, and 0 if one of them is there while the other one comes. A pair that shares no
    vertex adds 0. A robot stands at its start until its first drive, and at its last goal until the end.
    """
    step = float(np.median(space.ways.data)) if space.ways.nnz else 1.0
    found = [
        (min(come for come, _ in drive.values()), max(leave for _, leave in drive.values()), robot, drive)
        for robot, own in enumerate(drives(space, case))
        for drive in own
    ]
    found.sort(key=lambda it: it[0])
    total = 0.0
    for place, (_, end, robot, one) in enumerate(found):
        for begin, _, rival, other in islice(found, place + 1, None):
            if begin > end + FAR * step:
                break
            shared = one.keys() & other.keys() if rival != robot else ()
            gaps = [max(0.0, one[v][0] - other[v][1], other[v][0] - one[v][1]) for v in shared]
            total += float(np.exp(-min(gaps) / step)) if gaps else 0.0
    return total


def drives(space: Space, case: Case) -> list[list[Drive]]:
    """Return the drives of each robot from one goal to the next, as if it were alone.

    Tasks over time are done in the order of their release, each by the robot that can be at its first goal first.
    """
    starts = zip(case.scenario.start, case.scenario.start_level.tolist(), strict=True)
    at = np.array([space.place_of(*start) for start in starts], np.int64)
    free = np.zeros(case.robots)
    found: list[list[Drive]] = [[] for _ in range(case.robots)]
    for index, task in enumerate(case.tasks if case.stream is not None else case.tasks[: case.robots]):
        rows = np.unique(task.errand, return_index=True)[1].tolist()  # the first place of each errand
        goals = [space.place_of(task.goals[row], int(task.levels[row])) for row in rows]
        robot, release = index, 0.0
        if case.stream is not None:
            release = task.release / space.tick
            robot = int((np.maximum(free, release) + space.distance[at, space.vertex[goals[0]]]).argmin())
        for goal, service in zip(goals, (task.service / space.tick).tolist(), strict=True):
            since, leave = float(free[robot]), max(float(free[robot]), release)
            way = _way(space, int(at[robot]), int(space.vertex[goal]))
            if not way:
                break
            drive = {vertex: (leave + ticks, leave + ticks) for vertex, ticks in way.items()}
            come = max(way.values()) + leave
            drive[int(space.vertex[at[robot]])] = since, leave
            drive[int(space.vertex[goal])] = (since if len(way) == 1 else come), come + service
            found[robot].append(drive)
            at[robot], free[robot] = goal, come + service
    for own, place in zip(found, at.tolist(), strict=True):
        vertex = int(space.vertex[place])
        if not own:
            own.append({vertex: (0.0, 0.0)})
        own[-1][vertex] = own[-1][vertex][0], np.inf
    return found


def _way(space: Space, start: int, vertex: int) -> dict[int, float]:
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
