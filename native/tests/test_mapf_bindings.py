"""The bindings themselves; what the solvers do is tested in C++ and with the planners."""

import ast
import re
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_native import mapf
from scipy.optimize import linear_sum_assignment
from scipy.sparse.csgraph import dijkstra

LIMITS = {"wall_s": 1.0, "memory_bytes": 1 << 30}
NONE = {"first": np.empty(0, "i8"), "element": np.empty(0, "i4")}


def swap(**changes) -> dict:
    """Two robots that would have to pass one another on a single edge; changes as `part__array`."""
    problem = {
        "roadmap": {
            "position": np.array([[0.0, 0.0], [1.0, 0.0]]),
            "edges": np.array([[0, 1], [1, 0]], "i4"),
            "duration": np.ones((1, 2), "i4"),
        },
        "robots": {
            "profile": np.zeros(2, "i4"),
            "radius": np.zeros(2),
            "start": np.array([0, 1], "i4"),
            "ready": np.zeros(2, "i8"),
            "goal_first": np.array([0, 1, 2]),
            "via_first": np.array([0, 0, 1]),
            "via_goal_first": np.array([0, 2]),
            "via_goal": np.array([0, 1], "i4"),
            "goal": np.array([1, 0], "i4"),
            "rank": np.zeros(2, "i4"),
            "committed_first": np.zeros(3, "i8"),
            "committed_edge": np.empty(0, "i4"),
            "committed_enter": np.empty(0, "i8"),
            "committed_leave": np.empty(0, "i8"),
        },
        "exclusions": {**NONE, "distance": np.empty(0)},
        "resources": {
            **NONE,
            "first": np.zeros(1, "i8"),
            "capacity": np.empty(0, "i4"),
            "setup": np.empty(0, "i8"),
        },
        "following_forbidden": False,
        "disappear_at_goal": False,
    }
    for name, array in changes.items():
        part, _, key = name.partition("__")
        problem[part][key] = array
    return problem


def test_arrays_outlive_the_answer_that_owns_them():
    enter = mapf.solve(mapf.Instance(**swap()), "astar", {}, **LIMITS).enter
    assert enter.tolist() == [0, 0]
    assert not enter.flags.writeable


@pytest.mark.parametrize(
    ("changes", "error"),
    [
        ({"roadmap__edges": np.array([[0, 1], [1, 0]], "i8")}, TypeError),
        ({"roadmap__edges": np.array([0, 1], "i4")}, TypeError),
        ({"roadmap__duration": np.ones((1, 3), "i4")}, ValueError),
        ({"robots__profile": np.zeros(1, "i4")}, ValueError),
        ({"robots__profile": np.ones(2, "i4")}, ValueError),
        ({"robots__radius": np.array([0.1, np.nan])}, ValueError),
        ({"robots__goal_first": np.array([0, 2, 1])}, ValueError),
        ({"robots__goal_first": np.array([0, 0, 2])}, ValueError),
        ({"robots__via_first": np.array([0, 1, 2])}, ValueError),
        ({"robots__via_goal_first": np.empty(0, "i8")}, ValueError),
        ({"robots__via_goal": np.array([0, 9], "i4")}, ValueError),
        ({"robots__goal": np.array([1, 2], "i4")}, ValueError),
        ({"robots__ready": np.array([0, 1 << 40])}, ValueError),
        ({"robots__ready": np.array([0, -1])}, ValueError),
        ({"exclusions__first": np.array([0, 1])}, ValueError),
    ],
)
def test_arrays_that_do_not_fit_are_refused(changes, error):
    with pytest.raises(error):
        mapf.Instance(**swap(**changes))


def test_a_missing_array_is_named():
    problem = swap()
    del problem["robots"]["goal"]
    with pytest.raises(TypeError, match=r"robots\['goal'\] is missing"):
        mapf.Instance(**problem)


@pytest.mark.parametrize(("name", "options"), [("magic", {}), ("astar", {"w": 1.5}), ("astar", {"heuristic": "best"})])
def test_unknown_algorithms_options_and_choices_are_refused(name, options):
    with pytest.raises(ValueError, match=r"magic|astar: there is no option 'w'|astar: heuristic must be one of exact"):
        mapf.solve(mapf.Instance(**swap()), name, options, **LIMITS)


def test_python_threads_run_during_a_solve():
    slow = np.full((1, 2), 2, "i4")  # with moves of one tick it is soon proved that there is no plan
    instance = mapf.Instance(**swap(roadmap__duration=slow))
    limits = {"wall_s": 0.5, "memory_bytes": 1 << 31}
    worker = threading.Thread(target=mapf.solve, args=(instance, "cbs", {}), kwargs=limits)
    worker.start()
    turns = 0
    while worker.is_alive():
        turns += 1
        time.sleep(0.01)
    assert turns > 5


