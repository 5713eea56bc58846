import argparse
import json
from xml.etree import ElementTree

import pytest
from mrpbench_world.commands import world as command
from mrpbench_world.write import planned_raster
from mrpbench_worlds_standard.shipped import Household

from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet


@pytest.fixture
def invoke(capsys):
    def run(*words) -> str:
        parser = argparse.ArgumentParser()
        command.configure(parser)
        assert command.run(parser.parse_args([str(word) for word in words])) == 0
        return capsys.readouterr().out

    return run


@pytest.mark.parametrize(
    ("name", "figures"),
    [
        ("office", (29, 32, 1025, 333, 692)),
        ("airport_terminal", (210, 211, 105700, 7645, 98055)),
        ("warehouse", (54, 40, 3009, 788, 2221)),
    ],
)
def test_table_one_of_the_original_is_reproduced(shared_data, invoke, name, figures):
    file = shared_data / f"rmf/mrp_bench/{name}.building.yaml"
    facts = json.loads(invoke(file, "--cell-size", 0.4, "--compatible", "mrp_bench", "--json"))
    assert tuple(facts[key] for key in ("vertices", "edges", "cells", "free", "blocked")) == figures


def test_a_built_in_world_is_named(invoke):
    out = invoke("office")
    assert "21.50 × 12.00 m" in out
    assert "faults" not in out


def test_a_moving_ai_map_is_a_grid(invoke, tmp_path):
    file = tmp_path / "tiny.map"
    file.write_text("type octile\nheight 2\nwidth 2\nmap\n.@\n..\n")
    facts = json.loads(invoke(file, "--json"))
    assert (facts["name"], facts["cells"], facts["free"], facts["blocked"]) == ("tiny", 4, 3, 1)


def test_a_graph_has_no_cells(invoke):
    assert json.loads(invoke("warehouse", "--roadmap", "graph", "--json"))["cells"] is None


def test_many_faults_are_cut_short(invoke, shared_data):
    out = invoke(shared_data / "rmf/mrp_bench/warehouse.building.yaml")
    assert "more; --json lists all" in out


def test_a_picture_is_written(invoke, tmp_path):
    pytest.importorskip("matplotlib")
    invoke("office", "--render", tmp_path / "office.png")
    assert (tmp_path / "office.png").read_bytes().startswith(b"\x89PNG")


def test_a_world_becomes_a_ros_map_and_is_read_again(invoke, tmp_path):
    pytest.importorskip("PIL")
    invoke("office", "--write", tmp_path / "office.yaml")
    facts = json.loads(invoke(tmp_path / "office.yaml", "--json"))
    assert facts["name"] == "office"
    assert (facts["width"], facts["height"]) == pytest.approx((21.5, 12.0), abs=0.06)
    assert facts["free"] > 800


def test_the_roadmap_becomes_a_moving_ai_map(invoke, tmp_path, capsys):
    file = tmp_path / "office.map"
    before = json.loads(invoke("office", "--json", "--write", file))
    after = json.loads(invoke(file, "--json"))
    assert (after["cells"], after["free"]) == (before["cells"], before["free"])
    again = tmp_path / "again.map"
    invoke(file, "--write", again)
    assert again.read_text() == file.read_text()


def test_parts_that_a_map_cannot_express_are_named(invoke, tmp_path, capsys):
    parser = argparse.ArgumentParser()
    command.configure(parser)
    command.run(parser.parse_args(["household", "--cell-size", "0.4", "--roadmap", "grid",
                                   "--write", str(tmp_path / "a.map")]))  # fmt: skip
    assert "pairs of neighbouring cells are separated by something solid" in capsys.readouterr().err


def test_headings_do_not_change_the_number_of_such_pairs(capsys):
    fleet = Fleet(robots=(load_robot("turtlebot3_burger"),))
    counts = set()
    for model in ("constant", "kinodynamic"):
        planned_raster(GridRoadmap(cell_size=0.4, duration_model=model).build(Household().load(), fleet))
        counts.add(capsys.readouterr().err)
    (message,) = counts
    assert int(message.split()[0]) > 0


def test_further_levels_are_drawn_next_to_the_first(invoke, tmp_path, shared_data):
    pytest.importorskip("matplotlib")
    invoke(shared_data / "rmf/rmf_demos/hotel.building.yaml", "--render", tmp_path / "hotel.png")
    assert sorted(file.name for file in tmp_path.iterdir()) == ["hotel-L2.png", "hotel-L3.png", "hotel.png"]


def test_of_levels_without_lanes_the_first_is_shown(invoke, tmp_path):
    square = "vertices: [[0, 0, 0, ''], [4, 0, 0, ''], [4, 4, 0, ''], [0, 4, 0, '']], walls: [[0, 1, {}], [2, 3, {}]]"
    file = tmp_path / "two.building.yaml"
    file.write_text(f"coordinate_system: cartesian_meters\nlevels:\n  L1: {{{square}}}\n  L2: {{{square}}}\n")
    told = invoke(file)
    assert "only level 'L1' is loaded, not 'L2'" in told
    assert "4.10 × 4.10 m" in told
    with pytest.raises(InputError, match=r"has 2: L1, L2 \(load one level, .* level: L1\}"):
        invoke(file, "--roadmap", "grid")


def test_all_levels_are_written_also_without_lanes(invoke, tmp_path):
    square = "vertices: [[0, 0, 0, ''], [4, 0, 0, ''], [4, 4, 0, ''], [0, 4, 0, '']], walls: [[0, 1, {}], [2, 3, {}]]"
    file = tmp_path / "two.building.yaml"
    levels = f"L1: {{elevation: 0, {square}}}\n  L2: {{elevation: 4, {square}}}\n"
    file.write_text(f"coordinate_system: cartesian_meters\nlevels:\n  {levels}")
    invoke(file, "--write", tmp_path / "two.sdf")
    names = {shape.get("name") for shape in ElementTree.parse(tmp_path / "two.sdf").iter("collision")}
    assert {"L1_wall_0_collision", "L2_wall_1_collision"} <= names


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["airport", "--write", "a.yaml", "--roadmap", "grid", "--cell-size", "0.01"], "choose a larger cell_size"),
        (["office", "--write", "office.png"], "no format has the suffix '.png'"),
        (["office", "--roadmap", "graph", "--write", "a.map"], "this roadmap has no raster to write"),
        (["office", "--write", "no/such/a.map"], "no/such/a.map: cannot be written"),
        (["offise"], "did you mean 'office'"),
        (["missing.map"], "missing.map: no such file"),
        (["missing.building.yaml"], "missing.building.yaml: no such file"),
        (["rmf"], "rmf needs file"),
        (["office", "--level", "L2"], "office has no option 'level'"),
        (["office", "--roadmap", "grit"], "did you mean 'grid'"),
        (["office", "--roadmap", "graph", "--cell-size", "1"], "graph has no option 'cell_size'"),
        (["office", "--cell-size", "-1"], "'cell_size' must be >= 0.01"),
        (["office", "--robot", "r2d2"], "no robot is named 'r2d2'"),
        (["office", "--render", "no/such/folder.png"], "no/such/folder.png: cannot be written"),
    ],
)
def test_a_mistake_is_one_line(invoke, words, message):
    with pytest.raises(InputError) as caught:
        invoke(*words)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)
