"""The studies: every file loads, and is as large as the page says."""

import argparse
import re
import shutil
from collections import Counter
from pathlib import Path

import pytest

from mrpbench_core import load
from mrpbench_core.api.planner import Planner
from mrpbench_core.cli import report
from mrpbench_core.cli.main import main
from mrpbench_core.config.study import load_study
from mrpbench_core.plugins.registry import Registry

FOLDER = Path(__file__).parents[1] / "studies"
RUNS_PER_PLANNER = {
    "table2": 216,
    "table3": 216,
    "fig5": 34,
    "table4": 54,
    "replicability": 300,
    "safe": 216,
    "late_robots": 240,
    "league": 30,
    "league_grid": 60,
    "orders": 12,
    "faults": 80,
    "controllers": 240,
    "encounters": 120,
    "people": 400,
    "prediction": 720,
    "people_floors": 80,
    "floor": 20,
    "floor_grid": 10,
    "rates": 90,
    "batches": 80,
    "bodies": 324,
    "policies": 80,
    "paper": 648,
    "slam": 100,
}
"""Runs of each planner that is installed."""
PLANNERS = {
    "table2": 4,
    "table3": 4,
    "fig5": 6,
    "table4": 6,
    "league": 7,
    "league_grid": 2,
    "floor": 4,
    "floor_grid": 2,
    "policies": 4,
    "paper": 6,
}
"""Planners of a study, or methods of one, if there are several."""


def missing_planners():
    return {"ecbs", "eecbs", "cbs_ta", "ecbs_ta"} - {provider.name for provider in Registry(Planner)}


def test_every_study_is_known_here():
    assert {file.stem for file in FOLDER.glob("*.yaml")} == {
        *RUNS_PER_PLANNER,
        "barn",
        "barn_dwa",
        "dynabarn",
        "movingai",
    }


@pytest.mark.parametrize("file", sorted(FOLDER.glob("*.yaml")), ids=lambda file: file.stem)
def test_the_report_that_a_study_names_is_one_of_its_results_by_its_keys(file):
    parser = argparse.ArgumentParser()
    report.configure(parser)
    text = file.read_text()
    for words in re.findall(r"^# +mrpbench report (.*)", text, re.MULTILINE):
        asked = parser.parse_args(words.split())
        assert all(str(folder).startswith("results/") for folder in asked.folders), words
        for name in filter(None, (asked.by or "").split(",")):
            assert re.search(rf"^[^#]*\b{re.escape(name.split('.')[-1])}\b.*:", text, re.MULTILINE), name


def test_the_study_of_the_movingai_benchmark_finds_its_files_beside_it(shared_data, tmp_path):
    for file in ("maps/random-32-32-10.map", *(f"scens/random-32-32-10-random-{n}.scen" for n in range(1, 6))):
        shutil.copy(shared_data / "movingai" / file, tmp_path)
    study = load_study(shutil.copy(FOLDER / "movingai.yaml", tmp_path))
    assert not study.errors
    assert Counter(point.canonical["planner"]["plugin"] for point in study.runs) == dict.fromkeys(
        ("prioritized", "eecbs", "pibt", "lacam", "lns"), 15
    )


def test_the_studies_of_the_barn_challenge_take_their_tables_and_worlds_from_the_command(shared_data):
    files = [
        f"world.{key}={shared_data / 'barn' / name}.csv.gz" for key, name in (("file", "cylinders"), ("path", "paths"))
    ]
    for name, controllers in (("barn", ("graceful", "rpp", "dwb", "mppi")), ("barn_dwa", ("dwb",))):
        study = load_study(FOLDER / f"{name}.yaml", [*files, "world.index=[0, 3]", "seed=0"])
        assert not study.errors
        local = Counter(point.canonical["controller"]["primary_controller"]["plugin"] for point in study.runs)
        assert local == dict.fromkeys(controllers, 2)


def test_the_study_of_the_dynabarn_challenge_takes_its_tables_from_the_command(shared_data):
    tables = {"worlds": "dynabarn_worlds.csv", "keyframes": "dynabarn_keyframes.csv.gz"}
    files = [f"crowds.{key}={shared_data / 'barn' / name}" for key, name in tables.items()]
    study = load_study(FOLDER / "dynabarn.yaml", files)
    assert not study.errors
    assert len(study.runs) == 60 * 4 * 2


@pytest.mark.parametrize("name", RUNS_PER_PLANNER)
def test_a_study_has_its_runs_and_no_mistakes_but_planners_that_are_not_installed(name):
    study = load_study(FOLDER / f"{name}.yaml")
    assert study.name == name
    blocks = [point.canonical["planner"] for point in study.runs]
    found = Counter(
        (block.get("planner", block)["plugin"], block.get("method"), block.get("shield")) for block in blocks
    )
    assert set(found.values()) == {RUNS_PER_PLANNER[name]}
    refused = {word for word in missing_planners() if any(f"called '{word}'" in str(error) for error in study.errors)}
    assert len(study.errors) == len(refused)
    assert len(found) + len(refused) == PLANNERS.get(name, 1)
    assert study.invalid == len(refused) * RUNS_PER_PLANNER[name]


def test_planners_that_assign_are_executed_with_bodies(tmp_path):
    pytest.importorskip("mujoco")
    world = ("world=office", "limits.execution=300s", "seed=3000", "scenario.robots=5")
    chosen = (*world, "planner=cbs_ta")  # by both ways to execute paths
    assert main(["run", str(FOLDER / "paper.yaml"), *chosen, "--out", str(tmp_path)]) == 0
    records = load(tmp_path)
    assert {record["config"]["dispatcher"]["plugin"] for record in records} == {"all_at_once", "adg"}
    for record in records:
        assert record["status"] == "succeeded"
        assert record["metrics"]["execution.mrp_bench.success"] is True


def test_a_study_can_be_listed(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    code = main(["run", str(FOLDER / "league.yaml"), "--dry-run", "planner=[astar, cbs]"])
    runs = RUNS_PER_PLANNER["league"] * 2 * 2  # planners, simulators
    assert f"{runs} of {runs} runs to do" in capsys.readouterr().out
    assert code == 0
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("name", ["table2", "table3"])
def test_the_original_maps_take_the_place_of_the_worlds(name, shared_data):
    maps = shared_data / "rmf" / "mrp_bench"
    worlds = ", ".join(f"{{plugin: rmf, file: {maps / world}.building.yaml}}" for world in ("office", "warehouse"))
    study = load_study(
        FOLDER / f"{name}.yaml",
        ["roadmap.compatible=mrp_bench", "scenario.compatible=mrp_bench", f"world=[{worlds}]", "planner=[astar]"],
    )
    assert not study.errors
    assert len(study.runs) == RUNS_PER_PLANNER[name]
    assert {point.canonical["world"]["plugin"] for point in study.runs} == {"rmf"}
