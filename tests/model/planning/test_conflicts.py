"""The exclusion table against brute force over all pairs."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.model.common.geometry import point_segment_distance, segment_distance
from mrpbench_core.model.planning.conflicts import exclusions
from mrpbench_core.model.planning.roadmap import Roadmap

coordinates = st.integers(0, 6).map(float)


@st.composite
def roadmaps(draw):
    points = draw(st.lists(st.tuples(coordinates, coordinates), min_size=1, max_size=8, unique=True))
    pairs = st.tuples(st.integers(0, len(points) - 1), st.integers(0, len(points) - 1))
    edges = draw(st.lists(pairs.filter(lambda pair: pair[0] != pair[1]), max_size=10, unique=True))
    levels = draw(st.lists(st.integers(0, 1), min_size=len(points), max_size=len(points)))
    return Roadmap(
        position=points,
        level=levels,
        heading=[np.nan] * len(points),
        edges=edges,
        duration=[[1] * len(edges)],
        tick=1.0,
    )


def elements(roadmap):
    return [(v, v) for v in range(len(roadmap.position))] + [tuple(edge) for edge in roadmap.edges]


@given(roadmaps(), st.sampled_from([0.5, 1.0, 1.5, 2.5]))
@settings(deadline=None, max_examples=150)
def test_exclusions_are_exactly_the_pairs_closer_than_the_distance(roadmap, distance):
    table = exclusions(roadmap, distance)
    for x, (a, b) in enumerate(elements(roadmap)):
        expected = []
        for y, (c, d) in enumerate(elements(roadmap)):
            ends = [roadmap.position[i] for i in (a, b, c, d)]
            same_level = {roadmap.level[a], roadmap.level[b]} & {roadmap.level[c], roadmap.level[d]}
            if same_level and segment_distance(*ends) < distance - 1e-9:
                expected.append(y)
        assert table.element[table.first[x] : table.first[x + 1]].tolist() == expected


@given(*[st.tuples(coordinates, coordinates).map(np.array) for _ in range(4)])
@settings(deadline=None, max_examples=200)
def test_segment_distance_equals_the_sampled_distance(a, b, c, d):
    share = np.linspace(0, 1, 121)[:, None]
    sampled = point_segment_distance(a + share * (b - a), c, d).min()
    exact = float(segment_distance(a, b, c, d))
    assert exact <= sampled + 1e-9
    assert sampled - exact <= np.hypot(*(b - a)) / 120 + 1e-9
