"""Blocks and options become components."""

import math

import pytest

from mrpbench_core.config.structure import structure
from mrpbench_core.config.study import load_study

SMALL = "world: office\nscenario: {robots: 5}\n"
BASE = SMALL + "planner: ecbs\n"


def ecbs(study, options):
    return study(f"{SMALL}planner: {{plugin: ecbs, {options}}}\n").runs[0].config.planner


@pytest.mark.parametrize(
    ("option", "value"),
    [
        ("w: 2", 2.0),
        ("w: 1e0", 1.0),
        ("w: .inf", math.inf),
        ("heuristic: zero", "zero"),
        ("iterations: 5", 5),
        ("iterations: none", None),
        ("iterations: null", None),
        ("speed: fast", "fast"),
        ("weights: [1, 2.5]", (1.0, 2.5)),
        ("weights: []", ()),
        ("pair: [3, x]", (3, "x")),
        ("tags: [b, a, b]", frozenset("ab")),
        ("level: none", "none"),
        ("level: null", None),
        ("level: '3'", "3"),
        ("level: 1.10", "1.10"),
        ("level: 007", "007"),
        ("pair: [3, 1E3]", (3, "1E3")),
        ("flag: true", True),
        ("either: auto", "auto"),
        ("either: 3", 3.0),
    ],
)
def test_options_are_read_by_their_type(study, option, value):
    result = getattr(ecbs(study, option), option.partition(":")[0])
    assert result == value
    assert type(result).__mro__[-2] is type(value) or type(result) is type(value) or isinstance(result, type(value))


@pytest.mark.parametrize(
    ("option", "what"),
    [
        ("w: '2'", "w: expected a number, got '2'"),
        ("w: true", "w: expected a number, got true"),
        ("w: 2 s", "w: expected a number, got '2 s'"),
        ("w: .nan", "w: expected a number, got nan"),
        ("w: {a: 1}", "w: expected a number, got a block"),
        ("w: ", "w: expected a number, got nothing"),
        ("w: 0.5", "w: 'w' must be >= 1: 0.5"),
        ("heuristic: wdg", "heuristic: 'wdg' is not one of zero, cg"),
        ("heuristic: zeor", "(did you mean 'zero'?)"),
        ("heuristic: [zero]", "heuristic: a list is not one of zero, cg"),
        ("iterations: 1.0", "iterations: expected a whole number, got 1.0"),
        ("iterations: false", "iterations: expected a whole number, got false"),
        ("iterations: 0", "iterations: 'iterations' must be >= 1: 0"),
        ("speed: faster", "speed: 'faster' is not one of slow, fast (did you mean 'fast'?)"),
        ("weights: 3", "weights: expected a list, got 3"),
        ("weights: [1, x, 2]", "weights.1: expected a number, got 'x'"),
        ("pair: [1]", "pair: expected 2 entries, got 1"),
        ("pair: [x, 1]", "pair.0: expected a whole number, got 'x'"),
        ("level: [3]", "level: expected text, got a list"),
        ("flag: on", "flag: expected true or false, got 'on'"),
        ("flag: 1", "flag: expected true or false, got 1"),
        ("either: manual", "either: expected a number or auto, got 'manual'"),
        ("either: []", "either: expected a number or auto, got a list"),
        ("time_limt: 3", "time_limt: unknown option of 'ecbs'"),
        ("heuristc: zero", "heuristc: unknown option of 'ecbs' (did you mean 'heuristic'?)"),
    ],
)
def test_nothing_else_is_taken_for_it(errors, option, what):
    lines = errors(f"{SMALL}planner: {{plugin: ecbs, {option}}}\n")
    assert any(what in line for line in lines), lines
    assert all(line.startswith("some.yaml:3:") for line in lines)


