"""Paths in the formats of solvers."""

import pytest
from mrpbench_planners_external.outputs import READERS, UnreadableError

PATHS = [[(0, 1), (0, 2), (0, 2)], [(3, 0), (2, 0), (1, 0)]]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("agents", "Agent 0: (0,1)->(0,2)->(0,2)->\nAgent 1: (3,0)->(2,0)->(1,0)->\n"),
        ("agents", "Agent 1:(3, 0) -> (2, 0) -> (1, 0)\nAgent 0:(0, 1) -> (0, 2) -> (0, 2)"),
        ("steps", "agents=2\nsolved=1\nsolution=\n0:(1,0),(0,3),\n1:(2,0),(0,2),\n2:(2,0),(0,1),\n"),
        (
            "schedule",
            (
                "statistics:\n  cost: 5\nschedule:\n  agent0:\n    - {x: 1, y: 0, t: 0}\n    - {x: 2, y: 0, t: 1}\n"
                "    - {x: 2, y: 0, t: 2}\n  agent1:\n    - {x: 0, y: 3, t: 0}\n    - {x: 0, y: 2, t: 1}\n"
                "    - {x: 0, y: 1, t: 2}\n"
            ),
        ),
    ],
)
def test_every_format_gives_rows_and_columns(name, text):
    assert READERS[name](text) == PATHS


def test_a_state_of_a_schedule_lasts_until_the_next():
    text = "schedule:\n  agent0: [{x: 0, y: 0, t: 0}, {x: 1, y: 0, t: 3}]"
    assert READERS["schedule"](text) == [[(0, 0), (0, 0), (0, 0), (0, 1)]]


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("agents", "no paths at all", "no Agent 0"),
        ("agents", "Agent 1: (0,0)->", "no Agent 0"),
        ("agents", "Agent 0: (0,0)->\nAgent 2: (0,0)->", "no Agent 1"),
        ("steps", "solution=\n0:(1,0),(0,3),\n1:(2,0),", "different numbers of robots"),
        ("steps", "solved=0", "no time step 0"),
        ("schedule", "{", "not YAML"),
        ("schedule", "cost: 3", "no `schedule`"),
        ("schedule", "schedule: {agent0: 5}", "not of the form"),
        ("schedule", "schedule: {agent0: [{x: 1, t: 0}]}", "not of the form"),
        ("schedule", "schedule: {you: []}", "has no number"),
        ("schedule", "[" * 5000, "not YAML"),
        ("schedule", "schedule: {agent999999999: [{x: 0, y: 0, t: 0}]}", "no robot 0"),
        ("schedule", "schedule: {agent0: [{x: 0, y: 0, t: 2}]}", "time step 2 does not come after"),
        ("schedule", "schedule: {agent0: [{x: 0, y: 0, t: 0}, {x: 0, y: 0, t: 0}]}", "does not come after time step 0"),
        ("schedule", "schedule: {agent0: [{x: 0, y: 0, t: 0}, {x: 0, y: 0, t: 99999999999}]}", "99999999999"),
        ("schedule", "schedule: {agent0: [{x: .inf, y: 0, t: 0}]}", "not of the form"),
        ("agents", "Agent 999999999: (0,0)->", "no Agent 0"),
        ("agents", f"Agent {'9' * 9999}: (0,0)->", "no Agent 0"),
        ("steps", "999999999:(1,0),", "no time step 0"),
        ("agents", "\x00\ufffd\x7f" * 100, "no Agent 0"),
    ],
)
def test_other_text_is_refused_with_the_reason(name, text, said):
    with pytest.raises(UnreadableError, match=said):
        READERS[name](text)
