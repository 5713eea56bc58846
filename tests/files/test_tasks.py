"""Tables of tasks give what their cells say, and name the line of a mistake."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.tasks import read_tasks

PLACES = {"returns": ((1.0, 2.0, math.nan), 0), "lift lobby": ((3.0, 4.0, math.nan), 1)}


def find(name):
    if name not in PLACES:
        raise InputError(f"no vertex {name!r}", hint="names are returns, lift lobby")
    return PLACES[name]


TABLE = """\
release,errands,service,deadline,priority,name
12.5,returns;lift lobby,5,,,
0,3.0 4.5;1.5 2 1;0 0 2 1.5,2;0;8,120,-1,"urgent, large"
"""


def test_a_table_is_understood(tmp_path):
    path = tmp_path / "tasks.csv"
    path.write_text(TABLE)
    first, second = read_tasks(path, find)
    assert (first.line, second.line) == (2, 3)
    assert first.task.goals[:, :2].tolist() == [[1, 2], [3, 4]]
    assert first.task.levels.tolist() == [0, 1]
    assert first.task.service.tolist() == [5, 5]
    assert (first.task.release, first.task.deadline, first.task.priority) == (12.5, math.inf, 0)
    assert second.task.goals[2].tolist() == [0, 0, 1.5]
    assert second.task.levels.tolist() == [0, 1, 2]
    assert second.task.service.tolist() == [2, 0, 8]
    assert (second.task.deadline, second.task.priority, second.task.name) == (120, -1, "urgent, large")


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("tasks.csv", "errands,service\nreturns| 3 4 1 |5 6;lift lobby,2\n"),
        (
            "tasks.yaml",
            "tasks:\n- goals: [[returns, {x: 3, y: 4, level: 1}, {x: 5, y: 6}], lift lobby]\n  service: 2\n",
        ),
    ],
)
def test_an_errand_may_have_several_places(tmp_path, name, text):
    path = tmp_path / name
    path.write_text(text)
    (only,) = read_tasks(path, find)
    assert only.task.goals[:, :2].tolist() == [[1, 2], [3, 4], [5, 6], [3, 4]]
    assert only.task.errand.tolist() == [0, 0, 0, 1]
    assert only.task.levels.tolist() == [0, 1, 0, 1]
    assert only.task.service.tolist() == [2, 2]


def test_an_errand_without_a_place_is_located(tmp_path):
    path = tmp_path / "tasks.yaml"
    path.write_text("tasks:\n- goals: [returns, []]\n")
    with pytest.raises(InputError, match=r"tasks.yaml:2:20: an errand needs a place"):
        read_tasks(path, find)
    path.write_text("tasks:\n- goals: [[returns, [returns]]]\n")
    with pytest.raises(InputError, match=r"tasks.yaml:2:21: must be a mapping with x, y"):
        read_tasks(path, find)


def test_places_and_tasks_named_like_numbers_keep_their_spelling(tmp_path):
    path = tmp_path / "tasks.yaml"
    path.write_text("tasks:\n- {name: 007, goals: [1.10, [1E3, 1.10]]}\n")
    asked = []
    (only,) = read_tasks(path, lambda name: (asked.append(name), PLACES["returns"])[1])
    assert (only.task.name, asked) == ("007", ["1.10", "1E3", "1.10"])


@pytest.mark.parametrize("name", ["tasks.json", "tasks.yaml"])
def test_json_is_understood_with_names_and_places_in_metres(tmp_path, name):
    path = tmp_path / name
    path.write_text(
        '{"tasks": [\n{"goals": ["returns", {"x": 1, "y": 2, "level": 1}],\n'
        '"service": [1, 0], "deadline": 9, "priority": 2}]}'
    )
    (only,) = read_tasks(path, find)
    assert only.line == 2
    assert only.task.goals[:, :2].tolist() == [[1, 2], [1, 2]]
    assert only.task.levels.tolist() == [0, 1]
    assert only.task.service.tolist() == [1, 0]
    assert (only.task.deadline, only.task.priority) == (9, 2)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("errands", "errand", ":1: unknown column 'errand' (did you mean 'errands'?)"),
        ("release", "errands", ":1: the first line must name the column 'errands', and each column once"),
        ("returns", "return", ":2: errands: no vertex 'return' (names are returns, lift lobby)"),
        ("returns;", ";", ":2: errands: a place is empty (errands are separated by ';', places of one errand by '|')"),
        (
            "returns;",
            "returns|;",
            ":2: errands: a place is empty (errands are separated by ';', places of one errand by '|')",
        ),
        ("returns", "returns|docks", ":2: errands: no vertex 'docks' (names are returns, lift lobby)"),
        ("12.5", "-1", ":2: release: must not be negative"),
        ("12.5", "soon", ":2: release: 'soon' is not a finite number"),
        (",5,", ",5;5;5,", ":2: service: has 3 times instead of 1 or 2"),
        ("0 0 2 1.5", "0 0 0.5", ":3: errands: '0 0 0.5' is not a place (x y, x y level or x y level yaw)"),
        ("0 0 2 1.5", "0 0 2 1.5 7", ":3: errands: '0 0 2 1.5 7' is not a place (x y, x y level or x y level yaw)"),
        ("-1", "1.5", ":3: priority: '1.5' is not a whole number"),
        ("-1,", "", ":3: has 5 cells instead of 6"),
        ('large"', "large", ":3: is not CSV: unexpected end of data"),
    ],
)
def test_a_mistake_in_a_table_is_located(tmp_path, old, new, message):
    assert old in TABLE
    path = tmp_path / "tasks.csv"
    path.write_text(TABLE.replace(old, new, 1))
    with pytest.raises(InputError) as error:
        read_tasks(path, find)
    assert str(error.value) == f"{path}{message}"


def test_an_unknown_name_in_yaml_is_located(tmp_path):
    path = tmp_path / "tasks.yaml"
    path.write_text("tasks:\n  - goals: [returns, docks]\n")
    with pytest.raises(InputError, match=r"tasks.yaml:2:22: no vertex 'docks' \(names are"):
        read_tasks(path, find)


@settings(max_examples=50)
@given(st.text(max_size=60) | st.text('errands,;\n"0.5 -e', max_size=60))
def test_any_text_gives_tasks_or_one_error(tmp_path_factory, text):
    path = tmp_path_factory.getbasetemp() / "any.csv"
    path.write_text(text, encoding="utf-8")
    try:
        assert all(len(entry.task.goals) > 0 for entry in read_tasks(path, find))
    except InputError as error:
        lines = str(error).splitlines()
        assert len(lines) == 1
