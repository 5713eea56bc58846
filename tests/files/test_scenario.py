"""Scenario files give back exactly what was written, and say where a mistake is."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.scenario import read_scenario, write_scenario
from mrpbench_core.model.planning.scenario import Scenario, Task

NUMBER = st.floats(allow_nan=False, allow_infinity=False)
POSE = st.tuples(NUMBER, NUMBER, NUMBER | st.just(math.nan))
NAME = st.text(st.characters(exclude_categories=["Cs"]), max_size=8) | st.sampled_from(
    ["on", "1e-3", "null", "a: b", '"']
)
LEVEL = st.integers(0, 3)
PLACES = st.lists(st.tuples(POSE, LEVEL), min_size=1, max_size=3)
TASK = st.builds(
    lambda places, apart, name, release, service, deadline, priority: Task(
        goals=[pose for pose, _ in places],
        errand=(errand := np.cumsum([0, *apart[1 : len(places)]])),
        levels=[level for _, level in places],
        name=name,
        release=release,
        service=service[: errand[-1] + 1],
        deadline=deadline,
        priority=priority,
    ),
    PLACES,
    st.lists(st.booleans(), min_size=3, max_size=3),
    NAME,
    st.floats(0, 1e6),
    st.lists(st.floats(0, 1e3), min_size=3, max_size=3),
    st.floats(0, 1e6) | st.just(math.inf),
    st.integers(-3, 3),
)


@st.composite
def scenarios(draw):
    starts = draw(st.lists(st.tuples(POSE, LEVEL), max_size=3))
    names = draw(st.lists(NAME, min_size=len(starts), max_size=len(starts)))
    return Scenario(
        start=np.array([pose for pose, _ in starts]).reshape(-1, 3),
        start_level=[level for _, level in starts],
        start_names=tuple(names) if any(names) else (),
        tasks=tuple(draw(st.lists(TASK, max_size=3))),
    )


@settings(deadline=None, max_examples=200)
@given(scenario=scenarios())
def test_a_scenario_is_read_as_it_was_written(scenario, tmp_path_factory):
    path = tmp_path_factory.mktemp("scenario") / "s.yaml"
    write_scenario(path, scenario)
    again = read_scenario(path)
    assert again == scenario
    assert again.id == scenario.id


GOOD = """\
mrpbench_scenario: 1
robots:
  - {name: puffin, x: 1, y: 2.5}
tasks:
  - {goals: [{x: 0.0, y: 0.0, level: 1}, {x: 3, y: 4, yaw: 1.5}], release: 2}
"""


def test_a_file_written_by_hand_is_understood(tmp_path):
    path = tmp_path / "s.yaml"
    path.write_text(GOOD)
    scenario = read_scenario(path)
    assert scenario.start_names == ("puffin",)
    assert scenario.start[0, :2].tolist() == [1, 2.5]
    assert math.isnan(scenario.start[0, 2])
    (task,) = scenario.tasks
    assert task.goals[1].tolist() == [3, 4, 1.5]
    assert task.levels.tolist() == [1, 0]
    assert task.release == 2


def test_a_name_like_a_number_keeps_its_spelling(tmp_path):
    path = tmp_path / "s.yaml"
    path.write_text(GOOD.replace("puffin", "1.10"))
    assert read_scenario(path).start_names == ("1.10",)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("scenario: 1", "scenario: 2", ":1:20: format version 2 is unknown (use 1)"),
        ("robots:", "robot:", ":2:1: unknown key 'robot' (did you mean 'robots'?)"),
        ("x: 1,", "x: far,", ":3:23: must be a finite number"),
        ("x: 1,", "x: .inf,", ":3:23: must be a finite number"),
        ("x: 1, ", "", ":3:5: lacks 'x'"),
        ("name: puffin", "name: [7]", ":3:12: must be text"),
        ("{x: 0.0, y: 0.0, level: 1}", "[0, 0]", ":5:15: must be a mapping with x, y"),
        ("level: 1", "level: -1", ":5:38: must be the index of a level, from 0"),
        ("release: 2", "release: -2", ":5:76: must not be negative"),
        ("[{x: 0.0, y: 0.0, level: 1}, {x: 3, y: 4, yaw: 1.5}]", "[]", ":5:13: a task needs a goal"),
        ("robots:\n  - {name: puffin, x: 1, y: 2.5}", "robots: 3", ":2:9: must be a list"),
    ],
)
def test_a_mistake_is_located(tmp_path, old, new, message):
    assert old in GOOD
    path = tmp_path / "s.yaml"
    path.write_text(GOOD.replace(old, new))
    with pytest.raises(InputError) as error:
        read_scenario(path)
    assert str(error.value) == f"{path}{message}"


def test_a_missing_or_empty_file_is_one_line(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        read_scenario(tmp_path / "none.yaml")
    path = tmp_path / "s.yaml"
    path.write_text("[]")
    with pytest.raises(InputError, match="must be a mapping"):
        read_scenario(path)
