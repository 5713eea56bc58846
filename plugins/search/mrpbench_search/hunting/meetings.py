"""How much robots of a case would meet if each of them drove alone, from the roadmap and without a run."""

from collections.abc import Sequence
from itertools import combinations, product

import numpy as np

from mrpbench_core.model.planning.scenario import Task
from mrpbench_search.hunting.cases import Case
from mrpbench_search.hunting.space import Space


def meetings(space: Space, case: Case) -> float:
    """Return the sum over pairs of robots of exp(-gap): the least time between their visits of one vertex.

    The gap is in durations of an edge; a robot stays at its last goal. A pair that shares no vertex adds 0. A task over
    time is done by the robot that would come to it first.
    """
    step = float(np.median(space.ways.data)) if space.ways.nnz else 1.0
    total = 0.0
    for one, other in combinations(_drives(space, case), 2):
        gaps = [
            max(0.0, first[0] - second[1], second[0] - first[1])
            for vertex in one.visits.keys() & other.visits.keys()
            for first, second in product(one.visits[vertex], other.visits[vertex])
        ]
        total += float(np.exp(-min(gaps) / step)) if gaps else 0.0
    return total


class _Drive:
    """The drive of one robot that never waits for another one."""

    def __init__(self, space: Space, place: int) -> None:
        self.space, self.place, self.ticks = space, place, 0.0
        self.visits: dict[int, list[tuple[float, float]]] = {}
        """When it comes to each vertex, and when it leaves it, ticks."""

    def arrival(self, task: Task) -> float:
        """Ticks at which it would come to the first goal of a task over time."""
        distance = self.space.distance[self.place, self.space.vertex[_places(self.space, task)[0]]]
        return max(self.ticks, task.release / self.space.tick) + float(distance)

    def add(self, task: Task) -> None:
        """Drive to the goals of a task, as far as there is a way."""
        self.ticks = max(self.ticks, task.release / self.space.tick)
        for place in _places(self.space, task):
            times = _times(self.space, self.place, int(self.space.vertex[place]))
            for vertex, after in times.items():
                self.visits.setdefault(vertex, []).append((self.ticks + after, self.ticks + after))
            if times:
                self.place, self.ticks = place, self.ticks + max(times.values())

    def stay(self) -> None:
        """Stay at the last goal."""
        if self.visits:
            self.visits[int(self.space.vertex[self.place])][-1] = (self.ticks, np.inf)


def _drives(space: Space, case: Case) -> list[_Drive]:
    starts = zip(case.scenario.start[:, :2].tolist(), case.scenario.start_level.tolist(), strict=True)
    drives = [_Drive(space, space.place_of(*position, level)) for position, level in starts]
    if case.stream is None:
        for drive, task in zip(drives, case.tasks, strict=False):
            drive.add(task)
    for task in case.stream or ():
        min(drives, key=lambda drive: drive.arrival(task)).add(task)
    for drive in drives:
        drive.stay()
    return drives


def _places(space: Space, task: Task) -> Sequence[int]:
    goals = zip(task.goals[:, :2].tolist(), task.levels.tolist(), strict=True)
    return [space.place_of(*position, level) for position, level in goals]


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
