"""Orders found by the search are those that an independent solver finds, and those that are published."""

import zipfile
from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_dispatchers_reordering import Sadg
from mrpbench_dispatchers_reordering.alternative_graph import sum_of_arrivals
from mrpbench_native.mapf import open_orders, reorder
from mrpbench_tests.instances.switchable import Switchable, read_situation

SITUATIONS = Path(__file__).parents[3] / "shared" / "data" / "stpg" / "situations.zip"
OPTIMA = {
    ("p01", "random-32-32-10_ins_1_an_60"): (1375, 1292),
    ("p01", "random-32-32-10_ins_6_an_60"): (1662, 1550),
    ("p03", "random-32-32-10_ins_1_an_60"): (1806, 1474),
    ("p03", "random-32-32-10_ins_6_an_60"): (2047, 1628),
    ("p01", "warehouse-10-20-10-2-1_ins_1_an_110"): (10816, 10804),
    ("p01", "lak303d_ins_1_an_41"): (10496, 10229),
    ("p01", "Paris_1_256_ins_1_an_120"): (29860, 29786),
}
"""Sums of arrivals in situation 0 in the planned order and in the best one: STPG benchmark, Feng et al., ICAPS 2024."""


@pytest.mark.skipif(not SITUATIONS.exists(), reason="needs shared/data/stpg")
@pytest.mark.parametrize(("folder", "name"), OPTIMA)
def test_published_optima_are_found_and_proved(folder, name):
    with zipfile.ZipFile(SITUATIONS) as archive:
        graph = read_situation(archive, f"{folder}/sit/map_{name}_sit_0.json")
    found = reorder(**graph.arrays(), wall_s=60, memory_bytes=1 << 30)
    assert found.status == "solved"
    assert (found.planned_cost, found.cost) == OPTIMA[folder, name]
    assert found.lower_bound == found.cost


@st.composite
def crossing_robots(draw):
    """Robots that cross a small grid along straight lines, one after another in the plan."""
    size = draw(st.integers(3, 5))
    lines = draw(st.lists(st.tuples(st.booleans(), st.booleans(), st.integers(1, size - 2)), min_size=2, max_size=7))
    paths, taken = [], defaultdict(lambda: -1)
    for robot, (vertical, backwards, offset) in enumerate(lines):
        cells = [(offset, k) if vertical else (k, offset) for k in range(size)]
        cells = [("start", robot), *(cells[::-1] if backwards else cells), ("goal", robot)]
        begin = max(0, *(taken[cell] - k + 2 for k, cell in enumerate(cells)))
        paths.append([(cell, begin + k) for k, cell in enumerate(cells)])
        for cell, tick in paths[-1]:
            taken[cell] = max(taken[cell], tick)
    delays = draw(st.lists(st.sampled_from([0, 0, 3, 10, 20]), min_size=len(paths), max_size=len(paths)))
    return Switchable(paths, [0] * len(paths), delays)


@settings(max_examples=25, deadline=None)
@given(crossing_robots())
def test_an_independent_solver_finds_no_better_order(graph):
    pytest.importorskip("ortools", reason="needs OR-Tools")
    found = reorder(**graph.arrays(), wall_s=60, memory_bytes=1 << 30)
    assert found.status == "solved"
    switched, _ = Sadg(max_deterministic_time=1e3).search(graph.arrays())
    assert found.cost == sum_of_arrivals(graph.arrays(), switched) <= found.planned_cost


def test_arrays_that_make_no_sense_are_refused():
    graph = {"first": np.array([0, 2], np.int32), "duration": np.ones(2, np.int32)}
    arrays = graph | {"wall_s": 1, "memory_bytes": 1}
    none, arc = np.empty((0, 3), np.int32), np.array([[0, 1, 1]], np.int32)
    with pytest.raises(ValueError, match=r"fixed\[0\] connects two events of one robot"):
        reorder(**arrays, fixed=arc, planned=none, switched=none)
    with pytest.raises(ValueError, match="as many switched arcs"):
        reorder(**arrays, fixed=none, planned=arc, switched=none)
    nothing = {"fixed": none, "planned": none, "switched": none, "limit": 1}
    with pytest.raises(ValueError, match="together names an event"):
        open_orders(**graph, **nothing, together=np.array([0, 2], np.int32), begin=np.empty(0, np.int64))
    with pytest.raises(ValueError, match="one value for each pair"):
        open_orders(**graph, **nothing, together=np.array([0, 1], np.int32), begin=np.empty(1, np.int64))
