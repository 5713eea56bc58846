"""The alternative graph of what may still be decided, as `mrpbench_native.mapf.reorder` takes it.

The events of a robot are its present state at time 0, and three for each move left: the robot begins it, clears the
vertex behind it, and completes it. A pair of visits gives an arc from the end of the visit that comes first to the
beginning of the other one. Times are in milliseconds.
"""

from typing import NamedTuple

import numpy as np

from mrpbench_core.dispatching.dependency_graph import CLEARED, REACHED, DependencyGraph
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_core.model.planning.type2_edges import Moves, Type2Edges
from mrpbench_dispatchers_reordering.progress import Progress
from mrpbench_dispatchers_reordering.visits import NONE, Pairs, Visits

MILLISECONDS = 1000.0
BEGIN, CLEAR, COMPLETE = range(3)
"""The events of a move."""


class State(NamedTuple):
    """How far robots are."""

    seen: Int
    """Counts i8[2,n] of segments reached and cleared."""
    released: Int32
    progress: Progress


class AlternativeGraph(NamedTuple):
    """The arguments of `reorder`, and the pairs that its alternatives belong to."""

    arrays: dict[str, Int32]
    open: Int
    """The pair of each alternative."""


def alternative_graph(
    graph: DependencyGraph, visits: Visits, pairs: Pairs, resources: Type2Edges, state: State, window: float
) -> AlternativeGraph:
    """Build the graph.

    Args:
        graph: has the order in force.
        visits: of the plan.
        pairs: in the order in force.
        resources: edges of rule 6, which hold in every order.
        state: how far robots are.
        window: planned seconds from now in which visits begin whose order may change.
    """
    moves, events = graph.moves, _Events(graph.moves, state)
    begun = (visits.begin == NONE) | _is_released(moves, visits.begin, state)
    ended = visits.end != NONE
    for row, needed in ((CLEARED, visits.cleared), (REACHED, visits.completed)):
        ended &= ~needed | (state.seen[row, visits.robot] > moves.segment[visits.end])
    group = _rotations(graph)
    begin_group, end_group = (np.where(move == NONE, NONE, group[move]) for move in (visits.begin, visits.end))
    due = _planned_wait(moves, visits, state.progress) <= window
    free = ~begun & (visits.end != NONE) & (begin_group == NONE) & (end_group == NONE) & due
    first, second = pairs
    counts = ~ended[first] & ~begun[second]
    counts &= (end_group[first] == NONE) | (end_group[first] != begin_group[second])
    is_open = counts & free[first] & free[second]
    found = np.flatnonzero(is_open)
    fixed = np.flatnonzero(counts & ~is_open & (visits.end[first] != NONE))
    arcs = [events.arcs(visits.end[first[fixed]], visits.completed[first[fixed]], visits.begin[second[fixed]])]
    left = ~_is_released(moves, resources.after, state)
    done = np.where(resources.completed, REACHED, CLEARED)
    left &= state.seen[done, moves.robot[resources.before]] <= moves.segment[resources.before]
    arcs.append(events.arcs(resources.before[left], resources.completed[left], resources.after[left]))
    arcs.append(events.arcs_into_rotations(graph, np.concatenate(arcs)))
    first, second = first[found], second[found]
    return AlternativeGraph(
        arrays={
            "first": events.first.astype(np.int32),
            "duration": events.duration.astype(np.int32),
            "fixed": np.concatenate(arcs),
            "planned": events.arcs(visits.end[first], visits.completed[first], visits.begin[second]),
            "switched": events.arcs(visits.end[second], visits.completed[second], visits.begin[first]),
        },
        open=found,
    )


def _is_released(moves: Moves, move: Int, state: State) -> Bool:
    released: Bool = moves.segment[move] < state.released[moves.robot[move]]
    return released