def test_an_option_with_a_unit_takes_a_number_or_a_quantity(study, errors):
    config = (
        study(BASE + "simulator: {timestep: 1/500}\nlimits: {planning: 2 min, memory: 1 GiB, wall: 3}\n").runs[0].config
    )
    assert config.simulator.timestep == 1 / 500
    assert (config.limits.planning, config.limits.memory, config.limits.wall) == (120.0, 2**30, 3.0)
    lines = errors(BASE + "simulator: {timestep: 0 s}\nlimits: {planning: 2 m, memory: 1.5, wall: -1 s}\n")
    assert [line.partition(": ")[2].partition(" (")[0] for line in lines] == [
        "simulator.timestep: 'timestep' must be > 0: 0.0",
        "limits.planning: unknown unit 'm' for a quantity in s",
        "limits.memory: expected a whole number of B such as '1 TiB', got 1.5",
        "limits.wall: 'wall' must be > 0: -1.0",
    ]


def test_components_inside_components_are_chosen_by_name(study):
    text = "controller: {plugin: dwb, critics: [path_dist, {plugin: obstacle, scale: 2}], best: obstacle}\n"
    controller = study(BASE + text).runs[0].config.controller
    assert [(type(critic).__name__, critic.scale) for critic in controller.critics] == [
        ("PathDistance", 32.0),
        ("Obstacle", 2.0),
    ]
    assert type(controller.best).__name__ == "Obstacle"
    assert study(BASE + "controller: {plugin: dwb, best: none}").runs[0].config.controller.best is None


def test_mistakes_inside_nested_components_are_located(errors):
    text = (
        "controller:\n  plugin: dwb\n  critics:\n    - path_dits\n    - {plugin: obstacle, scal: 2}\n    - {scale: 2}\n"
    )
    lines = [line.partition(" (")[0] for line in errors(BASE + text)]
    assert lines == [
        "some.yaml:7:7: controller.critics.0: no critic is called 'path_dits'",
        "some.yaml:8:26: controller.critics.1.scal: unknown option of 'obstacle'",
        "some.yaml:9:7: controller.critics.2: names no critic",
    ]


def test_validators_that_compare_options_are_asked(errors):
    (line,) = errors(BASE + "controller: {plugin: dwb, max_speed: 0.2, min_speed: 0.3}")
    assert line == "some.yaml:4:54: controller.min_speed: min_speed exceeds max_speed"
    lines = errors(BASE + "controller: {plugin: dwb, max_speed: x, min_speed: 0.3}")
    assert len(lines) == 2  # it is compared with the default, since the other value is not a number
    assert errors(BASE + "simulator: {timestep: 13}") == ["some.yaml:4:12: simulator: 13 is unlucky"]


def test_none_ends_the_run_after_planning_and_needs_nothing_to_execute_with(study, errors):
    config = study(BASE + "simulator: none").runs[0].config
    assert config.simulator is None
    assert config.controller is None
    assert study(BASE + "simulator: none\ncontroller: dwb").runs[0].config.controller is not None
    assert errors(BASE + "controller: none") == [
        "some.yaml:4:13: controller: cannot be none while there is a simulator"
    ]
    assert errors(BASE + "simulator:") == ["some.yaml:4:11: simulator: has no value (write `none` for none)"]
    assert errors(SMALL + "planner: none")[0].startswith("some.yaml:3:10: planner: no planner is called 'none'")


def test_a_default_that_is_not_installed_says_so(install, tmp_path, errors):
    (tmp_path / "site" / "toy-1.0.dist-info" / "entry_points.txt").write_text("")
    from mrpbench_core.plugins import installed

    installed.refresh()
    lines = errors(BASE)
    assert any(
        line.startswith("some.yaml: assigner: no assigner is called 'hungarian' (the default)") for line in lines
    ), lines


def test_the_fleet_is_a_name_an_entry_or_a_list_of_them(study, errors, tmp_path):
    def fleet(text):
        return study(BASE + f"fleet: {text}\n").runs[0].config.fleet

    (entry,) = fleet("turtlebot3_waffle")
    assert (entry.robot, entry.lidar, entry.count) == ("turtlebot3_waffle", None, None)
    (entry,) = fleet("{robot: turtlebot3_burger, lidar: {beams: 90, range: 250 cm}, count: 2}")
    assert (entry.lidar.beams, entry.lidar.range, entry.lidar.rate, entry.count) == (90, 2.5, None, 2)
    first, second = fleet("[{lidar: none}, turtlebot3_waffle]")
    assert (first.robot, first.lidar, second.robot) == ("turtlebot3_burger", "none", "turtlebot3_waffle")
    (tmp_path / "mine.yaml").write_text("name: mine")
    assert fleet("./mine.yaml")[0].robot == tmp_path / "mine.yaml"
    assert "no robot is named" in errors(BASE + "fleet: turtle")[0]
    assert "no such file" in errors(BASE + "fleet: [yours.yaml]")[0]
    assert "Length of 'fleet'" in errors(BASE + "fleet: []")[0]
    assert "expected a block or none, got 'off'" in errors(BASE + "fleet: {lidar: off}")[0]
    assert "fleet.0.lidar.beams: 'beams' must be >= 1: 0" in errors(BASE + "fleet: [{lidar: {beams: 0}}]")[0]


