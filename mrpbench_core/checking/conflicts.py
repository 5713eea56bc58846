"""Finds the conflicts of a plan by comparing intervals directly; the rules are in `model.planning.conflicts`."""

from collections import defaultdict
from collections.abc import Iterator
from itertools import chain
from typing import NamedTuple

import numpy as np

from mrpbench_core.checking.paths import segments_of
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.common.geometry import segment_distance
from mrpbench_core.model.planning.conflicts import TOLERANCE
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Feature, Problem

FOREVER = np.iinfo(np.int64).max


class Conflict(NamedTuple):
    """Two robots that break a rule of `mrpbench_core.model.planning.conflicts`."""

    kind: str
    """vertex | swap | overtaking | following | footprint | resource."""
    robots: tuple[int, int]
    where: tuple[int, int]
    """The two ends of the element that the first robot occupies; equal for a vertex."""
    tick: int

    def __str__(self) -> str:
        place = f"vertex {self.where[0]}" if self.where[0] == self.where[1] else f"edge {self.where[0]}-{self.where[1]}"
        return f"{self.kind} conflict of robots {self.robots[0]} and {self.robots[1]} at {place}, tick {self.tick}"


class Occupation(NamedTuple):
    """A robot's time on one element: at a vertex (`tail == head`, closed interval) or on an edge (open interval).

    Where robots may be late, it ends when the latest leaves, so that the next one of the same robot may begin before.
    """

    robot: int
    tail: int
    head: int
    begin: int
    end: int

    @property
    def moving(self) -> bool:
        """True on an edge."""
        return self.tail != self.head


def find_conflicts(problem: Problem, plan: Plan, limit: int | None = None) -> list[Conflict]:
    """The first `limit` conflicts (None = all) of a plan whose paths have no faults, in order of time."""
    occupations = [Occupation(*row) for row in _candidates(problem, _occupations(problem, plan)).tolist()]
    conflicts = chain(_pairs(problem, occupations), _over_capacity(problem, occupations))
    return sorted(set(conflicts), key=lambda conflict: (conflict.tick, conflict))[:limit]


def _occupations(problem: Problem, plan: Plan) -> Int:
    """All occupations i8[k,5] of all robots, columns as in `Occupation`."""
    late, robots = problem.rules.k, np.arange(len(problem))
    segments = segments_of(plan.paths)
    moves = segments.where(segments.edge >= 0)
    count = np.bincount(moves.robot, minlength=len(robots))
    since = problem.begins
    last = since.copy()
    last[segments.robot] = segments.leave  # of equal robots the last one counts
    final = FOREVER if problem.rules.at_goal == "stay" else last + late
    first = 2 * (np.cumsum(count) - count) + robots  # a robot stands before its first move and after each move
    move = 2 * np.arange(len(moves.robot)) + moves.robot + 1
    table = np.empty((5, 2 * len(move) + len(robots)), np.int64)
    robot, tail, head, begin, end = table
    robot[:] = np.repeat(robots, 2 * count + 1)
    tail[move], head[move] = problem.roadmap.edges.take(moves.edge, axis=0).T
    begin[move], end[move] = moves.enter, moves.leave + late
    head[first], begin[first] = problem.start, since
    head[move + 1], begin[move + 1] = head[move], moves.leave
    end[move - 1], end[first + 2 * count] = moves.enter + late, final
    stands = np.ones(len(robot), bool)
    stands[move] = False
    tail[stands] = head[stands]
    return table.T


def _candidates(problem: Problem, occupations: Int) -> Int:
    """The occupations that have to be compared one by one.

    Where only robots on one and the same element can conflict, these are the ones on elements that are occupied again
    before the last occupation is over.
    """
    if Feature.FOOTPRINTS in problem.features or problem.rules.following == "forbidden" or problem.roadmap.resources:
        return occupations
    _, tail, head, begin, end = occupations.T
    vertices = int(max(tail.max(initial=0), head.max(initial=0))) + 1
    element = np.minimum(tail, head) * vertices + np.maximum(tail, head)
    since = int(begin.min(initial=0))  # may be below 0
    ticks = int(begin.max(initial=0)) - since + 1
    if vertices**2 * ticks <= FOREVER:  # one number for both is sorted in a fraction of the time
        order = np.argsort(element * ticks + (begin - since))
    else:
        order = np.lexsort((begin, element))
    before, after = order[:-1], order[1:]  # if any two on an element meet, so do two that follow each other
    meets = (begin[after] < end[before]) | ((tail == head)[after] & (begin[after] == end[before]))
    again = after[meets & (element[before] == element[after])]
    return occupations[np.isin(element, element[again])]


def _pairs(problem: Problem, occupations: list[Occupation]) -> Iterator[Conflict]:
    footprints = Feature.FOOTPRINTS in problem.features
    following = problem.rules.following == "forbidden"
    together: dict[tuple[int, ...], list[Occupation]] = defaultdict(list)
    for occupation in occupations:
        together[tuple(sorted((occupation.tail, occupation.head)))].append(occupation)
    for group in together.values():
        for one, other in _overlapping(group):
            kind = _kind_on_one_element(one, other, following)
            if kind:
                yield _conflict(kind, one, other)
    if following:
        yield from _following(occupations)
    if footprints:
        yield from _footprints(problem, occupations)