def _rotations(graph: DependencyGraph) -> Int:
    """The first move of the rotation i8[m] that each move belongs to, `NONE` for other moves."""
    group = np.full(len(graph.moves.robot), NONE)
    for first, rotation in graph.rotations.items():
        group[list(rotation)] = first
    return group


def _planned_wait(moves: Moves, visits: Visits, progress: Progress) -> Float:
    """Planned seconds f8[v] from each robot's present move to the beginning of a visit."""
    present = np.minimum(progress.present, len(moves.robot) - 1)[visits.robot]
    ticks = np.where(visits.begin == NONE, 0, moves.enter[visits.begin] - moves.enter[present])
    wait: Float = ticks * progress.tick
    return wait


class _Events:
    """Numbers the events of all robots, and gives the times between them."""

    def __init__(self, moves: Moves, state: State) -> None:
        self._moves = moves
        robots = np.arange(len(moves.first) - 1)
        present = state.progress.present
        count = moves.first[1:] - present
        under_way = (count > 0) & _is_released(moves, np.minimum(present, len(moves.robot) - 1), state)
        self.first: Int = np.concatenate([[0], np.cumsum(1 + 3 * count - under_way)])
        self._origin = self.first[:-1] + 1 - under_way - 3 * present
        """Event `BEGIN` of move m is number `_origin[robot] + 3 m`; that of a move under way is the present state."""
        self.duration: Int = np.ones(self.first[-1], np.int64)
        left = np.arange(len(moves.robot)) >= present[moves.robot]
        whole = np.maximum(2, np.rint(state.progress.duration * MILLISECONDS).astype(np.int64))
        # A robot is assumed to lose as much time again as it has lost on its move already.
        mine = robots[under_way]
        rest = np.abs(state.progress.duration[present[mine]] - state.progress.elapsed[mine])
        whole[present[mine]] = np.maximum(2, np.rint(rest * MILLISECONDS).astype(np.int64))
        begin = self._origin[moves.robot] + 3 * np.arange(len(moves.robot))
        self.duration[begin[left]] = whole[left] // 2
        self.duration[begin[left] + CLEAR] = (whole - whole // 2)[left]
        gone = under_way & (state.seen[CLEARED] > moves.segment[np.minimum(present, len(moves.robot) - 1)])
        at = begin[present[gone]]
        self.duration[at], self.duration[at + CLEAR] = 1, whole[present[gone]]

    def of(self, move: Int, kind: Int) -> Int:
        """The event of each move; the present state if the robot has made the move."""
        robot = self._moves.robot[move]
        event: Int = np.maximum(self._origin[robot] + 3 * move + kind, self.first[robot])
        return event

    def arcs(self, before: Int, completed: Bool, after: Int) -> Int32:
        """Arcs i4[k,3] from the end of moves, which are cleared or `completed`, to the beginning of others."""
        ends = self.of(before, np.where(completed, COMPLETE, CLEAR))
        begins = self.of(after, np.full(len(after), BEGIN))
        return np.stack([ends, begins, np.ones(len(ends), np.int64)], axis=1).astype(np.int32)

    def arcs_into_rotations(self, graph: DependencyGraph, arcs: Int32) -> Int32:
        """The moves of a rotation start together, so what one of them waits for the others wait for too."""
        found = [np.empty((0, 3), np.int32)]
        robot_of = np.repeat(np.arange(len(self.first) - 1), np.diff(self.first))
        for rotation in graph.rotations.values():
            members = np.array(rotation)
            begins = self.of(members, np.full(len(members), BEGIN))
            if (begins == self.first[self._moves.robot[members]]).any():
                continue  # under way or over
            sources = np.concatenate([begins - 1, arcs[np.isin(arcs[:, 1], begins), 0]])
            before, after = np.repeat(sources, len(begins)), np.tile(begins, len(sources))
            apart = robot_of[before] != robot_of[after]
            ones = np.ones(int(apart.sum()), np.int64)
            found.append(np.stack([before[apart], after[apart], ones], axis=1).astype(np.int32))
        return np.concatenate(found)
