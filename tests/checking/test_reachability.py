"""Components and reachability against transitive closure."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.checking.reachability import reachable, round_trips
from mrpbench_core.model.planning.roadmap import Roadmap


def roadmap_of(count, arcs):
    return Roadmap(
        position=np.zeros((count, 2)),
        level=[0] * count,
        heading=[np.nan] * count,
        edges=[(tail, head) for tail, head, _ in arcs],
        duration=[[ticks for _, _, ticks in arcs]],
        tick=1.0,
    )


def closure(count, arcs):
    """Warshall's matrix of who reaches whom."""
    reach = np.eye(count, dtype=bool)
    for tail, head, ticks in arcs:
        reach[tail, head] |= ticks >= 0
    for middle in range(count):
        reach |= reach[:, [middle]] & reach[[middle]]
    return reach


def graphs(both_ways):
    def arcs(count):
        arc = st.tuples(st.integers(0, count - 1), st.integers(0, count - 1), st.sampled_from([-1, 1, 2]))
        return st.tuples(st.just(count), st.lists(arc, max_size=25))

    doubled = st.integers(1, 12).flatmap(arcs)
    return doubled.map(lambda graph: (graph[0], graph[1] + [(b, a, t) for a, b, t in graph[1]] * both_ways))


@settings(deadline=None, max_examples=200)
@given(graph=graphs(True) | graphs(False))
def test_vertices_share_a_label_where_there_is_a_way_and_a_way_back(graph):
    label = round_trips(roadmap_of(*graph), 0)
    reach = closure(*graph)
    assert np.array_equal(label[:, None] == label[None, :], reach & reach.T)


@settings(deadline=None, max_examples=100)
@given(graph=graphs(True) | graphs(False))
def test_reachable_is_the_transitive_closure(graph):
    roadmap = roadmap_of(*graph)
    reach = closure(*graph)
    for source in range(graph[0]):
        assert np.array_equal(reachable(roadmap, 0, source), reach[source])


def test_a_long_one_way_ring_needs_no_recursion():
    count = 20_000
    ring = [(vertex, (vertex + 1) % count, 1) for vertex in range(count)]
    assert len(set(round_trips(roadmap_of(count, ring), 0).tolist())) == 1
    assert len(set(round_trips(roadmap_of(count, ring[:-1]), 0).tolist())) == count
