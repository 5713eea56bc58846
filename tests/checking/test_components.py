from itertools import pairwise

from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.checking.components import components


@settings(deadline=None, max_examples=200)
@given(
    st.integers(1, 30).flatmap(
        lambda n: st.tuples(st.just(n), st.lists(st.tuples(st.integers(0, n - 1), st.integers(0, n - 1)), max_size=40))
    )
)
def test_labels_are_the_least_vertex_that_can_be_reached(graph):
    count, edges = graph
    neighbours = {vertex: {vertex} for vertex in range(count)}
    for a, b in edges:
        neighbours[a].add(b)
        neighbours[b].add(a)
    for vertex, label in enumerate(components(count, edges)):
        reached, frontier = {vertex}, [vertex]
        while frontier:
            fresh = neighbours[frontier.pop()] - reached
            reached |= fresh
            frontier += fresh
        assert label == min(reached)


def test_a_long_chain_is_one_component():
    order = list(range(0, 1000, 2)) + list(range(1, 1000, 2))
    assert set(components(1000, list(pairwise(order)))) == {0}


def test_nothing_has_no_components():
    assert len(components(0, [])) == 0