def test_metrics_and_formats_are_kept_by_name(study, errors):
    config = study(BASE + "metrics: [planning]\nexport: rosbag2").runs[0].config
    assert list(config.metrics) == ["planning"]
    assert config.export["rosbag2"].storage == "mcap"
    assert study(BASE + "metrics: []").runs[0].config.metrics == {}
    assert "metrics.1: 'planning' is listed twice" in errors(BASE + "metrics: [planning, planning]")[0]


OLD = """
import attrs
from mrpbench_core.api import Exporter, Importer

@attrs.frozen(kw_only=True)
class Out(Exporter):
    def open(self, context, destination): ...

@attrs.frozen(kw_only=True)
class In(Importer):
    def read(self, path, robots=()): ...
"""


def test_a_format_of_an_earlier_release_gives_one_note(study, errors, install):
    groups = {"mrpbench.exporters": {"csv": "{module}:Out"}, "mrpbench.importers": {"table": "{module}:In"}}
    install("acme-old", groups, OLD)
    (note,) = study(BASE + "simulator: kinematic\nmatrix: {seed: 0..3}\nexport: [csv]").notes
    assert note.startswith("acme-old 1.0 offers format 'csv' in the group mrpbench.exporters")
    (line,) = errors(BASE + "export: [table]")
    assert line.endswith("no format is called 'table' (`mrpbench plugins` lists what is installed: csv, rosbag2)")


def test_a_plan_filter_may_be_written_as_the_plugin_that_it_was(study, errors, caplog):
    runs = study(BASE + "matrix: {seed: 0..3}\nplan_filter: {plugin: mrp_bench_stairs}").runs
    assert {run.config.plan_filter for run in runs} == {"mrp_bench_stairs"}
    (note,) = caplog.messages
    assert note.endswith("plan_filter: is an option now: write `plan_filter: mrp_bench_stairs`")
    (line,) = errors(BASE + "plan_filter: ./mine.py:Mine")
    assert line.endswith("plan_filter: './mine.py:Mine' is not one of none, mrp_bench_stairs")


def test_an_option_may_have_its_former_name(study, errors, caplog):
    assert ecbs(study, "floor: L2").level == "L2"
    (note,) = caplog.messages
    assert note.endswith("planner.floor: is called `level` now")
    (line,) = errors(f"{SMALL}planner: {{plugin: ecbs, floor: L2, level: L1}}\n")
    assert "planner.floor: unknown option of 'ecbs'" in line


def test_a_metric_is_not_called_like_a_part_of_records(errors, tmp_path):
    (tmp_path / "mine.py").write_text(
        "import attrs\nfrom mrpbench_core.api import Column, Metric\n"
        "@attrs.frozen(kw_only=True)\nclass timing(Metric):\n"
        "    columns = (Column('planning_s', 's', 'lower', 'mine'),)\n"
        "    def measure(self, run): return {'planning_s': 1.0}\n"
    )
    assert errors(BASE + "metrics: [planning, ./mine.py:timing]") == [
        "some.yaml:4:21: metrics.1: a metric cannot be called 'timing': records have a part of that name"
    ]


