"""The bindings themselves; what the solvers do is tested in C++ and with the planners."""

import ast
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from mrpbench_native import mapf


def swap(**changes) -> dict:
    """Two robots that would have to pass one another on a single edge."""
    arrays = {
        "position": np.array([[0.0, 0.0], [1.0, 0.0]]),
        "edges": np.array([[0, 1], [1, 0]], "i4"),
        "duration": np.ones((1, 2), "i4"),
        "profile": np.zeros(2, "i4"),
        "radius": np.zeros(2),
        "start": np.array([0, 1], "i4"),
        "ready": np.zeros(2, "i8"),
        "goal_first": np.array([0, 1, 2]),
        "goal": np.array([1, 0], "i4"),
        "committed_first": np.zeros(3, "i8"),
        "committed_edge": np.empty(0, "i4"),
        "committed_enter": np.empty(0, "i8"),
        "committed_leave": np.empty(0, "i8"),
        "exclusion_first": np.empty(0, "i8"),
        "exclusion_element": np.empty(0, "i4"),
        "exclusion_distance": np.empty(0),
        "resource_first": np.zeros(1, "i8"),
        "resource_element": np.empty(0, "i4"),
        "resource_capacity": np.empty(0, "i4"),
        "resource_setup": np.empty(0, "i8"),
        "following_forbidden": False,
        "disappear_at_goal": False,
    }
    return arrays | changes


def test_answers_outlive_what_they_came_from():
    enter = mapf.astar(mapf.Instance(**swap()), heuristic="exact", wall_s=1.0, memory_bytes=1 << 30).enter
    assert enter.tolist() == [0, 0]
    assert not enter.flags.writeable


@pytest.mark.parametrize(
    ("changes", "error"),
    [
        ({"edges": np.array([[0, 1], [1, 0]], "i8")}, TypeError),
        ({"edges": np.array([0, 1], "i4")}, TypeError),
        ({"duration": np.ones((1, 3), "i4")}, ValueError),
        ({"profile": np.zeros(1, "i4")}, ValueError),
        ({"profile": np.ones(2, "i4")}, ValueError),
        ({"radius": np.array([0.1, np.nan])}, ValueError),
        ({"goal_first": np.array([0, 2, 1])}, ValueError),
        ({"goal_first": np.array([0, 0, 2])}, ValueError),
        ({"goal": np.array([1, 2], "i4")}, ValueError),
        ({"ready": np.array([0, 1 << 40])}, ValueError),
        ({"ready": np.array([0, -1])}, ValueError),
        ({"exclusion_first": np.array([0, 1])}, ValueError),
    ],
)
def test_arrays_that_do_not_fit_are_refused(changes, error):
    with pytest.raises(error):
        mapf.Instance(**swap(**changes))


def test_unknown_choices_are_refused():
    with pytest.raises(ValueError, match="'best' is none of: "):
        mapf.astar(mapf.Instance(**swap()), heuristic="best", wall_s=1.0, memory_bytes=1 << 30)


def test_python_runs_on_while_a_solver_works():
    instance = mapf.Instance(**swap(duration=np.full((1, 2), 2, "i4")))  # with moves of one tick it is soon proved
    worker = threading.Thread(target=mapf.cbs, args=(instance,), kwargs={"wall_s": 0.5, "memory_bytes": 1 << 31})
    worker.start()
    turns = 0
    while worker.is_alive():
        turns += 1
        time.sleep(0.01)
    assert turns > 5


def test_the_stub_names_what_the_module_has():
    stub = ast.parse((Path(__file__).parent.parent / "python/mrpbench_native/mapf.pyi").read_text())
    for item in stub.body:
        if isinstance(item, ast.ClassDef):
            declared = {member.name for member in item.body if isinstance(member, ast.FunctionDef)} - {"__init__"}
            assert declared == {name for name in dir(getattr(mapf, item.name)) if not name.startswith("_")}
    declared = {item.name for item in stub.body if isinstance(item, ast.FunctionDef | ast.ClassDef)}
    assert declared == {name for name in dir(mapf) if not name.startswith("_")}
