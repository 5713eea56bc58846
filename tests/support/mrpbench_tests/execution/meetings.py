"""Tells which rules of `mrpbench_core.model.planning.conflicts` the robots of executions broke.

It knows the begin and the end of each move in whole steps, and nothing of orders, dispatchers or plans' times. Here,
times are in half steps, so that every interval is closed: a robot stands at a vertex from 2 a to 2 d, and is on an edge
from 2 b + 1 to 2 e - 1. Pairs of uses that exclude one another are found once, and compared in all executions together.
"""

from typing import NamedTuple

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Int
from mrpbench_core.model.common.geometry import segment_distance
from mrpbench_core.model.planning.conflicts import TOLERANCE
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_tests.execution.batch_executor import NOT_YET, BatchExecutor

_AT_ONCE = 1 << 21
"""Pairs of uses that are compared at once, counted in all executions."""


class Uses(NamedTuple):
    """What robots use in d executions, one use for each vertex and edge of their paths; u of them."""

    robot: Int
    """i8[u]."""
    tail: Int
    head: Int
    """Equal to `tail` for a vertex."""
    edge: Int
    """-1 for a vertex."""
    begin: Int
    """half steps i8[d,u]."""
    end: Int


def uses_of(executor: BatchExecutor) -> Uses:
    """What the robots of all executions used, robot after robot, in the order of their paths."""
    problem = executor.problem
    stays = problem.rules.at_goal == "stay"
    rows = []
    for robot in range(len(problem)):
        moves = np.flatnonzero(executor.edge[robot] >= 0)
        edge = executor.edge[robot, moves]
        ends = problem.roadmap.edges[edge].astype(np.int64).reshape(-1, 2)
        begun, ended = executor.begun[:, robot, moves], executor.ended[:, robot, moves]
        count = len(moves)
        if not (count or stays):
            continue  # it disappears where it begins
        columns = np.empty((4, 2 * count + 1), np.int64)
        columns[0] = robot
        columns[1, ::2] = columns[2, ::2] = np.append(problem.start[robot], ends[:, 1])
        columns[1, 1::2], columns[2, 1::2] = ends.T
        columns[3, ::2], columns[3, 1::2] = -1, edge
        begin, end = (np.full((len(begun), 2 * count + 1), 2 * NOT_YET) for _ in range(2))
        begin[:, 0] = -1
        begin[:, 2::2], begin[:, 1::2] = 2 * ended, 2 * begun + 1
        end[:, :-1:2], end[:, 1::2] = 2 * begun, 2 * ended - 1
        if not stays:
            end[:, -1] = begin[:, -1]
        rows.append((columns, begin, end))
    nothing = np.zeros((len(executor.begun), 0), np.int64)
    rows.append((np.zeros((4, 0), np.int64), nothing, nothing))
    (user, tail, head, edge), begin, end = (np.concatenate(parts, axis=1) for parts in zip(*rows, strict=True))
    return Uses(user, tail, head, edge, begin, end)


def meetings(executor: BatchExecutor) -> list[tuple[int, str]]:
    """The executions in which robots broke a rule, with a sentence on the first break in each."""
    uses = uses_of(executor)
    found: dict[int, str] = {}
    size = max(1, _AT_ONCE // len(uses.begin))
    for kind, one, other in _exclusive(executor.problem, uses):
        for first in range(0, len(one), size):
            p, q = one[first : first + size], other[first : first + size]
            begin, end = (times[:, p] for times in (uses.begin, uses.end))
            their_begin, their_end = (times[:, q] for times in (uses.begin, uses.end))
            if kind == "overtaking":
                bad = (begin < their_end) & (their_begin < end) & ~_in_order(begin, end, their_begin, their_end)
            else:
                bad = (begin <= their_end) & (their_begin <= end)
            bad &= (begin < NOT_YET) & (their_begin < NOT_YET)
            for execution in np.flatnonzero(bad.any(axis=1)).tolist():
                pair = int(bad[execution].argmax())
                found.setdefault(execution, _sentence(kind, uses, int(p[pair]), int(q[pair])))
    for execution, sentence in _over_capacity(executor.problem, uses):
        found.setdefault(execution, sentence)
    return sorted(found.items())


def _exclusive(problem: Problem, uses: Uses) -> list[tuple[str, Int, Int]]:
    """The pairs of uses that rules 1 to 5 keep apart in time, or in order for `overtaking`."""
    one, other = np.triu_indices(len(uses.robot), 1)
    differ = uses.robot[one] != uses.robot[other]
    one, other = one[differ], other[differ]
    moves, theirs = uses.edge[one] >= 0, uses.edge[other] >= 0
    both = moves & theirs
    same = both & (uses.tail[one] == uses.tail[other]) & (uses.head[one] == uses.head[other])
    swap = both & (uses.tail[one] == uses.head[other]) & (uses.head[one] == uses.tail[other])
    kinds: list[tuple[str, Bool]] = [
        ("vertex", ~moves & ~theirs & (uses.tail[one] == uses.tail[other])),
        ("swap", swap),
        ("overtaking", same),
    ]
    if problem.rules.following == "forbidden":
        kinds.append(
            ("following", both & (same | (uses.head[one] == uses.tail[other]) | (uses.tail[one] == uses.head[other])))
        )
    if Feature.FOOTPRINTS in problem.features:
        position, level = problem.roadmap.position, problem.roadmap.level
        ends = [uses.tail[one], uses.head[one], uses.tail[other], uses.head[other]]
        gap = segment_distance(*(position[end] for end in ends))
        near = gap < problem.radius[uses.robot[one]] + problem.radius[uses.robot[other]] - TOLERANCE
        shared = np.zeros(len(one), bool)
        for mine in ends[:2]:
            for end in ends[2:]:
                shared |= level[mine] == level[end]
        kinds.append(("footprint", near & shared))
    return [(kind, one[which], other[which]) for kind, which in kinds]


def _in_order(begin: Int, end: Int, their_begin: Int, their_end: Int) -> Bool:
    """Tell whether the first robot to enter an edge is the first to leave it."""
    found: Bool = ((begin < their_begin) & (end < their_end)) | ((begin > their_begin) & (end > their_end))
    return found


def _over_capacity(problem: Problem, uses: Uses) -> list[tuple[int, str]]:
    """The executions in which more robots are in a resource than fit: at the begin of a use, who else is there."""
    found = []
    for resource in problem.roadmap.resources:
        inside = np.where(
            uses.edge >= 0, np.isin(uses.edge, resource.edges), np.isin(uses.tail, resource.vertices)
        ).astype(bool)
        own = np.flatnonzero(inside)
        for use in own.tolist():
            begin = uses.begin[:, use, None]
            there = (uses.begin[:, own] <= begin) & (uses.end[:, own] >= begin) & (begin < NOT_YET)
            robots = np.zeros((len(begin), len(problem)), bool)
            for robot in np.unique(uses.robot[own]).tolist():
                robots[:, robot] = there[:, uses.robot[own] == robot].any(axis=1)
            for execution in np.flatnonzero(robots.sum(axis=1) > resource.capacity).tolist():
                names = np.flatnonzero(robots[execution]).tolist()
                found.append((execution, f"robots {names} are in {resource.name}, which admits {resource.capacity}"))
    return found


def _sentence(kind: str, uses: Uses, one: int, other: int) -> str:
    places = [
        f"robot {uses.robot[use]} on {uses.tail[use]}" + (f"-{uses.head[use]}" if uses.edge[use] >= 0 else "")
        for use in (one, other)
    ]
    return f"{kind} conflict: {' and '.join(places)}"
