"""`mrpbench plugins`."""

import json

import pytest


def test_everything_installed_is_listed_with_its_distribution(mrpbench):
    entries = json.loads(mrpbench("plugins", "--json")[1])
    found = {(entry["kind"], entry["name"]): entry for entry in entries}
    assert found["roadmap", "lanes"]["distribution"] == "mrpbench-core"
    assert found["planner", "example"]["class"] == "mrpbench_planners_example:Example"
    planners = json.loads(mrpbench("plugins", "planner", "--json")[1])
    assert planners == [entry for entry in entries if entry["kind"] == "planner"]
    assert "lanes" in mrpbench("plugins", "roadmaps")[1]


def test_the_kinds_that_most_people_write_come_first(mrpbench):
    main, more = mrpbench("plugins")[1].split("\nMore\n")
    kinds = [[line.split()[0] for line in part.splitlines()[1:]] for part in (main, more)]
    assert list(dict.fromkeys(kinds[0])) == ["planner", "assigner", "simulator", "controller", "metric"]
    assert kinds[1] == sorted(kinds[1])
    assert "More" not in mrpbench("plugins", "world")[1]


def test_options_are_shown_with_default_unit_and_help(mrpbench):
    facts = json.loads(mrpbench("plugins", "show", "lanes", "--json")[1])
    assert (facts["kind"], facts["distribution"]) == ("roadmap", "mrpbench-core")
    size = next(entry for entry in facts["options"] if entry["name"] == "cell_size")
    assert (size["default"], size["unit"], size["type"]) == ("0.4", "m", "float")
    assert all(entry["help"] for entry in facts["options"])
    plain = mrpbench("plugins", "show", "example")[1]
    assert "planner example, from mrpbench-standard" in plain
    assert "promises: conflict_free, deterministic" in plain


def test_a_name_of_several_kinds_wants_its_kind(mrpbench):
    code, _, errors = mrpbench("plugins", "show", "movingai")
    assert code == 2
    assert "scenario:movingai or world:movingai" in errors
    assert mrpbench("plugins", "show", "world:movingai")[1].startswith("world movingai")


def test_the_columns_of_a_metric_are_defined(mrpbench):
    facts = json.loads(mrpbench("plugins", "show", "metric:execution", "--json")[1])
    duration = next(column for column in facts["columns"] if column["name"] == "duration_s")
    assert (duration["unit"], duration["better"]) == ("s", "lower")
    assert all(column["description"] for column in facts["columns"])
    assert "mrp_bench.duration_s" in mrpbench("plugins", "show", "metric:execution")[1]


def test_components_in_an_option_are_named_as_in_a_configuration(mrpbench):
    facts = json.loads(mrpbench("plugins", "show", "waypoints", "--json")[1])
    recoveries = next(entry for entry in facts["options"] if entry["name"] == "recoveries")
    assert (recoveries["default"], recoveries["type"]) == (
        "[clear, rotate_to_path, spin, wait, back_up]",
        "tuple[Recovery, ...]",
    )
    assert mrpbench("plugins", "show", "recovery:spin")[1].startswith("recovery spin")
    assert mrpbench("plugins", "recoveries") == mrpbench("plugins", "recovery")


@pytest.mark.parametrize("words", [["show", "hook:ros2"], ["show", "hooks:ros2", "--json"]])
def test_a_hook_is_shown_with_the_events_that_it_observes(mrpbench, words):
    code, out, _ = mrpbench("plugins", *words)
    assert code == 0
    for text in ("mrpbench-bridges-ros2", "MRPBENCH_ROS2", "mrpbench_stepped"):
        assert text in out


def test_an_unknown_hook_is_one_line(mrpbench):
    code, _, error = mrpbench("plugins", "show", "hook:ros")
    assert code == 2
    assert "no hook is called 'ros'" in error
    assert error.count("\n") == 1


def test_a_plugin_that_ends_the_process_when_it_is_imported_is_named(mrpbench, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ending.py").write_text("import os\nos._exit(3)\n")
    code, out, error = mrpbench("plugins", "show", "./ending.py:Mine")
    assert (code, out) == (2, "")
    assert "./ending.py:Mine cannot be shown: " in error
    assert "ended with exit code 3" in error
    assert error.count("\n") == 1


def test_a_class_whose_distribution_is_not_known_is_shown(mrpbench, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.py").write_text(
        "import attrs\nfrom mrpbench_core.api import Planner\n"
        "@attrs.frozen(kw_only=True)\nclass Mine(Planner):\n    def plan(self, problem, budget): ...\n"
    )
    assert mrpbench("plugins", "show", "./mine.py:Mine")[1].startswith("planner mine.py:Mine, from mine.py\n")
    with (tmp_path / "mine.py").open("a") as file:
        file.write("Mine.__module__ = 'no.such.module'\n")
    assert mrpbench("plugins", "show", "./mine.py:Mine")[1].startswith("planner no.such.module:Mine, from no file\n")
