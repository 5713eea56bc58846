"""Type-2 edges: the orders between moves of different robots that a conflict-free plan implies.

The term is that of Hönig et al., "Persistent and Robust Execution of MAPF Schedules in Warehouses", RA-L 2019. The
edges follow from the rules of `model.planning.conflicts`. Robots that keep these orders do not meet, at any speed:

- rule 1: at each vertex, the next robot moves in only after the one before has *cleared* it. That keeps rules 2 and 3
  too: to swap or to overtake, two robots must use one of the edge's ends in the wrong order;
- rule 4: at each vertex, the next robot moves in only after the one before has also *completed* its move out;
- rule 5: a move starts only after the last move on each element near it is *completed*. Moves are enough: a
  robot that stands at a vertex came there, or will leave it, by a move that touches it;
- rule 6: see `mrpbench_core.model.planning.occupations`.

Only edges from immediate predecessors are kept; the others follow from the edges of the predecessors.
"""

from typing import NamedTuple

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Int
from mrpbench_core.model.planning.conflicts import exclusions
from mrpbench_core.model.planning.plan import Paths, Plan
from mrpbench_core.model.planning.problem import Feature, Problem


class Moves(NamedTuple):
    """Every segment of a plan that is not a wait, robot after robot, each in the order of its path; all i8[m]."""

    first: Int
    """i8[n+1]: robot i's moves are `first[i]:first[i + 1]`."""
    robot: Int
    segment: Int
    """Index in the robot's path."""
    edge: Int
    tail: Int
    head: Int
    enter: Int
    leave: Int


class Type2Edges(NamedTuple):
    """Move `after[i]` waits for move `before[i]` of another robot; all [k]."""

    before: Int
    after: Int
    completed: Bool
    """True: until `before` has ended. False: until its robot has cleared the vertex that `before` starts at."""

    def subset(self, which: Bool) -> "Type2Edges":
        """Those of `which` bool[k]."""
        return Type2Edges(self.before[which], self.after[which], self.completed[which])


def moves_of(problem: Problem, plan: Plan) -> Moves:
    """List the moves of a plan whose paths have no faults."""
    paths = Paths.of(plan.paths)
    at = (paths.edge >= 0).nonzero()[0]  # indices are taken in a fraction of the time of a mask
    robot, segment, enter, leave = (its.take(at) for its in (paths.robot, paths.segment, paths.enter, paths.leave))
    edge = paths.edge.take(at).astype(np.int64)
    first = at.searchsorted(paths.first)
    tail, head = problem.roadmap.edges.take(edge, axis=0).astype(np.int64).T
    return Moves(first, robot, segment, edge, tail, head, enter, leave)


def type2_edges(problem: Problem, moves: Moves, resources: Type2Edges, chosen: Bool | None = None) -> Type2Edges:
    """The edges that a conflict-free plan with these `moves` implies, including `resources`, those of rule 6.

    With `chosen` bool[m], only the edges from chosen moves.
    """
    columns = [_at_vertices(problem, moves, chosen), resources]
    if Feature.FOOTPRINTS in problem.features:
        columns += _between_footprints(problem, moves)
    edges = Type2Edges(*(np.concatenate(parts) for parts in zip(*columns, strict=True)))
    return without_implied(moves, edges if chosen is None else edges.subset(chosen[edges.before]))


