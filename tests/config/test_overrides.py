"""`key=value` on the command line."""

import pytest

SMALL = "world: office\nscenario: {robots: 5}\nplanner: ecbs\n"


def seen(study, text, *overrides):
    return [
        (type(run.config.planner).__name__, getattr(run.config.planner, "w", None), run.config.seed)
        for run in study(SMALL + text, *overrides).runs
    ]


def test_an_option_a_block_and_a_quantity_can_be_given(study):
    assert seen(study, "", "planner.w=1.5", "seed=3") == [("Ecbs", 1.5, 3)]
    assert seen(study, "", "planner={plugin: ecbs, w: 2}") == [("Ecbs", 2.0, 0)]
    assert seen(study, "", "planner=astar") == [("Astar", None, 0)]
    config = study(SMALL, "limits.planning=5 min", "name=other", "simulator=none", "metrics=[planning]").runs[0].config
    assert (config.limits.planning, config.name, config.simulator) == (300.0, "other", None)
    assert list(config.metrics) == ["planning"]


def test_text_that_looks_like_a_number_keeps_its_spelling(study):
    assert study(SMALL, "planner.level=1.10", "name=007").runs[0].config.planner.level == "1.10"


def test_an_override_replaces_the_axis_of_the_same_name(study):
    matrix = "matrix: {planner: [astar, ecbs], seed: 0..9}"
    assert seen(study, matrix, "planner=ecbs", "seed=7") == [("Ecbs", 1.2, 7)]
    assert seen(study, matrix, "seed=[7, 8]", "planner=astar") == [("Astar", None, 7), ("Astar", None, 8)]
    zipped = 'matrix: {"planner, seed": [[astar, 1], [ecbs, 2]]}'
    assert seen(study, zipped, "seed=5") == [("Astar", None, 5), ("Ecbs", 1.2, 5)]


def test_a_range_or_a_list_adds_an_axis(study):
    found = study(SMALL, "seed=0..2", "planner=[astar, ecbs]").runs
    assert [(run.axes["planner"], run.axes["seed"]) for run in found] == [
        (planner, seed) for seed in range(3) for planner in ("astar", "ecbs")
    ]
    assert seen(study, "", "planner.weights=[1, 2, 3]") == [("Ecbs", 1.2, 0)]


def test_below_an_axis_every_point_is_patched(study):
    matrix = "matrix: {planner: [ecbs, {plugin: ecbs, w: 3, heuristic: zero}]}"
    assert seen(study, matrix, "planner.w=1.5") == [("Ecbs", 1.5, 0), ("Ecbs", 1.5, 0)]


def test_below_an_axis_it_is_refused_where_the_option_does_not_exist_and_names_the_points(errors):
    matrix = "matrix: {planner: [ecbs, astar], scenario.robots: [5, 9]}"
    (line,) = errors(SMALL + matrix, "planner.w=1.5")
    assert line.startswith("command line: planner.w: unknown option of 'astar' (")
    assert line.endswith("in planner=astar, scenario.robots=5; planner=astar, scenario.robots=9)")


def test_a_new_block_still_gets_the_axes_below_it(study):
    assert seen(study, "matrix: {planner.w: [2, 3]}", "planner={plugin: ecbs, heuristic: zero}") == [
        ("Ecbs", 2.0, 0),
        ("Ecbs", 3.0, 0),
    ]


def test_included_points_are_overridden_too(study):
    text = "matrix: {seed: [1], include: [{planner: astar, seed: 2}]}"
    assert seen(study, text, "seed=9") == [("Ecbs", 1.2, 9), ("Astar", None, 9)]


@pytest.mark.parametrize(
    ("override", "what"),
    [
        ("planner", "expected key=value, got 'planner'"),
        ("=3", "expected key=value, got '=3'"),
        ("sead=3", "sead: unknown key (did you mean 'seed'?)"),
        ("planner.x=3", "planner.x: unknown option of 'ecbs'"),
        ("planner=ecb", "planner: no planner is called 'ecb' (did you mean 'ecbs'?"),
        ("planner.w=0", "planner.w: 'w' must be >= 1: 0.0"),
        ("planner.w=", "planner.w: expected a number, got ''"),
        ("planner={plugin: ecbs", "planner: "),
        ("seed=3..1", "seed: the range 3..1 is empty"),
        ("matrix.seed=3", "matrix.seed: cannot be overridden"),
        ("metrics=0..3", "metrics: cannot vary"),
        ("planner=!!python/name:os.system", "planner: tags such as"),
        ("seed.x=3", "seed: expected a whole number, got a block"),
    ],
)
def test_a_mistake_is_located_on_the_command_line(errors, override, what):
    (line,) = errors(SMALL, override)
    assert line.startswith("command line: " + what), line


def test_all_mistakes_are_reported_and_a_key_is_given_once(errors):
    assert len(errors(SMALL, "seed=x", "planner=y", "repeat=-1")) == 3
    assert errors(SMALL, "seed=1", "seed=2") == ["command line: seed: given twice"]
