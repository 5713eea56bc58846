"""Occupations of doors, lifts and mutexes, in the order of the plan (rule 6 of `model.planning.conflicts`)."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from mrpbench_core.model.common.arrays import Bool
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Resource
from mrpbench_core.model.planning.type2_edges import Moves, Type2Edges

NEVER = -1


class ResourceOccupation(NamedTuple):
    """A robot in a resource, without interruption."""

    robot: int
    resource: str
    first: int
    """The move by which the robot enters the resource, -1 = it starts there."""
    last: int
    """The move by which the robot leaves the resource, `NEVER` = it stays."""
    completed: bool
    """True: the robot has left when that move is completed. False: when it has cleared the start of that move."""
    begin: int
    end: int
    """First and last half tick of the plan at which the resource is occupied, setup included."""


def occupations_of(problem: Problem, moves: Moves) -> list[ResourceOccupation]:
    """All occupations of the roadmap's resources, by resource and robot, in order of time."""
    return [
        occupation for resource in problem.roadmap.resources for occupation in _occupations(problem, moves, resource)
    ]


def _occupations(problem: Problem, moves: Moves, resource: Resource) -> Iterator[ResourceOccupation]:
    edges, vertices = np.zeros(len(problem.roadmap.edges), bool), np.zeros(len(problem.roadmap.position), bool)
    edges[list(resource.edges)], vertices[list(resource.vertices)] = True, True
    for robot, start in enumerate(problem.start.tolist()):
        segments = range(moves.first[robot], moves.first[robot + 1])
        if not segments and problem.rules.at_goal == "disappear":
            continue
        # Vertices and edges alternate: element 0 is the start, 2 i + 1 the edge of move i, 2 i + 2 its end.
        inside: Bool = np.zeros(2 * len(segments) + 1, bool)
        inside[0] = vertices[start]
        inside[1::2], inside[2::2] = edges[moves.edge[segments]], vertices[moves.head[segments]]
        change = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]]).astype(np.int8)))
        for begin, end in change.reshape(-1, 2).tolist():
            yield _occupation(problem, moves, resource, robot, begin, end - 1)


def _occupation(
    problem: Problem, moves: Moves, resource: Resource, robot: int, begin: int, end: int
) -> ResourceOccupation:
    """The occupation from element `begin` to element `end` of a robot's path."""
    zero, stop = int(moves.first[robot]), int(moves.first[robot + 1])
    first = -1 if begin == 0 else zero + (begin - 1) // 2
    since = (
        2 * problem.begin(robot)
        if begin == 0
        else int(2 * moves.enter[first] + 1 if begin % 2 else 2 * moves.leave[first])
    )
    on_lane = end % 2 == 1
    last = zero + (end - 1) // 2 if on_lane else zero + end // 2
    if not on_lane and last == stop:  # it ends at its goal
        last, on_lane = (NEVER, False) if problem.rules.at_goal == "stay" else (stop - 1, True)
    if last == NEVER:
        until = np.iinfo(np.int64).max
    else:
        until = int(2 * moves.leave[last] - 1 if on_lane else 2 * moves.enter[last]) + 2 * resource.setup_ticks
    return ResourceOccupation(robot, resource.name, first, last, on_lane, since, int(until))


def resource_edges(problem: Problem, occupations: list[ResourceOccupation]) -> Type2Edges:
    """The edges of rule 6: a robot enters a resource after all robots that had left it by then in the plan.

    Robots that occupy a resource together in any execution overlap pairwise in the plan, hence all at one instant of
    the plan, so they are no more than its capacity.
    """
    before, after, completed = [], [], []
    for resource in problem.roadmap.resources:
        in_order = sorted(
            (occupation for occupation in occupations if occupation.resource == resource.name),
            key=lambda occupation: occupation.begin,
        )
        for index, later in enumerate(in_order):
            if later.first < 0:
                continue
            # If the capacity is 1, the previous robot has waited for those before it.
            for earlier in in_order[max(0, index - 1) if resource.capacity == 1 else 0 : index]:
                if earlier.robot != later.robot and earlier.end < later.begin:
                    before.append(earlier.last)
                    after.append(later.first)
                    completed.append(earlier.completed)
    return Type2Edges(np.array(before, np.int64), np.array(after, np.int64), np.array(completed, bool))
