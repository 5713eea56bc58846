"""When robots use doors, lifts and mutexes, in the plan's order (rule 6 of `mrpbench_core.model.conflicts`)."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from mrpbench_core.api.dispatcher import DispatchError
from mrpbench_core.builtin.dispatchers.precedence import Moves, Precedence, moves_of
from mrpbench_core.model.arrays import Bool
from mrpbench_core.model.plan import Plan
from mrpbench_core.model.problem import Problem
from mrpbench_core.model.roadmap import Resource

NEVER = -1


class Use(NamedTuple):
    """One robot in one resource, without a break."""

    robot: int
    resource: str
    first: int
    """The move by which the robot comes into it, -1 = it starts there."""
    last: int
    """The move by which it leaves, `NEVER` = it stays."""
    completed: bool
    """True: it has left when that move has ended. False: when it has cleared the vertex that the move starts at."""
    begin: int
    end: int
    """Half ticks of the plan from the first to the last that the resource is in use, setup included."""


def uses_of(problem: Problem, moves: Moves) -> list[Use]:
    """All uses of the roadmap's resources, by resource and robot, in order of time."""
    return [use for resource in problem.roadmap.resources for use in _uses(problem, moves, resource)]


def _uses(problem: Problem, moves: Moves, resource: Resource) -> Iterator[Use]:
    edges, vertices = np.zeros(len(problem.roadmap.edges), bool), np.zeros(len(problem.roadmap.position), bool)
    edges[list(resource.edges)], vertices[list(resource.vertices)] = True, True
    for robot, start in enumerate(problem.start.tolist()):
        own = range(moves.first[robot], moves.first[robot + 1])
        if not own and problem.rules.at_goal == "disappear":
            continue
        # Places and lanes by turns: element 0 is the start, 2 i + 1 the lane of the i-th move, 2 i + 2 its end.
        inside: Bool = np.zeros(2 * len(own) + 1, bool)
        inside[0] = vertices[start]
        inside[1::2], inside[2::2] = edges[moves.edge[own]], vertices[moves.head[own]]
        change = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]]).astype(np.int8)))
        for begin, end in change.reshape(-1, 2).tolist():
            yield _use(problem, moves, resource, robot, begin, end - 1)


def _use(problem: Problem, moves: Moves, resource: Resource, robot: int, begin: int, end: int) -> Use:
    """The use from element `begin` to element `end` of a robot's way."""
    zero, stop = int(moves.first[robot]), int(moves.first[robot + 1])
    first = -1 if begin == 0 else zero + (begin - 1) // 2
    since = 0 if begin == 0 else int(2 * moves.enter[first] + 1 if begin % 2 else 2 * moves.leave[first])
    on_lane = end % 2 == 1
    last = zero + (end - 1) // 2 if on_lane else zero + end // 2
    if not on_lane and last == stop:  # it ends at its goal
        last, on_lane = (NEVER, False) if problem.rules.at_goal == "stay" else (stop - 1, True)
    if last == NEVER:
        until = np.iinfo(np.int64).max
    else:
        until = int(2 * moves.leave[last] - 1 if on_lane else 2 * moves.enter[last]) + 2 * resource.setup_ticks
    return Use(robot, resource.name, first, last, on_lane, since, int(until))


def orders_of(problem: Problem, uses: list[Use]) -> Precedence:
    """Who comes into a resource after whom: after all that had left when the plan lets it in.

    Robots that are in it together in any execution overlap pairwise in the plan, hence all at one instant of it: they
    are no more than its capacity.
    """
    before, after, completed = [], [], []
    for resource in problem.roadmap.resources:
        own = sorted((use for use in uses if use.resource == resource.name), key=lambda use: use.begin)
        for index, later in enumerate(own):
            if later.first < 0 or (problem.horizon is not None and later.begin > 2 * problem.horizon):
                continue
            # With room for one only, the one before has waited for those before it.
            for earlier in own[max(0, index - 1) if resource.capacity == 1 else 0 : index]:
                if earlier.robot != later.robot and earlier.end < later.begin:
                    before.append(earlier.last)
                    after.append(later.first)
                    completed.append(earlier.completed)
    return Precedence(np.array(before, np.int64), np.array(after, np.int64), np.array(completed, bool))


def refuse_facilities(problem: Problem, plan: Plan, dispatcher: str) -> None:
    """Raise DispatchError when a plan leads through a door or a lift, for dispatchers that do not ask for them."""
    kinds = {resource.name: resource.kind for resource in problem.roadmap.resources}
    for use in uses_of(problem, moves_of(problem, plan)):
        if kinds[use.resource] != "mutex":
            raise DispatchError(
                f"robot {use.robot} needs the {kinds[use.resource]} {use.resource}, "
                f"and {dispatcher} asks for no doors or lifts: use adg"
            )
