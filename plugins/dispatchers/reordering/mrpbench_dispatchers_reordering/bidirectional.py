"""Pairs of visits whose order may stay open: whichever way all of them are decided, no robots wait in a cycle.

Su, Veerapaneni and Li, "Bidirectional temporal plan graph: enabling switchable passing orders for more efficient
multi-agent path finding plan execution", AAAI 2024. Pairs that can only be switched together, such as those along a
corridor, form a group. A group stays open if its switched arcs close no cycle with the arcs of the plan and with the
switched arcs of all groups that are open already. That search does not exclude cycles that use both arcs of another
pair, which no choice of orders contains: it opens fewer groups than possible, and never one that is not safe.
"""

from collections import defaultdict

import numpy as np

from mrpbench_core.checking.strong_components import strong_components
from mrpbench_core.dispatching.dependency_graph import DependencyGraph
from mrpbench_core.model.common.arrays import Bool, Int
from mrpbench_dispatchers_reordering.visits import NONE, Pairs, Visits


def open_groups(graph: DependencyGraph, visits: Visits, pairs: Pairs, limit: int) -> Int:
    """The group i8[k] of each pair whose order stays open, `NONE` for the others.

    Args:
        graph: of the plan's order.
        visits: of the plan.
        pairs: in the plan's order.
        limit: number of groups that are tried, those of the earliest visits first.
    """
    first, second = pairs
    rotates = np.isin(np.arange(len(graph.moves.robot)), [move for moves in graph.rotations.values() for move in moves])
    rotates = np.append(rotates, False)  # at NONE
    steady = np.ones(len(first), bool)
    for visit in (first, second):
        for move in (visits.begin[visit], visits.end[visit]):
            steady &= (move != NONE) & ~rotates[move]
    arcs = _Arcs(graph, visits, pairs)
    groups = [group for group in _together(visits, pairs) if steady[group].all()]
    groups.sort(key=lambda group: int(visits.arrival[first[group]].min()))
    found = np.full(len(first), NONE)
    for number, group in enumerate(groups[:limit]):
        if arcs.open(group):
            found[group] = number
    return found


def _together(visits: Visits, pairs: Pairs) -> list[Int]:
    """Groups of pairs of which none can be switched without the others.

    Let robot i pass before robot j in the pairs p and q. If p alone is switched, i begins its visit of p after j has
    ended its own. That is a cycle if i needs that visit to end its visit of q, and j its visit of q to end that of p.
    """
    first, second = pairs
    of_robots = defaultdict(list)
    for pair, robots in enumerate(zip(visits.robot[first].tolist(), visits.robot[second].tolist(), strict=True)):
        of_robots[robots].append(pair)
    groups = []
    for own in of_robots.values():
        index = np.array(own)
        i_begin, i_end = visits.begin[first[index]], visits.end[first[index]]
        j_begin, j_end = visits.begin[second[index]], visits.end[second[index]]
        ends = np.where(i_end == NONE, np.iinfo(np.int64).max, i_end)
        forced = (i_begin[:, None] <= ends[None]) & (j_begin[None] <= j_end[:, None])
        one, other = np.nonzero(forced & ~np.eye(len(index), dtype=bool))
        joined = strong_components(one.tolist(), other.tolist())
        single = np.setdiff1d(np.arange(len(index)), [pair for group in joined for pair in group])
        groups += [index[list(group)] for group in joined] + [index[[pair]] for pair in single.tolist()]
    return groups


class _Arcs:
    """Arcs from the end of one move to the beginning of another, and those that open pairs add."""

    def __init__(self, graph: DependencyGraph, visits: Visits, pairs: Pairs) -> None:
        moves, resources, (first, second) = graph.moves, graph.resources, pairs
        self._robot, self._first = moves.robot, moves.first
        ahead = visits.end[first], visits.begin[second]
        self._switched = visits.end[second], visits.begin[first]
        rotating = [
            (one, other) for moves in graph.rotations.values() for one in moves for other in moves if one != other
        ]
        together = np.array(rotating, np.int64).reshape(-1, 2)
        nothing = np.full(len(first), NONE)  # the switched arcs, once they are open
        self._before = np.concatenate([ahead[0], nothing, resources.before, together[:, 0]])
        self._after = np.concatenate([ahead[1], nothing, resources.after, together[:, 1]])
        self._pairs = len(first)

    def open(self, group: Int) -> bool:
        """Add the switched arcs of a group if they close no cycle; tell whether they have been added."""
        end, begin = self._switched[0][group], self._switched[1][group]
        kept = (self._before != NONE) & (self._after != NONE)
        kept[group] = False
        if self._reaches(kept, begin, end):
            return False
        self._before[self._pairs + group], self._after[self._pairs + group] = end, begin
        return True

    def _reaches(self, kept: Bool, begin: Int, end: Int) -> bool:
        """Tell whether a move of `end` follows from one of `begin`, by the arcs `kept` and along paths."""
        before, after = self._before[kept], self._after[kept]
        source, target = self._robot[before], self._robot[after]
        earliest = self._first[1:].copy()
        """The earliest move i8[n] of each robot that follows."""
        np.minimum.at(earliest, self._robot[begin], begin)
        while True:
            if (earliest[self._robot[end]] <= end).any():
                return True
            follows = (before >= earliest[source]) & (after < earliest[target])
            if not follows.any():
                return False
            np.minimum.at(earliest, target[follows], after[follows])
