"""Hints for what users often write in another place."""

import pytest

SMALL = "world: office\nscenario: {robots: 5}\n"


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("planner: [ecbs, astar]", "write `matrix: {planner: [ecbs, astar]}`)"),
        ("planner: {plugin: [ecbs, astar]}", "write `matrix: {planner: [ecbs, astar]}`)"),
        ("planner: {plugin: ecbs, w: [1.1, 1.2]}", "write `matrix: {planner.w: [1.1, 1.2]}`)"),
        ("planner: [{plugin: ecbs, w: 2}, astar]", "write `matrix: {planner: […]}`)"),
        ("planner: ecbs\nseed: [1, 2]", "seed: expected a whole number, got a list (for a run with each, write"),
        ("planner: ecbs\nw: 1.2", "some.yaml:4:1: w: unknown key (did you mean `planner.w`?)"),
        ("planner: {plugin: ecbs}\nw: 1.2", "some.yaml:4:1: w: unknown key (did you mean `planner.w`?)"),
        ("planner: ecbs\nmemory: 4 GiB", "memory: unknown key (did you mean `limits.memory`?)"),
        ("planner: ecbs\nrobots: 3", "robots: unknown key (did you mean `scenario.robots`?)"),
        ("planner: {plugin: astar, w: 1.2}", "planner.w: unknown option of 'astar' (ecbs has it)"),
        ("planner: {plugin: astar, qqq: 1.2}", "planner.qqq: unknown option of 'astar' (it has none)"),
        ("planner: {plugin: nothing}\nw: 1.2", "w: unknown key (there are name, "),
    ],
)
def test_the_hint_names_the_place(errors, text, line):
    assert any(line in found for found in errors(SMALL + text)), errors(SMALL + text)


def test_a_tuple_of_the_wrong_length_is_not_for_the_matrix(errors):
    (line,) = errors(f"{SMALL}planner: {{plugin: ecbs, pair: [1, a, b]}}")
    assert "matrix" not in line
