"""The alternative graph of what may be decided next, as `mrpbench_native.mapf.reorder` takes it.

The events of a robot are its present state at time 0, and three for each move left: the robot begins it, clears the
vertex behind it, and completes it. A pair of visits gives an arc from the end of the visit that comes first to the
beginning of the other one. Times are in milliseconds.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from mrpbench_native.mapf import earliest

from mrpbench_core.dispatching.dependency_graph import CLEARED, REACHED, DependencyGraph
from mrpbench_core.model.common.arrays import Bool, Int, Int32
from mrpbench_core.model.planning.type2_edges import Moves
from mrpbench_dispatchers_reordering.progress import Progress
from mrpbench_dispatchers_reordering.visits import NONE, Conflicts, Pairs, Visits, expanded

MILLISECONDS = 1000.0
BEGIN, CLEAR, COMPLETE = range(3)
"""The events of a move."""


class State(NamedTuple):
    """How far robots are."""

    counts: Int
    """Counts i8[2,n] of segments reached and cleared."""
    released: Int32
    progress: Progress


class AlternativeGraph(NamedTuple):
    """The arguments of `reorder`, the pairs of its alternatives, and the moves whose order its answer changes."""

    arrays: dict[str, Int32]
    pairs: Pairs
    moves: Int
    """i8[c]."""
    begin: Int
    """The event i8[c] that begins each of them."""

    def order(self, switched: Bool) -> Int:
        """The moves i8[c] in an order that `switched` bool[k] implies for the alternatives.

        Raises:
            ValueError: the order has a cycle.
        """
        arrays = self.arrays
        chosen = np.where(switched[:, None], arrays["switched"], arrays["planned"])
        time = earliest(arrays["first"], arrays["duration"], np.concatenate([arrays["fixed"], chosen]))
        moves: Int = self.moves[np.argsort(time[self.begin], kind="stable")]
        return moves


def sum_of_arrivals(arrays: Mapping[str, Int32], switched: Bool) -> int:
    """The sum of the times in ms at which robots complete their moves, given which alternatives bool[k] are switched.

    Raises:
        ValueError: the order has a cycle.
    """
    chosen = np.where(switched[:, None], arrays["switched"], arrays["planned"])
    time = earliest(arrays["first"], arrays["duration"], np.concatenate([arrays["fixed"], chosen]))
    return int(time[arrays["first"][1:] - 1].sum())


def alternative_graph(
    graph: DependencyGraph, conflicts: Conflicts, visits: Visits, state: State, horizon: float, limit: int
) -> AlternativeGraph:
    """Build the graph of the moves that robots can begin within the horizon if they do not wait.

    The order of those moves may change that begin before any robot could complete its moves in the graph, in the
    current order: then no move beyond the graph precedes one of them. So an order of them without cycles has none with
    the rest of the plan either.

    Args:
        graph: has the current order.
        conflicts: of the problem.
        visits: of the plan, at times of the current order.
        state: how far robots are.
        horizon: seconds from now.
        limit: number of moves; the horizon is shortened where they are more.
    """
    moves = graph.moves
    events = _Events(moves, state, _last(moves, state.progress, horizon, limit))
    begun = (visits.begin == NONE) | _is_released(moves, visits.begin, state)
    ended = visits.end != NONE
    for row, needed in ((CLEARED, visits.cleared), (REACHED, visits.completed)):
        ended &= ~needed | (state.counts[row, visits.robot] > moves.segment[visits.end])
    first, second = conflicts.pairs(visits, np.flatnonzero(~ended & (begun | events.has(visits.begin))))
    rotation = np.append(graph.rotation, NONE)
    counts = ~begun[second] & (visits.end[first] != NONE)
    counts &= (rotation[visits.end[first]] == NONE) | (rotation[visits.end[first]] != rotation[visits.begin[second]])
    first, second = first[counts], second[counts]
    planned = events.arcs(visits.end[first], visits.completed[first], visits.begin[second])
    fixed = np.concatenate([_resource_arcs(graph, events, state), _arcs_from_beyond(graph, events)])
    arcs = np.concatenate([fixed, planned])
    fixed = np.concatenate([fixed, events.arcs_into_rotations(graph.rotation, arcs)])
    time = earliest(events.first.astype(np.int32), events.duration.astype(np.int32), np.concatenate([arcs, fixed]))
    inside = np.flatnonzero(
        events.has(np.arange(len(moves.robot))) & ~_is_released(moves, np.arange(len(moves.robot)), state)
    )
    begin = events.of(inside, np.full(len(inside), BEGIN))
    next_one = time[begin] < events.least_beyond(time)
    inside, begin = inside[next_one], begin[next_one]
    free = np.zeros(len(moves.robot) + 1, bool)
    free[inside] = True
    free &= rotation == NONE
    is_open = (
        free[visits.begin[first]] & free[visits.end[first]] & free[visits.begin[second]] & free[visits.end[second]]
    )
    one, other = first[is_open], second[is_open]
    return AlternativeGraph(
        arrays={
            "first": events.first.astype(np.int32),
            "duration": events.duration.astype(np.int32),
            "fixed": np.concatenate([fixed, planned[~is_open]]),
            "planned": planned[is_open],
            "switched": events.arcs(visits.end[other], visits.completed[other], visits.begin[one]),
        },
        pairs=Pairs(one, other),
        moves=inside,
        begin=begin,
    )


def _last(moves: Moves, progress: Progress, horizon: float, limit: int) -> Int:
    """The end i8[n] of the moves of each robot that it can begin within the horizon.

    The horizon is shortened while these are more than `limit`, but to no less than one move of each robot.
    """
    while True:
        last = np.clip(progress.moves_until(horizon), progress.present, moves.first[1:])
        if (last - progress.present).sum() <= max(limit, len(last)):
            return last
        horizon *= 0.9


def _resource_arcs(graph: DependencyGraph, events: "_Events", state: State) -> Int32:
    """Rule 6, which holds in every order."""
    moves, resources = graph.moves, graph.resources
    done = np.where(resources.completed, REACHED, CLEARED)
    left = ~_is_released(moves, resources.after, state) & events.has(resources.after)
    left &= state.counts[done, moves.robot[resources.before]] <= moves.segment[resources.before]
    return events.arcs(resources.before[left], resources.completed[left], resources.after[left])


def _arcs_from_beyond(graph: DependencyGraph, events: "_Events") -> Int32:
    """From moves beyond the graph that precede moves in it: from the last events of their robots."""
    order = graph.order
    into = (order.before >= events.last[graph.moves.robot[order.before]]) & events.has(order.after)
    return events.arcs(order.before[into], order.completed[into], order.after[into])


def _is_released(moves: Moves, move: Int, state: State) -> Bool:
    released: Bool = moves.segment[move] < state.released[moves.robot[move]]
    return released


class _Events:
    """Numbers the events of all robots, and gives the times between them."""

    def __init__(self, moves: Moves, state: State, last: Int) -> None:
        self._moves = moves
        self.last = last
        """The end i8[n] of the moves of each robot in the graph."""
        robots = np.arange(len(moves.first) - 1)
        present = state.progress.present
        count = last - present
        under_way = (count > 0) & _is_released(moves, np.minimum(present, len(moves.robot) - 1), state)
        self.first: Int = np.concatenate([[0], np.cumsum(1 + 3 * count - under_way)])
        self._origin = self.first[:-1] + 1 - under_way - 3 * present
        """Event `BEGIN` of move m is number `_origin[robot] + 3 m`; that of a move under way is the present state."""
        self._present = present
        self.duration: Int = np.ones(self.first[-1], np.int64)
        left = self.has(np.arange(len(moves.robot)))
        whole = np.maximum(2, np.rint(state.progress.duration * MILLISECONDS).astype(np.int64))
        # A robot is assumed to lose as much time again as it has lost on its move already.
        mine = robots[under_way]
        rest = np.abs(state.progress.duration[present[mine]] - state.progress.elapsed[mine])
        whole[present[mine]] = np.maximum(2, np.rint(rest * MILLISECONDS).astype(np.int64))
        begin = self._origin[moves.robot] + 3 * np.arange(len(moves.robot))
        self.duration[begin[left]] = whole[left] // 2
        self.duration[begin[left] + CLEAR] = (whole - whole // 2)[left]
        gone = under_way & (state.counts[CLEARED] > moves.segment[np.minimum(present, len(moves.robot) - 1)])
        at = begin[present[gone]]
        self.duration[at], self.duration[at + CLEAR] = 1, whole[present[gone]]

    def has(self, move: Int) -> Bool:
        """Tell which moves, `NONE` = no move, are in the graph."""
        robot = self._moves.robot[move]
        present: Bool = (move >= self._present[robot]) & (move < self.last[robot])
        return present

    def of(self, move: Int, kind: Int) -> Int:
        """The event of each move; the present state if the robot has made the move, its last event if it is beyond."""
        robot = self._moves.robot[move]
        event: Int = np.clip(self._origin[robot] + 3 * move + kind, self.first[robot], self.first[robot + 1] - 1)
        return event

    def least_beyond(self, time: Int32) -> int:
        """The least `time` i4[events] at which a move beyond the graph can begin."""
        goes_on = self.last < self._moves.first[1:]
        return int(time[self.first[1:][goes_on] - 1].min(initial=np.iinfo(np.int32).max))

    def arcs(self, before: Int, completed: Bool, after: Int) -> Int32:
        """Arcs i4[k,3] from the end of moves, which are cleared or `completed`, to the beginning of others."""
        ends = self.of(before, np.where(completed, COMPLETE, CLEAR))
        begins = self.of(after, np.full(len(after), BEGIN))
        return np.stack([ends, begins, np.ones(len(ends), np.int64)], axis=1).astype(np.int32)

    def arcs_into_rotations(self, rotation: Int32, arcs: Int32) -> Int32:
        """The moves of a rotation start together, so what one of them waits for the others wait for too."""
        members = np.flatnonzero(rotation != NONE)
        begins, inside = self.of(members, np.full(len(members), BEGIN)), self.has(members)
        started = begins == self.first[self._moves.robot[members]]  # under way or over
        group: Int = rotation[members].astype(np.int64)
        counts = np.zeros(len(rotation), bool)
        counts[group[inside]] = True
        counts[group[started]] = False
        rotates = counts[group]
        begins, inside, group = begins[rotates], inside[rotates], group[rotates]
        arcs = arcs[np.argsort(arcs[:, 1])]
        bounds = np.searchsorted(arcs[:, 1], begins), np.searchsorted(arcs[:, 1], begins, side="right")
        of_group, earlier = expanded(group, arcs[:, 0].astype(np.int64), *bounds)
        sources, of_group = np.concatenate([begins - inside, earlier]), np.concatenate([group, of_group])
        order = np.argsort(group[inside], kind="stable")
        begins, group = begins[inside][order], group[inside][order]
        bounds = np.searchsorted(group, of_group), np.searchsorted(group, of_group, side="right")
        before, after = expanded(sources, begins, *bounds)
        robot_of = np.repeat(np.arange(len(self.first) - 1), np.diff(self.first))
        apart = robot_of[before] != robot_of[after]
        ones = np.ones(int(apart.sum()), np.int64)
        return np.stack([before[apart], after[apart], ones], axis=1).astype(np.int32)