def _overlapping(group: list[Occupation]) -> Iterator[tuple[Occupation, Occupation]]:
    """Pairs of occupations by different robots whose closed intervals meet, the earlier first."""
    active: list[Occupation] = []
    for occupation in sorted(group, key=lambda occupation: (occupation.begin, occupation.end)):
        active = [earlier for earlier in active if earlier.end >= occupation.begin]
        yield from ((earlier, occupation) for earlier in active if earlier.robot != occupation.robot)
        active.append(occupation)


def _open_overlap(one: Occupation, other: Occupation) -> bool:
    return max(one.begin, other.begin) < min(one.end, other.end)


def _kind_on_one_element(one: Occupation, other: Occupation, following: bool) -> str | None:
    if not one.moving:
        return "vertex"
    if not _open_overlap(one, other):
        return None
    if one.tail != other.tail:
        return "swap"
    if one.begin == other.begin or other.end <= one.end:
        return "overtaking"
    return "following" if following else None


def _following(occupations: list[Occupation]) -> Iterator[Conflict]:
    around: dict[int, list[Occupation]] = defaultdict(list)
    for occupation in occupations:
        if occupation.moving:
            around[occupation.tail].append(occupation)
            around[occupation.head].append(occupation)
    for vertex, group in around.items():
        for one, other in _overlapping(group):
            into_and_out = {one.head == vertex, other.head == vertex} == {True, False}
            swap = one.tail == other.head and one.head == other.tail
            if into_and_out and not swap and _open_overlap(one, other):
                yield _conflict("following", one, other)


def _footprints(problem: Problem, occupations: list[Occupation]) -> Iterator[Conflict]:
    """Rule 5 by brute force over pairs that overlap in time; simple so that it is easy to verify."""
    occupations = sorted(occupations, key=lambda occupation: (occupation.begin, occupation.end))
    robot, tail, head, begin, end = np.array(occupations, np.int64).reshape(-1, 5).T
    moving = tail != head
    position, level = problem.roadmap.position, problem.roadmap.level
    for one, other in _together(begin, end):
        conflicting = robot[one] != robot[other]
        # Two standing robots conflict at a single tick too; a moving robot only while both intervals overlap.
        conflicting &= ~(moving[one] | moving[other]) | ((begin[one] < end[other]) & (begin[other] < end[one]))
        conflicting &= moving[one] | moving[other] | (tail[one] != tail[other])  # rule 1 covers it
        one, other = one[conflicting], other[conflicting]
        levels = [level[ends[pair]] for pair in (one, other) for ends in (tail, head)]
        shared = (
            (levels[0] == levels[2]) | (levels[0] == levels[3]) | (levels[1] == levels[2]) | (levels[1] == levels[3])
        )
        one, other = one[shared], other[shared]
        a, b, c, d = (position[ends[pair]] for pair in (one, other) for ends in (tail, head))
        reach = problem.radius[robot[one]] + problem.radius[robot[other]]
        for index in np.flatnonzero(segment_distance(a, b, c, d) < reach - TOLERANCE).tolist():
            yield _conflict("footprint", occupations[one[index]], occupations[other[index]])


def _together(begin: Int, end: Int, chunk: int = 1 << 18) -> Iterator[tuple[Int, Int]]:
    """Pairs of intervals, sorted by `begin`, that meet (closed), the earlier first, about `chunk` pairs at a time."""
    count = np.searchsorted(begin, end, side="right") - np.arange(len(begin)) - 1
    total = np.cumsum(count)
    row = 0
    while row < len(begin):
        until = max(row + 1, int(np.searchsorted(total, total[row] - count[row] + chunk, side="right")))
        size = count[row:until]
        one = np.repeat(np.arange(row, until), size)
        yield one, one + 1 + np.arange(len(one)) - np.repeat(np.cumsum(size) - size, size)
        row = until


def _over_capacity(problem: Problem, occupations: list[Occupation]) -> Iterator[Conflict]:
    """Rule 6 in half ticks: even ones are instants, odd ones lie between, and all intervals are closed."""
    edges = problem.roadmap.edges
    for resource in problem.roadmap.resources:
        parts = {(vertex, vertex) for vertex in resource.vertices} | {tuple(edges[edge]) for edge in resource.edges}
        uses = []
        for occupation in occupations:
            if (occupation.tail, occupation.head) in parts:
                first, last = 2 * occupation.begin + occupation.moving, 2 * occupation.end - occupation.moving
                uses.append((first, last + 2 * resource.setup_ticks, occupation))
        holding: dict[int, tuple[int, Occupation]] = {}
        for first, last, occupation in sorted(uses, key=lambda use: use[:2]):
            holding = {robot: (end, since) for robot, (end, since) in holding.items() if end >= first}
            others = [since for robot, (_, since) in holding.items() if robot != occupation.robot]
            if len(others) >= resource.capacity:
                yield _conflict("resource", max(others, key=lambda other: other.begin), occupation)
            end = max(last, holding[occupation.robot][0]) if occupation.robot in holding else last
            holding[occupation.robot] = end, occupation


def _conflict(kind: str, one: Occupation, other: Occupation) -> Conflict:
    first, second = (one, other) if one.robot < other.robot else (other, one)
    return Conflict(kind, (first.robot, second.robot), (first.tail, first.head), max(one.begin, other.begin))
