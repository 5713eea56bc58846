"""Configurations as plain data, and back."""

import json
import math
import os
import subprocess
import sys
from pathlib import Path

import pytest

from mrpbench_core.config.study import load_study
from mrpbench_core.config.unpacking import Unpacking, unpack
from mrpbench_core.files.errors import InputErrors

FULL = """
world: {plugin: rmf, file: maps/a.yaml}
roadmap: {cell_size: 0.5}
scenario: {robots: 5}
fleet: [{robot: ./robot.yaml, lidar: {beams: 90}, count: 2}, {lidar: none}, turtlebot3_waffle]
planner: {plugin: ecbs, w: .inf, speed: fast, tags: [b, a], pair: [3, x], either: 7, level: none}
controller: {plugin: dwb, critics: [path_dist, {plugin: obstacle, scale: 1e-3}], best: obstacle}
metrics: [execution]
export: [{plugin: rosbag2, storage: sqlite3}]
limits: {memory: 1 GiB}
seed: 7
"""
MINE = """
import attrs
from mrpbench_core.api import Planner, option
@attrs.frozen(kw_only=True)
class Mine(Planner):
    depth: int = option(3, help="depth")
    def plan(self, problem, budget): ...
"""


@pytest.fixture
def full(study, tmp_path):
    (tmp_path / "maps").mkdir()
    (tmp_path / "maps" / "a.yaml").write_text("walls")
    (tmp_path / "robot.yaml").write_text("name: mine")
    (tmp_path / "mine.py").write_text(MINE)
    return study(FULL).runs[0]


def test_a_canonical_configuration_is_complete_and_plain(full):
    plain = json.loads(json.dumps(full.canonical, allow_nan=False))
    assert plain == full.canonical
    assert plain["world"]["file"]["path"] == "maps/a.yaml"
    assert len(plain["world"]["file"]["sha256"]) == 64
    assert plain["planner"]["w"] == ".inf"
    assert plain["planner"]["tags"] == ["a", "b"]
    assert plain["dispatcher"] == {"plugin": "adg"}
    assert plain["controller"]["critics"][1] == {"plugin": "obstacle", "scale": 0.001}
    assert plain["limits"]["planning"] == 60.0
    assert "/" not in plain["fleet"][0]["robot"]["path"]


def test_it_is_read_back_equal(full, tmp_path, monkeypatch):
    monkeypatch.chdir("/")
    config = unpack(json.loads(json.dumps(full.parcel)))
    assert config == full.config
    assert config.planner.w == math.inf
    assert config.fleet[0].robot == tmp_path / "robot.yaml"


@pytest.mark.parametrize("text", ["simulator: none", "simulator: none\ndispatcher: adg", "metrics: []", "seed: 3"])
def test_every_form_of_a_configuration_is_read_back_equal(study, text):
    run = study("world: office\nscenario: {robots: 5}\nplanner: astar\n" + text).runs[0]
    assert unpack(json.loads(json.dumps(run.parcel))) == run.config


def test_another_process_in_another_folder_reads_the_same(full, tmp_path):
    code = (
        "import json, sys; from pathlib import Path; from mrpbench_core.config.unpacking import unpack;"
        "from mrpbench_core.config.canonical import canonical; from mrpbench_core.config.identity import run_id;"
        "parcel = json.load(sys.stdin); config = unpack(parcel); folder = Path(parcel['folder']);"
        "print(json.dumps([canonical(config, folder), run_id(config, folder)]))"
    )
    # The toy plugins there are installed together with the real ones, so they are named with their distribution.
    parcel = json.dumps(full.parcel)
    names = {"rmf", "lanes", "random", "hungarian", "adg", "waypoints", "kinematic", "ground_truth", "execution"}
    for name in [*names, "rosbag2", "ecbs", "dwb"]:
        parcel = parcel.replace(f'"plugin": "{name}"', f'"plugin": "{name}@toy"')
    environment = os.environ | {"PYTHONPATH": str(tmp_path / "site")}
    done = subprocess.run(
        [sys.executable, "-c", code],
        input=parcel,
        capture_output=True,
        text=True,
        cwd="/",
        env=environment,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    plain, _ = json.loads(done.stdout)
    assert json.loads(json.dumps(plain).replace("@toy", "")) == full.canonical


def test_a_local_planner_travels_with_its_source(full, study, tmp_path):
    run = study(
        FULL.replace("{plugin: ecbs, w: .inf", "{plugin: ./mine.py:Mine, depth: 9, #").replace(
            "speed: fast, tags: [b, a], pair: [3, x], either: 7, level: none}", "\n}"
        )
    ).runs[0]
    assert run.canonical["planner"] == {"plugin": "mine.py:Mine", "depth": 9}
    assert run.sources == {"mine.py": MINE}
    (tmp_path / "mine.py").write_text("edited while the study runs")
    assert unpack(run.parcel) == run.config


def test_a_file_that_changed_is_refused_unless_only_looked_at(full, tmp_path):
    (tmp_path / "maps" / "a.yaml").write_text("other walls")
    with pytest.raises(InputErrors, match=r"world\.file: has changed since this configuration was written"):
        unpack(full.parcel)
    assert unpack(full.parcel, verify=False).world.file == Path(tmp_path / "maps" / "a.yaml")


def test_settings_that_runs_have_in_common_are_structured_once(full, study, tmp_path):
    unpacking = Unpacking()
    first = unpacking(full.parcel)
    others = FULL.replace(
        "seed: 7",
        "matrix: {seed: [7, 8], planner.w: [1.0, 2], fleet.0.count: [1, 2], world.file: [maps/a.yaml, maps/b.yaml]}",
    )
    (tmp_path / "maps" / "b.yaml").write_text("more walls")
    for run in study(others).runs:
        found = unpacking(json.loads(json.dumps(run.parcel)))
        assert found == run.config
        assert found.controller is first.controller
    elsewhere = {**full.parcel, "folder": str(tmp_path / "maps" / "..")}
    assert unpacking(elsewhere) == full.config
    (tmp_path / "maps" / "a.yaml").write_text("other walls")
    with pytest.raises(InputErrors, match=r"world\.file: has changed since"):
        unpacking(full.parcel)
    with pytest.raises(InputErrors, match="seed"):
        unpacking({**full.parcel, "config": {**full.parcel["config"], "seed": -1}})


def test_a_dict_and_a_file_describe_the_same_run(toy, full, tmp_path, monkeypatch):
    import yaml

    monkeypatch.chdir(tmp_path)
    data = yaml.safe_load(FULL.replace("1e-3", "0.001"))
    (run,) = load_study(data).runs
    assert run.run_id == full.run_id
