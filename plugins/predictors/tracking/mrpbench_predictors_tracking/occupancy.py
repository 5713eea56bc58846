"""Predicted occupancy as constraints of a problem that hold for a time: robots that are committed to be there.

Each place of the roadmap gets a vertex beside it that no other robot can reach. A further robot comes from there when
an object is predicted at the place, and returns afterwards. Its path is committed, so that every planner that keeps
commitments keeps away from it, and the definition of conflicts applies as it stands.
"""

from collections.abc import Iterator
from itertools import groupby
from typing import NamedTuple

import attrs
import numpy as np

from mrpbench_core.api.predictor import Prediction
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.common.geometry import segment_distance
from mrpbench_core.model.planning.plan import Paths, RobotPath
from mrpbench_core.model.planning.problem import Feature, Problem, ends_of, features_of
from mrpbench_core.model.planning.roadmap import Roadmap

RADIUS = 1e-6
"""Metres, of the further robots: what they exclude is the place itself, as it is chosen by the radii of both."""


class Stay(NamedTuple):
    """A time in which an object is predicted at a place."""

    place: int
    begin: int
    """ticks."""
    end: int


class Occupancy:
    """Adds predicted occupancy to problems; keeps the last roadmap with the vertices that it needs."""

    def __init__(self) -> None:
        self._roadmap: Roadmap | None = None
        self._wider: Roadmap | None = None
        self._places: Int = np.zeros(0, np.int64)

    def constrained(self, problem: Problem, prediction: Prediction, now: float) -> Problem:
        """Return the problem with one more robot for each place at which objects are predicted.

        A constraint that contradicts what robots are committed to, or that holds where they are then, is left out, and
        so are those at doors, in lifts and in mutexes, which robots use one at a time, whatever people do.

        Args:
            problem: of the robots.
            prediction: of objects, from `now` on.
            now: simulated seconds, on the clock whose zero is tick 0.
        """
        self._widen(problem)
        stays = list(self._stays(problem, prediction, now))
        stays = [stay for stay, free in zip(stays, self._free(problem, stays), strict=True) if free]
        if not stays:
            return problem
        assert self._wider is not None
        vertices, edges = len(problem.roadmap.position), len(problem.roadmap.edges)
        paths, starts, begins = [], [], []
        for place, visits in groupby(stays, key=lambda stay: stay.place):
            path = _path(list(visits), edges + 2 * place, None if problem.since.any() else 0)
            paths.append(path)
            starts.append(vertices + place)
            begins.append(int(path.enter[0]))
        count = len(paths)
        wider = attrs.evolve(
            problem,
            roadmap=self._wider,
            profile=np.append(problem.profile, np.full(count, len(problem.roadmap.duration))),
            radius=np.append(problem.radius, np.full(count, RADIUS)),
            start=np.append(problem.start, starts),
            ready=np.append(problem.ready, begins),
            since=np.append(problem.since, begins) if len(problem.since) else problem.since,
            goals=(*problem.goals, *(((start,),) for start in starts)),
            commitments=Paths.of([*(problem.commitments or [_EMPTY] * len(problem)), *paths]),
            remaining=(),
        )
        return attrs.evolve(wider, features=features_of(wider) | (problem.features & {Feature.FOOTPRINTS}))

    def _widen(self, problem: Problem) -> None:
        """Give the roadmap a vertex beside each place, and edges there and back that take a tick."""
        roadmap = problem.roadmap
        if roadmap is self._roadmap:
            return
        # With footprints, whatever is at a place excludes what else is there.
        everything = np.arange(len(roadmap.position))
        places = roadmap.distinct if Feature.FOOTPRINTS in problem.features else everything
        beside = len(everything) + np.arange(len(places))
        count = len(places)
        nowhere = int(roadmap.level.max(initial=0)) + 1
        own = np.stack([np.column_stack([beside, places]), np.column_stack([places, beside])], axis=1).reshape(-1, 2)
        forbidden = np.full((len(roadmap.duration), 2 * count), -1)
        ours = np.append(np.full(len(roadmap.edges), -1), np.ones(2 * count, int))
        self._roadmap, self._places = roadmap, places
        self._wider = attrs.evolve(
            roadmap,
            position=np.vstack([roadmap.position, roadmap.position[places]]),
            level=np.append(roadmap.level, np.full(count, nowhere)),
            heading=np.append(roadmap.heading, np.full(count, np.nan)),
            edges=np.vstack([roadmap.edges, own]),
            duration=np.vstack([np.hstack([roadmap.duration, forbidden]), ours]),
            grid=None,
        )

    def _stays(self, problem: Problem, prediction: Prediction, now: float) -> Iterator[Stay]:
        """The times at which objects are so near to a place that a robot there would touch one, place by place."""
        roadmap = problem.roadmap
        position = roadmap.position[self._places]
        reach = prediction.radius + float(problem.radius.max(initial=0.0))
        times = prediction.place.shape[1]
        met: Bool = np.zeros((len(position), times), bool)
        for place, distance in zip(prediction.place, reach, strict=True):
            low, high = place.min(axis=0) - distance, place.max(axis=0) + distance
            near = np.flatnonzero(((position >= low) & (position <= high)).all(axis=1))
            met[near] |= np.hypot(*(position[near, None] - place).transpose(2, 0, 1)) < distance
        met[np.isin(self._places, [vertex for resource in roadmap.resources for vertex in resource.vertices])] = False
        last = np.iinfo(np.int64).max if problem.horizon is None else problem.horizon - 1
        first = int(problem.begins.min()) + 1
        now_ticks, per_step = now / roadmap.tick, prediction.step / roadmap.tick
        for index in np.flatnonzero(met.any(axis=1)).tolist():
            ticks = np.floor(now_ticks + np.flatnonzero(met[index]) * per_step + 1e-9).astype(np.int64)
            # It takes a tick to leave, and one to come again.
            for visit in np.split(ticks, np.flatnonzero(np.diff(ticks) > 3) + 1):
                begin, end = max(int(visit[0]), first), min(int(visit[-1]) + 1, last)
                if begin < end:
                    yield Stay(index, begin, end)

    def _free(self, problem: Problem, stays: list[Stay]) -> Bool:
        """Tell bool[k] which stays meet no robot on the way that it is committed to, or where that ends."""
        free = np.ones(len(stays), bool)
        if not stays:
            return free
        roadmap, paths = problem.roadmap, Paths.of(problem.commitments or [_EMPTY] * len(problem))
        visited = paths.vertices(roadmap, problem.start)
        row = np.arange(len(paths.edge)) + paths.robot  # of `visited`, which has one more for each robot
        ends = paths.first[1:] + np.arange(len(problem))
        tail, head = np.append(visited[row], visited[ends]), np.append(visited[row + 1], visited[ends])
        enter = np.append(paths.enter, np.array(ends_of(problem)))
        leave = np.append(paths.leave, np.full(len(problem), np.iinfo(np.int64).max - 10**6))
        radius = np.append(problem.radius[paths.robot], problem.radius)
        late = problem.rules.k
        for index, stay in enumerate(stays):
            meets = (enter <= stay.end + 1 + late) & (leave + late >= stay.begin - 1)
            place = np.broadcast_to(roadmap.position[self._places[stay.place]], (int(meets.sum()), 2))
            ways: Float = segment_distance(place, place, roadmap.position[tail[meets]], roadmap.position[head[meets]])
            free[index] = not (ways < radius[meets] + 2 * RADIUS).any()
        return free


_EMPTY = RobotPath(edge=np.empty(0, np.int32), enter=np.empty(0, np.int64), leave=np.empty(0, np.int64))


def _path(stays: list[Stay], there: int, begin: int | None) -> RobotPath:
    """Come by the edge `there` at the begin of each stay, leave by the next edge at its end, and wait in between.

    The path begins at the tick `begin`, or one before the first stay.
    """
    rows: list[tuple[int, int, int]] = []
    at = stays[0].begin - 1 if begin is None else begin
    for stay in stays:
        rows += [(-1, at, stay.begin - 1)] if at < stay.begin - 1 else []
        rows += [(there, stay.begin - 1, stay.begin), (-1, stay.begin, stay.end), (there + 1, stay.end, stay.end + 1)]
        at = stay.end + 1
    edge, enter, leave = np.array(rows).T
    return RobotPath(edge=edge, enter=enter, leave=leave)
