import pytest

from mrpbench_core.config.maps import map_plugin

SMALL = "scenario: {robots: 5}\nplanner: ecbs\n"
BUILDING = "levels: {L1: {vertices: []}}\n"


@pytest.mark.parametrize(
    ("name", "text", "plugin"),
    [
        ("a.map", "type octile", "movingai"),
        ("a.yaml", "image: a.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n", "ros_map"),
        ("a.yaml", "image: a.pgm\norigin: [0, 0, 0]\n", "ros_map"),
        ("a.building.yaml", BUILDING, "rmf"),
        ("a.yml", BUILDING, "rmf"),
        ("a.site.json", '{"format_version": "0.1", "levels": {}}', "rmf"),
        ("office", "", None),
    ],
)
def test_a_map_is_read_by_what_it_is(tmp_path, name, text, plugin):
    (tmp_path / name).write_text(text)
    assert map_plugin(tmp_path / name) == plugin


@pytest.mark.parametrize("world", ["hut.yaml", "{plugin: hut.yaml}", "{plugin: rmf, file: hut.yaml}"])
def test_a_world_is_named_by_its_file(study, tmp_path, world):
    (tmp_path / "hut.yaml").write_text(BUILDING)
    (run,) = study(f"world: {world}\n{SMALL}").runs
    assert (type(run.config.world).__name__, run.config.world.file) == ("Rmf", tmp_path / "hut.yaml")


def test_options_of_a_world_that_is_named_by_its_file_are_those_of_its_plugin(study, errors, tmp_path):
    (tmp_path / "hut.yaml").write_text(BUILDING)
    (run,) = study(f"world: hut.yaml\n{SMALL}", "world.extra=hut.yaml").runs
    assert run.config.world.extra == tmp_path / "hut.yaml"
    (line,) = errors(f"world: {{plugin: hut.yaml, colour: red}}\n{SMALL}")
    assert line.startswith("some.yaml:1:27: world.colour: unknown option of 'rmf'")


def test_a_map_that_cannot_be_read_is_one_line(errors, tmp_path):
    (tmp_path / "broken.yaml").write_text("levels: [\n")
    for name, message in (("none.yaml", "none.yaml: no such file"), ("broken.yaml", "broken.yaml:2:1: ")):
        (line,) = errors(f"world: {name}\n{SMALL}")
        assert line.startswith(f"some.yaml:1:8: world: {message}")