def arguments_of(function) -> list[str]:
    """From the signature that nanobind makes, which is the only one."""
    ((signature, *_),) = function.__nb_signature__
    return [name for name in re.findall(r"(\w+):", signature) if name != "self"]


def test_the_stub_names_what_the_module_has():
    stub = ast.parse((Path(__file__).parent.parent / "python/mrpbench_native/mapf.pyi").read_text())
    for item in stub.body:
        if isinstance(item, ast.ClassDef):
            declared = {member.name for member in item.body if isinstance(member, ast.FunctionDef)} - {"__init__"}
            assert declared == {name for name in dir(getattr(mapf, item.name)) if not name.startswith("_")}
        if isinstance(item, ast.FunctionDef):
            arguments = [*item.args.args, *item.args.kwonlyargs]
            assert [argument.arg for argument in arguments] == arguments_of(getattr(mapf, item.name))
    declared = {item.name for item in stub.body if isinstance(item, ast.FunctionDef | ast.ClassDef)}
    assert declared == {name for name in dir(mapf) if not name.startswith("_")}


@pytest.mark.parametrize("seed", range(4))
def test_lengths_of_paths_are_those_of_scipy(seed):
    random = np.random.default_rng(seed)
    ends, length = random.integers(0, 30, (60, 2)).astype("i4"), random.choice([0.5, 1.0, 2.0, 3.7], 60)
    sources, targets = random.permutation(30)[:4].astype("i4"), random.integers(0, 30, 7).astype("i4")
    least = np.full((30, 30), np.inf)  # of parallel edges the shortest counts
    np.minimum.at(least, (ends[:, 0], ends[:, 1]), length)
    expected = dijkstra(least, indices=sources)[:, targets]
    assert mapf.path_lengths(30, ends, length, sources, targets) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("changed", "error"),
    [
        ({"edges": [[0, 3]]}, "an edge ends at a vertex that does not exist"),
        ({"edges": [[0, 1, 2]]}, "edges have two ends and a length each"),
        ({"length": [-1.0]}, "lengths are not below 0"),
        ({"length": [np.nan]}, "lengths are not below 0"),
        ({"sources": [-1]}, "a vertex does not exist"),
        ({"targets": [3]}, "a vertex does not exist"),
    ],
)
def test_paths_on_no_graph_are_refused(changed, error):
    given = {"edges": [[0, 1]], "length": [1.0], "sources": [0], "targets": [1]} | changed
    with pytest.raises(ValueError, match=error):
        mapf.path_lengths(3, *(np.array(value, "f8" if name == "length" else "i4") for name, value in given.items()))


def matrices(random, rows, columns):
    """Costs with and without ties."""
    here, there = random.integers(0, 8, (rows, 2)), random.integers(0, 8, (columns, 2))
    return {
        "normal": random.normal(size=(rows, columns)),
        "whole": random.integers(-2, 3, (rows, columns)) * 1.0,
        "hundred": random.integers(0, 100, (rows, columns)) * 1.0,
        "grid": np.abs(here[:, None] - there[None]).sum(axis=-1) * 1.0,
        "product": np.outer(np.arange(rows), np.arange(columns)) * 1.0,
        "equal": np.zeros((rows, columns)),
        "scales": 10.0 ** random.integers(-6, 7, (rows, columns)),
    }


@settings(deadline=None, max_examples=200)
@given(data=st.data())
def test_assignments_cost_what_those_of_scipy_do(data):
    rows = data.draw(st.one_of(st.integers(0, 12), st.integers(60, 140)))
    columns = rows + data.draw(st.sampled_from([0, 1, 5, 70]))
    random = np.random.default_rng(data.draw(st.integers(0, 2**32)))
    kinds = matrices(random, rows, columns)
    cost = kinds[data.draw(st.sampled_from(sorted(kinds)))]
    cost[random.random((rows, columns)) < data.draw(st.sampled_from([0.0, 0.3, 0.7, 0.95]))] = np.inf
    found, least = mapf.cheapest_assignment(cost), mapf.bottleneck(cost)
    if found is None:
        assert least is None
        with pytest.raises(ValueError, match="infeasible"):
            linear_sum_assignment(cost)
        return
    assert len(set(found.tolist())) == rows
    assert cost[range(rows), found].sum() == pytest.approx(cost[linear_sum_assignment(cost)].sum())
    if rows:
        assert least in cost
        assert mapf.cheapest_assignment(np.where(cost <= least, cost, np.inf)) is not None
        assert mapf.cheapest_assignment(np.where(cost < least, cost, np.inf)) is None


@pytest.mark.parametrize(
    ("cost", "error"),
    [([[1.0], [2.0]], "more rows than columns"), ([[np.nan]], "costs are numbers"), ([[-np.inf]], "costs are numbers")],
)
def test_matrices_that_are_no_costs_are_refused(cost, error):
    with pytest.raises(ValueError, match=error):
        mapf.cheapest_assignment(np.array(cost))
