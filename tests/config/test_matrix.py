"""The matrix of a study."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.config.items import Location, from_data
from mrpbench_core.config.matrix import integers, parse_matrix
from mrpbench_core.files.errors import InputErrors

SMALL = "world: office\nscenario: {robots: 5}\nplanner: ecbs\n"


def expand(matrix, base=None):
    root = from_data({"world": "office"} if base is None else base, Location())
    return [point.root.data for point in parse_matrix(from_data(matrix, Location())).points(root)]


def axes(study, matrix, *overrides):
    return [run.axes for run in study(SMALL + matrix, *overrides).runs]


def test_a_block_key_replaces_and_a_dotted_key_patches():
    base = {"planner": {"plugin": "ecbs", "w": 1.5, "heuristic": "cg"}}
    assert expand({"planner": ["astar", {"plugin": "ecbs"}]}, base) == [
        {"planner": "astar"},
        {"planner": {"plugin": "ecbs"}},
    ]
    assert expand({"planner.w": [2]}, base) == [{"planner": {"plugin": "ecbs", "w": 2, "heuristic": "cg"}}]
    assert expand({"planner.plugin": ["cbs"]}, base) == [{"planner": {"plugin": "cbs", "w": 1.5, "heuristic": "cg"}}]
    assert base == {"planner": {"plugin": "ecbs", "w": 1.5, "heuristic": "cg"}}


def test_a_bare_word_and_a_missing_block_can_be_patched():
    assert expand({"planner.w": [2]}, {"planner": "ecbs"}) == [{"planner": {"plugin": "ecbs", "w": 2}}]
    assert expand({"scenario.robots": [2]}, {}) == [{"scenario": {"robots": 2}}]
    assert expand({"fleet.lidar.beams": [9]}, {"fleet": "burger"}) == [
        {"fleet": {"robot": "burger", "lidar": {"beams": 9}}}
    ]
    assert expand({"fleet.1.robot": ["b"]}, {"fleet": ["a", {"robot": "a", "count": 2}]}) == [
        {"fleet": ["a", {"robot": "b", "count": 2}]}
    ]


def test_blocks_are_set_before_their_options_in_any_order():
    points = expand({"planner.w": [1, 2], "planner": [{"plugin": "a", "w": 9}, "b"]})
    assert [point["planner"] for point in points] == [
        {"plugin": "a", "w": 1},
        {"plugin": "b", "w": 1},
        {"plugin": "a", "w": 2},
        {"plugin": "b", "w": 2},
    ]


def test_points_come_in_reading_order_the_last_axis_fastest(study):
    assert axes(study, "matrix: {planner: [astar, ecbs], seed: 0..1}") == [
        {"planner": "astar", "seed": 0},
        {"planner": "astar", "seed": 1},
        {"planner": "ecbs", "seed": 0},
        {"planner": "ecbs", "seed": 1},
    ]


def test_names_together_are_zipped(study):
    assert axes(study, 'matrix: {"planner, seed": [[astar, 3], [ecbs, 4]], repeat: 0..1}') == [
        {"planner": "astar", "seed": 3, "repeat": 0},
        {"planner": "astar", "seed": 3, "repeat": 1},
        {"planner": "ecbs", "seed": 4, "repeat": 0},
        {"planner": "ecbs", "seed": 4, "repeat": 1},
    ]


def test_points_that_match_all_of_an_entry_are_excluded(study):
    text = "matrix:\n  planner: [astar, {plugin: ecbs, w: 1.5}]\n  scenario.robots: [5, 9]\n  seed: 0..9\n  exclude:\n"
    assert len(axes(study, text + "    - {planner: astar, scenario.robots: 9}")) == 30
    assert len(axes(study, text + "    - {planner.plugin: astar, scenario.robots: 9}")) == 30
    assert len(axes(study, text + "    - {planner.w: 1.5}")) == 20
    assert len(axes(study, text + "    - {planner: {plugin: ecbs, w: 1.5}, seed: 0..4}")) == 30
    assert len(axes(study, text + "    - {planner: {plugin: ecbs}}")) == 40
    assert len(axes(study, text + "    - {planner: astar}\n    - {scenario.robots: 9}")) == 10


def test_included_points_are_added_to_the_product(study):
    text = "matrix:\n  planner: [astar, ecbs]\n  include:\n    - {scenario.robots: 50, planner: astar, seed: 1..3}\n"
    found = study(SMALL + text).runs
    drawn = [(run.config.scenario.robots, run.config.seed) for run in found]
    assert drawn == [(5, 0), (5, 0), (50, 1), (50, 2), (50, 3)]
    assert found[-1].axes == {"scenario.robots": 50, "planner": "astar", "seed": 3}
    assert found[0].axes == {"planner": "astar"}
    only = study(SMALL + "matrix: {include: [{seed: 3}, {seed: 4}]}").runs
    assert [run.config.seed for run in only] == [3, 4]


def test_a_planner_may_be_given_by_the_matrix_alone(study):
    assert len(study("world: office\nscenario: {robots: 5}\nmatrix: {planner: [astar, ecbs]}").runs) == 2


@pytest.mark.parametrize(
    ("matrix", "what"),
    [
        ("matrix: [1]", "4:9: matrix: expected a block"),
        ("matrix: {seed: 5}", "4:16: seed: expected a list of values, or a range"),
        ("matrix: {seed: []}", "4:16: seed: expected a list"),
        ("matrix: {seed: 5..3}", "4:16: seed: the range 5..3 is empty"),
        ("matrix: {seed: 0..99999999}", "4:16: seed: the range 0..99999999 has more than"),
        ("matrix: {seed: 0..9999, repeat: 0..9999}", "some.yaml:1:1: matrix: describes 100000000 runs"),
        ("matrix: {sead: 0..3}", "4:10: sead: unknown key (did you mean 'seed'?)"),
        ("matrix: {scenario.robot: [3]}", "4:10: scenario.robot: unknown option of 'random' (did you mean 'robots'?)"),
        ("matrix: {'seed, repeat': [[1]]}", "expected a list of 2 values"),
        ("matrix: {'seed, seed': [[1, 2]]}", "seed: varies twice"),
        ("matrix: {seed: [1], 'seed, repeat': [[1, 2]]}", "seed: varies twice"),
        ("matrix: {metrics: [planning, execution]}", "metrics: cannot vary"),
        ("matrix: {limits.wall: [1 s, 2 s]}", "limits.wall: cannot vary"),
        ("matrix: {recording.rate: [1, 2]}", "recording.rate: cannot vary"),
        ("matrix: {seed: [1], exclude: [3]}", "matrix.exclude: expected a list of blocks"),
        ("matrix: {seed: [1], include: [{}]}", "matrix.include: expected a list of blocks"),
        ("matrix: {seed: [1], exclude: [{sead: 3}]}", "sead: unknown key (did you mean 'seed'?)"),
        ("matrix: {seed: [1], exclude: [{seed: 1}]}", "matrix: excludes every point"),
        ("matrix: {seed.x: [1]}\nseed: 3", "seed.x: seed is 3, not a block"),
        (
            "matrix: {fleet.robot: [a]}\nfleet: [turtlebot3_burger]",
            "is a list (give the index of an entry: fleet.0.robot)",
        ),
        ("matrix: {fleet.3.robot: [a]}\nfleet: [turtlebot3_burger]", "fleet has only 1 entries"),
    ],
)
def test_a_mistake_in_the_matrix_is_located(errors, matrix, what):
    (line, *_) = errors(SMALL + matrix)
    assert what in line
    assert line.startswith("some.yaml:")


@pytest.mark.parametrize(("text", "numbers"), [("0..3", [0, 1, 2, 3]), ("-2..-1", [-2, -1]), ("5..5", [5])])
def test_ranges_hold_both_ends(text, numbers):
    assert list(integers(text)) == numbers


@pytest.mark.parametrize("text", ["0...3", "0..", "..3", "0.0..3", "a..b", 3, None, "0..3 "])
def test_other_texts_are_not_ranges(text):
    assert integers(text) is None


names = st.sampled_from(["seed", "repeat", "planner", "planner.w", "scenario.robots", "noise.lidar"])


@settings(deadline=None, max_examples=60)
@given(st.dictionaries(names, st.lists(st.integers(), min_size=1, max_size=4, unique=True), max_size=4))
def test_a_product_has_as_many_points_as_combinations(matrix):
    if "planner" in matrix:
        matrix["planner"] = [f"p{value}" for value in matrix["planner"]]
    points = expand(matrix, {})
    assert len(points) == math.prod(len(values) for values in matrix.values())
    assert len({repr(point) for point in points}) == len(points)
    for key, values in matrix.items():
        first, _, second = key.partition(".")
        if first != "planner":
            assert {point[first][second] if second else point[first] for point in points} == set(values)


@settings(deadline=None, max_examples=60)
@given(st.sets(st.integers(0, 9), min_size=1), st.sets(st.integers(0, 9)), st.sets(st.integers(0, 9)))
def test_excluding_and_including_count_as_sets_do(seeds, excluded, included):
    matrix = {"seed": sorted(seeds)}
    if excluded:
        matrix["exclude"] = [{"seed": seed} for seed in excluded]
    if included:
        matrix["include"] = [{"seed": seed, "repeat": 1} for seed in included]
    found = sorted((point["seed"], point.get("repeat", 0)) for point in expand(matrix))
    assert found == sorted([(s, 0) for s in seeds - excluded] + [(s, 1) for s in included - excluded])


trees = st.recursive(
    st.none() | st.integers() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=6), inner, max_size=3),
    max_leaves=8,
)


@settings(deadline=None, max_examples=60)
@given(trees)
def test_any_matrix_is_expanded_or_refused(matrix):
    try:
        expand(matrix)
    except InputErrors as several:
        assert several.errors  # noqa: PT017 - what is asserted is the rare case
