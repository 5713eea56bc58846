"""Well-formed tasks, by their definition on small maps."""

from itertools import permutations

import attrs
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_tests.instances.problems import grid_of, problem_on

from mrpbench_core.checking.well_formed import ill_formed


def ways_around(road, endpoints):
    """Whether there is a way between any two endpoints that touches no third, by searching each."""
    for one, other in permutations(endpoints, 2):
        seen, ahead = {one}, [one]
        while ahead:
            vertex = ahead.pop()
            for head in road.edges[road.edges[:, 0] == vertex, 1].tolist():
                if head not in seen and (head == other or head not in endpoints):
                    seen.add(head)
                    ahead.append(head)
        if other not in seen:
            return False
    return True


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_a_verdict_is_that_of_the_definition(data):
    rows = data.draw(st.lists(st.text("..#", min_size=5, max_size=5), min_size=2, max_size=4))
    rows[0] = "..." + rows[0][3:]
    road = grid_of(rows)
    if data.draw(st.booleans()):  # one-way streets
        kept = data.draw(st.lists(st.booleans(), min_size=len(road.edges), max_size=len(road.edges)))
        road = attrs.evolve(road, duration=np.where(kept, road.duration, -1))
        usable = attrs.evolve(road, edges=road.edges[np.array(kept)], duration=road.duration[:, np.array(kept)])
    else:
        usable = road
    vertices = data.draw(st.permutations(range(len(road.position))))
    robots = data.draw(st.integers(1, 2))
    places = np.array(vertices[robots : robots + data.draw(st.integers(1, 4))], np.int64)
    if not len(places):
        return
    problem = problem_on(road, vertices[:robots], vertices[:robots])
    fault = ill_formed(problem, places)
    expected = ways_around(usable, {*vertices[:robots], *places.tolist()})
    assert (fault is None) == expected, fault


def test_starts_must_not_be_places_of_tasks():
    problem = problem_on(grid_of(["....", "...."]), [0, 1], [0, 1])
    assert ill_formed(problem, np.array([1, 7])) == "robot 1 starts at (1, 0), where errands may be"


def test_footprints_block_what_is_near():
    road = grid_of(["........", "........"])
    wide, slim = (problem_on(road, [0, 7], [0, 7], radius=radius) for radius in (0.6, 0.4))
    assert ill_formed(slim, np.array([2, 4])) is None
    assert "passes a third place" in ill_formed(wide, np.array([2, 4]))
    assert "touch each other" in ill_formed(wide, np.array([3, 4]))
