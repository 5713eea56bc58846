"""Pairs of visits whose order may stay open: whichever way all of them are decided, no robots wait in a cycle.

Su, Veerapaneni and Li, "Bidirectional temporal plan graph: enabling switchable passing orders for more efficient
multi-agent path finding plan execution", AAAI 2024. `mrpbench_native.mapf.open_orders` searches for them, in the graph
of alternatives that `reorder` searches too: an event is the beginning of a move.
"""

import numpy as np
from mrpbench_native.mapf import open_orders

from mrpbench_core.dispatching.dependency_graph import DependencyGraph
from mrpbench_core.model.common.arrays import Int, Int32
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
    moves, resources = graph.moves, graph.resources
    event = np.arange(len(moves.robot)) + moves.robot  # each robot has one more event, for its end

    def arcs(before: Int, after: Int) -> Int32:
        return np.stack([event[before], event[after], np.ones(len(before), np.int64)], axis=1).astype(np.int32)

    planned, switched = (visits.end[first], visits.begin[second]), (visits.end[second], visits.begin[first])
    ends = np.stack([*planned, *switched])
    rotates = np.append(graph.rotation != NONE, False)  # at NONE
    steady = ((ends != NONE) & ~rotates[ends]).all(axis=0)
    in_both = ~steady & (planned[0] != NONE) & (planned[1] != NONE)
    together = np.arange(len(moves.robot) + len(moves.first) - 1)
    together[event] = event[np.array(graph.group, np.int64)]
    fixed = np.concatenate([arcs(planned[0][in_both], planned[1][in_both]), arcs(resources.before, resources.after)])
    order_of_group = np.full(len(first), NONE)
    order_of_group[steady] = open_orders(
        first=(moves.first + np.arange(len(moves.first))).astype(np.int32),
        duration=np.ones(len(together), np.int32),
        fixed=fixed,
        planned=arcs(planned[0][steady], planned[1][steady]),
        switched=arcs(switched[0][steady], switched[1][steady]),
        together=together.astype(np.int32),
        begin=visits.arrival[first[steady]],
        limit=limit,
    )
    return order_of_group