def test_files_are_relative_to_the_configuration_and_must_exist(study, errors, tmp_path, monkeypatch):
    (tmp_path / "maps").mkdir()
    (tmp_path / "maps" / "a.yaml").write_text("x")
    monkeypatch.chdir("/")
    text = "scenario: {robots: 5}\nplanner: ecbs\nworld: {plugin: rmf, file: maps/../maps/a.yaml}"
    assert study(text).runs[0].config.world.file == tmp_path / "maps" / "a.yaml"
    (line,) = errors(text.replace("a.yaml", "b.yaml"))
    assert line == "some.yaml:3:28: world.file: no such file: maps/b.yaml"
    assert "world.file: is a folder" in errors(text.replace("a.yaml", ""))[0]
    assert "world.file: expected the name of a file, got 3" in errors(text.replace("maps/../maps/a.yaml", "3"))[0]
    assert "world.file: is missing (the map)" in errors("scenario: {robots: 5}\nplanner: ecbs\nworld: rmf")[0]


@pytest.mark.parametrize("name", ["a/b", "", ".hidden", "a\\\\b", "a:b"])
def test_a_name_that_cannot_name_a_folder_is_refused(errors, name):
    assert "'name' must be usable as a folder's name" in errors(BASE + f'name: "{name}"')[0]


def test_a_local_planner_is_chosen_by_its_file(study, errors, tmp_path):
    (tmp_path / "mine.py").write_text(
        "import attrs\nfrom mrpbench_core.api import Planner, option\n"
        "@attrs.frozen(kw_only=True)\nclass Mine(Planner):\n"
        "    depth: int = option(3, help='depth')\n    def plan(self, problem, budget): ...\n"
    )
    assert study(SMALL + "planner: {plugin: ./mine.py:Mine, depth: 4}").runs[0].config.planner.depth == 4
    assert errors(SMALL + "planner: {plugin: ./mine.py:Mine, dept: 4}") == [
        "some.yaml:3:35: planner.dept: unknown option of './mine.py:Mine' (did you mean 'depth'?)"
    ]
    (tmp_path / "mine.py").write_text("class Mine(:\n")
    assert errors(SMALL + "planner: ./mine.py:Mine")[0].startswith("mine.py:1:")


def test_a_plugin_that_raises_what_is_no_exception_when_it_is_made_is_named(errors, tmp_path):
    (tmp_path / "mine.py").write_text(
        "import attrs\nfrom mrpbench_core.api import Planner\n"
        "def refuse(*_): raise BaseExceptionGroup('two\\nlines', [GeneratorExit()])\n"
        "@attrs.frozen(kw_only=True)\nclass Mine(Planner):\n"
        "    depth: int = attrs.field(default=3, converter=refuse)\n    def plan(self, problem, budget): ...\n"
    )
    assert errors(SMALL + "planner: {plugin: ./mine.py:Mine, depth: 4}") == [
        "some.yaml:3:10: planner: './mine.py:Mine' cannot be made: BaseExceptionGroup: two lines (1 sub-exception)"
    ]


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("", ["planning", "execution"]),
        ("tasks: {plugin: poisson, rate: 1}", ["planning", "execution", "tasks"]),
        ("tasks: {plugin: poisson, rate: 1}\nmetrics: [execution]", ["execution", "tasks"]),
        ("tasks: {plugin: poisson, rate: 1}\ndelays: {p_delay: 0.1}", ["planning", "execution", "tasks"]),
        ("delays: {p_delay: 0.1}\nmetrics: [delay, planning]", ["delay", "planning"]),
        ("delays: {p_delay: 0.1, draws: 3}\nexecution: schedule_only", ["planning", "execution", "delay", "draws"]),
        ("faults: {active: false, events: [{kind: stop, at: 5 s}]}", ["planning", "execution", "delay"]),
        ("faults: {events: [{kind: stop, at: 5 s}]}\nsimulator: none", ["planning", "execution"]),
        ("crowds: {plugin: social_force, people: 3}", ["planning", "execution", "people"]),
    ],
)
def test_sections_add_their_metrics(tmp_path, text, names):
    study = tmp_path / "study.yaml"
    study.write_text(f"{BASE}{text}\n")
    (point,) = load_study(study).runs
    assert list(point.config.metrics) == names
    assert list(structure(point.canonical, tmp_path).metrics) == names


def test_metrics_of_sections_that_are_not_installed_are_left_out(study):
    assert list(study(BASE + "delays: {p_delay: 0.1}").runs[0].config.metrics) == ["planning", "execution"]