def _at_vertices(problem: Problem, moves: Moves, chosen: Bool | None) -> Type2Edges:
    """Rules 1 to 4: each robot moves into a vertex after the one that stood there before moved out."""
    robots = np.arange(len(problem))
    starts, count = moves.first[:-1], np.diff(moves.first)
    index = np.arange(len(moves.robot))
    is_last = np.append(moves.robot[1:] != moves.robot[:-1], True)[: len(index)]
    vertex = np.concatenate([problem.start, moves.head])
    robot = np.concatenate([robots, moves.robot])
    begin = np.concatenate([problem.begins, moves.leave])
    arrival = np.concatenate([np.full(len(robots), -1), index])
    departure = np.concatenate([np.where(count > 0, starts, -1), np.where(is_last, -1, index + 1)])
    if chosen is not None:
        ours = np.append(chosen, False)[np.where(departure < 0, arrival, departure)]
        needed = _around(vertex, begin, ours)
        vertex, robot, begin = vertex[needed], robot[needed], begin[needed]
        arrival, departure = arrival[needed], departure[needed]
    order = np.argsort(_places_and_times(vertex, begin), kind="stable")
    earlier, later = order[:-1], order[1:]
    pairs = (vertex[earlier] == vertex[later]) & (robot[earlier] != robot[later])
    earlier, later = earlier[pairs], later[pairs]
    gone = departure[earlier] < 0  # only with `at_goal: disappear`: it is gone when its last move has ended
    before, after = np.where(gone, arrival[earlier], departure[earlier]), arrival[later]
    some = (before >= 0) & (after >= 0)  # a robot that is there from the beginning waits for none
    before, after, gone = before[some], after[some], gone[some]
    passed = gone.copy()  # where it is enough that the move is completed
    if Feature.FOOTPRINTS in problem.features:
        passed |= moves.leave[before] <= moves.enter[after]
    completed = passed | (problem.rules.following == "forbidden")
    kinds = np.repeat([False, True], [int((~passed).sum()), int(completed.sum())])
    return Type2Edges(
        np.concatenate([before[~passed], before[completed]]), np.concatenate([after[~passed], after[completed]]), kinds
    )


def _places_and_times(place: Int, tick: Int) -> Int:
    """Numbers i8[k] in the order of places i8[k], those of equal places in the order of time, which may be below 0."""
    since = int(tick.min(initial=0))
    ordered: Int = place * (int(tick.max(initial=0)) - since + 1) + (tick - since)
    return ordered


def _around(vertex: Int, begin: Int, ours: Bool) -> Bool:
    """The visits bool[v] of each vertex from the first of `ours` bool[v] to the next one after the last of these."""
    never = np.iinfo(np.int64).max
    low, high, following = (np.full(int(vertex.max(initial=0)) + 1, value) for value in (never, -never, never))
    np.minimum.at(low, vertex[ours], begin[ours])
    np.maximum.at(high, vertex[ours], begin[ours])
    later = (low[vertex] < never) & (begin > high[vertex])
    np.minimum.at(following, vertex[later], begin[later])
    around: Bool = (begin >= low[vertex]) & (begin <= following[vertex])
    return around & (low[vertex] < never)


def _between_footprints(problem: Problem, moves: Moves) -> list[Type2Edges]:
    """Rule 5: for each move and each edge near its own, the last move there before it; one size of robot at a time."""
    edges = []
    vertices = len(problem.roadmap.position)
    since = int(moves.enter.min(initial=0))  # may be below 0
    ticks = int(moves.enter.max(initial=0)) - since + 1
    radius = problem.radius[moves.robot]
    for mine in np.unique(radius):
        after = np.flatnonzero(radius == mine)
        for theirs in np.unique(radius):
            before = np.flatnonzero(radius == theirs)
            key = moves.edge[before] * ticks + (moves.enter[before] - since)
            before, key = before[np.argsort(key)], np.sort(key)
            near = exclusions(problem.roadmap, float(mine + theirs))
            begin, end = near.first[vertices + moves.edge[after]], near.first[vertices + moves.edge[after] + 1]
            size = end - begin
            row = np.repeat(after, size)
            element = near.element[np.arange(len(row)) + np.repeat(begin - np.cumsum(size) + size, size)]
            row, edge = row[element >= vertices], element[element >= vertices].astype(np.int64) - vertices
            last = np.searchsorted(key, edge * ticks + (moves.enter[row] - since)) - 1
            some = last >= 0
            row, edge, last = row[some], edge[some], before[last[some]]
            other = (moves.edge[last] == edge) & (moves.robot[last] != moves.robot[row])
            edges.append(Type2Edges(last[other], row[other], np.ones(int(other.sum()), bool)))
    return edges


def without_implied(moves: Moves, all_of: Type2Edges) -> Type2Edges:
    """Leave out the edges that those of a robot's earlier moves imply."""
    before, after, completed = all_of
    count = len(moves.robot) + 1
    pair = (moves.robot[after] * count + moves.robot[before]) * 2 + completed
    order = np.lexsort((after * count - before, pair))  # fewer keys are sorted faster
    before, pair = before[order], pair[order]
    rank = np.cumsum(np.append(False, pair[1:] != pair[:-1]))[: len(before)] * count + before
    newest = np.append(True, rank[1:] > np.maximum.accumulate(rank)[:-1])[: len(before)]
    chosen = order[newest]
    return Type2Edges(before[newest], after[chosen], completed[chosen])
