import json
import re
from importlib import resources

import attrs
import numpy as np
import pytest
from mrpbench_replay.write_page import write_page

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Area, Door, Lane, Level, Obstacle, World
from mrpbench_core.report.pictures.style import COLOURS
from mrpbench_core.report.reading.columns import describe_columns


@pytest.fixture
def page(store, chunk, record, tmp_path):
    columns = describe_columns({"execution.duration_s": {"unit": "s", "description": "how long <it> took"}})
    write_page(store(chunk), record, tmp_path / "a.html", columns=columns, planner="eecbs w=1.2")
    return (tmp_path / "a.html").read_text(encoding="utf-8")


def test_the_page_is_well_formed(page, parsed):
    parser = parsed(page)
    assert parser.wrong == []
    assert parser.open == []
    ids = [value for _, name, value in parser.attributes if name == "id"]
    assert len(ids) == len(set(ids))
    assert page.startswith("<!DOCTYPE html>")
    assert not re.search(r"<!--\w+-->", page), "every mark of the template is filled"


def test_the_page_loads_nothing(page, scripts, parsed):
    parser = parsed(page)
    loaded = [value for _, name, value in parser.attributes if name in ("src", "href", "srcset", "action", "poster")]
    assert all(value.startswith("data:") for value in loaded)
    assert "default-src 'none'" in page
    folder = resources.files("mrpbench_replay") / "page"
    for entry in folder.iterdir():
        text = entry.read_text(encoding="utf-8")
        assert not re.search(r"https?:|@import|url\(|fetch\(|XMLHttpRequest|importScripts", text), entry.name
    assert not re.search(r"https?://", page)


def test_modules_find_one_another(page, scripts):
    imports = json.loads(scripts(page)["importmap"][1])["imports"]
    folder = resources.files("mrpbench_replay") / "page"
    names = {f"replay/{entry.name}" for entry in folder.iterdir() if entry.name.endswith(".js")}
    assert set(imports) == names
    for entry in folder.iterdir():
        wanted = set(re.findall(r'from "([^"]+)"', entry.read_text(encoding="utf-8")))
        assert wanted <= names, entry.name


def test_the_data_are_the_runs(page, scripts, chunk, unpack):
    found = scripts(page)
    data = json.loads(found["run"][1])
    assert data["facts"]["run_id"] == "0123456789abcdef"
    assert data["facts"]["status"] == "goals_missed"
    assert not data["facts"]["partial"]
    assert data["facts"]["planner"] == "eecbs w=1.2"
    metrics = {metric["name"]: metric for metric in data["facts"]["metrics"]}
    assert metrics["execution.duration_s"] == {
        "name": "execution.duration_s",
        "value": 4.0,
        "unit": "s",
        "text": "how long <it> took",
        "primary": "execution",
    }
    assert metrics["execution.min_distance_m"]["value"] is None
    assert metrics["timing.planning_s"]["unit"] == "s"
    assert data["robots"]["names"] == ["robot_0", "robot_1"]
    assert data["robots"]["models"][0]["footprint"] == [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]]
    arrays = unpack(found["motion"][0]["data-layout"], found["motion"][1])
    assert np.abs(arrays["x"] - chunk["truth"][..., 0].T).max() <= 0.0005 + 1e-9
    assert arrays["route_first"].tolist() == [0, 3, 5]
    assert np.allclose(arrays["route_x"], [0.5, 0.5, 1.5, 1.5, 2.5])
    assert arrays["walls_0"].shape == (4, 8)
    assert "scans" in found


def test_text_of_a_run_cannot_end_a_script(page, scripts):
    assert "</script><b>" not in page
    assert json.loads(scripts(page)["run"][1])["events"][0][3] == "</script><b>"


def test_every_part_of_a_world_is_there(store, chunk, record, run_context, tmp_path, scripts, unpack):
    triangle = [[0, 0], [1, 0], [1, 1]]
    level = Level(
        name="<ground>",
        occupancy=Occupancy(blocked=[[True, False, False], [False, False, True]], resolution=0.5, origin=(1.0, -2.0)),
        obstacles=(Obstacle(name="rack", polygon=triangle),),
        doors=(Door(name="gate", start=(0, 1), end=(1, 1)),),
        floors=(Area(polygon=triangle),),
        holes=(Area(polygon=triangle),),
    )
    vertices = run_context.world.vertices
    world = World(name="w", levels=(level, Level(name="L2")), vertices=vertices, lanes=(Lane(start=0, end=1),))
    write_page(store(chunk, context=attrs.evolve(run_context, world=world)), record, tmp_path / "a.html")
    found = scripts((tmp_path / "a.html").read_text(encoding="utf-8"))
    shown = json.loads(found["run"][1])["world"]
    assert shown["levels"][0] == {
        "name": "<ground>",
        "floors": [triangle],
        "holes": [triangle],
        "obstacles": [["rack", triangle]],
        "raster": {"cell": 0.5, "origin": [1.0, -2.0]},
    }
    assert shown["levels"][1]["name"] == "L2"
    slides = {"name": "gate", "levels": [0], "lift": -1, "opens_on": [], "leaves": [[0, 1, 1, 1, -1, 0, 0]]}
    assert shown["doors"] == [slides]
    assert shown["lanes"] == [[0, 1, 1]]
    arrays = unpack(found["motion"][0]["data-layout"], found["motion"][1])
    assert arrays["blocked_0"].tolist() == [[1, 0, 0], [0, 0, 1]]


def test_robots_have_the_same_colours_in_pictures_and_on_the_page():
    style = (resources.files("mrpbench_replay") / "page" / "style.css").read_text(encoding="utf-8")
    light = style[: style.index('data-theme="dark"')]
    assert tuple(re.findall(r"--robot-\d: (#\w+)", light)) == COLOURS


def test_a_folder_that_does_not_exist_is_named(store, chunk, record, tmp_path):
    with pytest.raises(InputError, match="cannot be written"):
        write_page(store(chunk), record, tmp_path / "no" / "a.html")
