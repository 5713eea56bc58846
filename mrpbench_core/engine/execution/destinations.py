"""Where robots go next: to their errands, else out of the way.

Planners for one batch need goals at which all robots can stand at the same time. Of errands that exclude one another,
only the most important one is a goal then. An errand with several places has room if one of them has.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Literal

import attrs
import numpy as np

from mrpbench_core.engine.execution.resting_places import Neighbourhoods, RestingPlaces
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_core.model.planning.problem import Goals, GoalSet, Problem
from mrpbench_core.model.planning.type2_edges import Moves

STRIDE = 7919
"""A prime, by which places are taken one after another."""
Parking = Literal["stay", "home"]
Errands = tuple[tuple[int, int], ...]
"""Tasks and numbers of errands of them, in order."""


@attrs.frozen
class Errand:
    """An errand of a robot."""

    robot: int
    task: int
    number: int
    yaws: Mapping[int, float]
    """radians wanted at each vertex that will do, NaN = any; in a plan the nearest vertex comes first."""

    def at(self, vertices: Iterable[int]) -> "Errand":
        """Return the errand at some of its vertices, in this order."""
        return attrs.evolve(self, yaws={vertex: self.yaws[vertex] for vertex in vertices})


@attrs.frozen(kw_only=True)
class Destinations:
    """The goals of a plan."""

    goals: Goals
    """See `Problem.goals`."""
    yaw: Float
    """f8[n] radians wanted there, NaN = any."""
    errands: tuple[Errands, ...]
    """For each robot the errands that its path leads to; (): it makes room."""


def heads(problem: Problem, moves: Moves, released: Int32) -> Int:
    """Return the vertex i8[n] at the end of what is `released` i4[n] of each path, given the `moves` of the plan."""
    under_way = moves.segment < released[moves.robot]
    vertices = problem.start.astype(np.int64)
    vertices[moves.robot[under_way]] = moves.head[under_way]  # of equal robots the last one counts
    return vertices


class Places:
    """Decides which vertices robots may occupy at rest at the same time.

    Args:
        problem: the first problem; its starts are the homes of robots.
        labels: for each motion profile, equal for vertices between which it can drive both ways.
        parking: where robots without an errand go: nowhere, unless they are in the way, or home.
        sets: the planner takes sets of goals, so that it may choose where they make room.
        shared: the planner takes errands that exclude one another.
        rest: robots without an errand get goals; else the planner chooses where they go.
    """

    def __init__(
        self,
        problem: Problem,
        labels: Sequence[Int],
        parking: Parking,
        sets: bool,
        shared: bool = False,
        rest: bool = True,
    ) -> None:
        roadmap = problem.roadmap
        self._problem, self._labels, self._parking = problem, labels, parking
        self._sets, self._shared, self._rest = sets, shared, rest
        self._near = Neighbourhoods(problem)
        self._kept_free = np.zeros(len(roadmap.position), bool)
        for resource in roadmap.resources:
            self._kept_free[list(resource.vertices)] = True

    def destinations(
        self, errands: Iterable[Sequence[Errand]], head: Int, attempt: int = 0, stays: Bool | tuple[()] = ()
    ) -> Destinations:
        """Return goals for all robots.

        Args:
            errands: of robots that have some, those to go to in order; the most important robots first.
            head: i8[n] vertices at which robots come to rest if nothing more is released.
            attempt: plans in a row that were not found. Then robots that are in the way, in every other attempt all
                robots without an errand, are sent far enough away: home, or to one place after another. Where robots
                only just make room, an incomplete planner may never find how the others pass.
            stays: bool[n] robots that cannot go on from there.
        """
        robots = len(self._problem)
        taken = RestingPlaces(self._near)
        chosen: list[Errands] = [()] * robots
        goals: list[tuple[GoalSet, ...]] = [()] * robots
        for robot in np.flatnonzero(stays).tolist():
            taken.add(robot, int(head[robot]))
            goals[robot] = ((int(head[robot]),),)
        yaw = np.full(robots, np.nan)
        ends: list[Errand] = []
        for sequence in errands:
            way, place = self._with_room(sequence, taken)
            if way:
                last = way[-1]
                taken.add(last.robot, place)
                chosen[last.robot] = tuple([(errand.task, errand.number) for errand in way])
                before = (
                    [tuple(errand.yaws)[: None if self._sets else 1] for errand in way[:-1]] if len(way) > 1 else ()
                )
                goals[last.robot] = (*before, (place,))
                yaw[last.robot] = last.yaws[place]
                if self._sets and len(last.yaws) > 1 and len(set(map(str, last.yaws.values()))) == 1:
                    ends.append(last)
        for robot in [robot for robot in range(robots) if robot not in taken.vertex]:
            goals[robot] = (self._room(robot, int(head[robot]), taken, attempt),) if self._rest else ()
            if goals[robot] and len(goals[robot][0]) == 1:
                taken.add(robot, goals[robot][0][0])
        for end in ends:
            goals[end.robot] = (*goals[end.robot][:-1], self._choice(end, taken))
        return Destinations(goals=tuple(goals), yaw=yaw, errands=tuple(chosen))

    def _with_room(self, errands: Sequence[Errand], taken: RestingPlaces) -> tuple[Sequence[Errand], int]:
        """Of a robot's errands, the leading ones at the last of which it may rest, and where it does.

        That is the nearest place with room. If robots may share goals and no place has room, it is the nearest of those
        to which fewest robots go.
        """
        if self._shared and len(errands[-1].yaws) == 1:  # the usual case
            return errands, next(iter(errands[-1].yaws))
        for last in range(len(errands), 0, -1):
            errand = errands[last - 1]
            for place in errand.yaws:
                if taken.leaves(errand.robot, place):
                    return errands[:last], place
            if self._shared:
                return errands[:last], min(errand.yaws, key=taken.count)
        return (), -1

    def _choice(self, errand: Errand, taken: RestingPlaces) -> GoalSet:
        """The places among which a planner may choose: that of the robot, and those which no other one needs.

        Whatever it chooses for some robots, each other robot still has its own place.
        """
        place = taken.vertex[errand.robot]
        return tuple(it for it in errand.yaws if it == place or taken.leaves(errand.robot, it))

    def _room(self, robot: int, head: int, taken: RestingPlaces, attempt: int) -> GoalSet:
        """Where a robot without an errand may stand."""
        label = self._labels[int(self._problem.profile[robot])]
        able = taken.free(robot) & (label == label[head]) & ~self._kept_free
        home = int(self._problem.start[robot])
        sent = attempt > 0 and (not able[head] or attempt % 2 == 0)
        if able[home] and (self._parking == "home" or (sent and attempt <= 2)):
            return (home,)
        if not able.any():
            return (head,)
        if sent:
            choice = np.flatnonzero(able)
            return (int(choice[(attempt + 1) * STRIDE * (robot + 1) % len(choice)]),)
        if self._sets:
            return tuple(np.flatnonzero(able).tolist())
        return (int(head if able[head] else self._nearest(head, able)),)

    def _nearest(self, head: int, able: Bool) -> int:
        roadmap = self._problem.roadmap
        gap = np.hypot(*(roadmap.position - roadmap.position[head]).T)
        gap[~able] = np.inf
        elsewhere = able & (roadmap.level != roadmap.level[head])
        return int(np.argmin(gap + 1e6 * elsewhere))
