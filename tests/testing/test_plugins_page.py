"""`docs/how-to/planner.md` tells the truth: its code is saved, checked, run, installed and tested as it says."""

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from mrpbench_core.api import hooks

PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "planner.md"


@pytest.fixture(scope="module")
def blocks():
    """The page's blocks of code by language."""
    found = {}
    for language, code in re.findall(r"^```(\w+)\n(.*?)^```$", PAGE.read_text(), re.MULTILINE | re.DOTALL):
        found.setdefault(language, []).append(code)
    return found


@pytest.fixture
def folder(tmp_path, blocks):
    (tmp_path / "beeline.py").write_text(blocks["python"][0])
    (tmp_path / "beeline.yaml").write_text(blocks["yaml"][0])
    (tmp_path / "pyproject.toml").write_text(blocks["toml"][0])
    return tmp_path


def call(folder, *words):
    environment = {**os.environ, "PYTHONPATH": str(folder), "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run(
        [sys.executable, *words], cwd=folder, env=environment, capture_output=True, text=True, timeout=100
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def mrpbench(folder, *words):
    return call(folder, "-m", "mrpbench_core.cli.main", *words)


def test_the_commands_of_the_page_work(folder, blocks):
    commands = [line.split()[1:] for line in blocks["sh"][0].splitlines()]
    assert [words[0] for words in commands] == ["check", "run"]
    for words in commands:
        mrpbench(folder, *words)
    (shard,) = folder.glob("results/first/runs/*.jsonl")
    record = json.loads(shard.read_text())
    assert record["status"] == "succeeded"
    assert record["config"]["planner"]["plugin"] == "beeline.py:Beeline"


def test_the_distribution_offers_the_planner(folder):
    project = tomllib.loads((folder / "pyproject.toml").read_text())["project"]
    info = folder / f"acme_beeline-{project['version']}.dist-info"
    info.mkdir()
    requires = "".join(f"Requires-Dist: {requirement}\n" for requirement in project["dependencies"])
    (info / "METADATA").write_text(
        f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n{requires}"
    )
    ((group, entries),) = project["entry-points"].items()
    (info / "entry_points.txt").write_text(
        f"[{group}]\n" + "".join(f"{name} = {value}\n" for name, value in entries.items())
    )
    listed = json.loads(mrpbench(folder, "plugins", "planner", "--json"))
    (mine,) = [entry for entry in listed if entry["name"] == "beeline"]
    assert (mine["distribution"], mine["version"], mine["problem"]) == ("acme-beeline", "1.0", None)
    assert ", 0 failed" in mrpbench(folder, "check", "beeline")
    mrpbench(folder, "run", "beeline.yaml", "planner=beeline", "--out", "other")
    (shard,) = folder.glob("other/runs/*.jsonl")
    record = json.loads(shard.read_text())
    (used,) = [entry for entry in record["provenance"]["components"] if entry["kind"] == "planner"]
    assert (used["distribution"], used["version"]) == ("acme-beeline", "1.0")


def test_the_test_of_the_page_passes(folder, blocks):
    (folder / "test_beeline.py").write_text(blocks["python"][1])
    assert "passed" in call(folder, "-m", "pytest", "-q", "-p", "no:cacheprovider", "test_beeline.py")


def test_the_drawn_problem_is_solved(folder, blocks):
    call(folder, "-c", "from beeline import Beeline\n" + blocks["python"][2])


def test_the_hook_exists(blocks, capsys):
    space = {}
    exec(blocks["python"][3], space)
    (name,) = [name for name in space if name.startswith("mrpbench_")]
    assert hasattr(hooks, name)
    space[name](record={"status": "succeeded", "run_id": "0"})
    assert capsys.readouterr().out == "succeeded 0\n"


def test_files_and_classes_that_the_page_names_exist():
    text = PAGE.read_text()
    for path in re.findall(r"`(mrpbench_core/[\w/.]+)`", text):
        assert (PAGE.parents[2] / path).exists(), path
    for module in re.findall(r"`(mrpbench_core\.testing\.\w+)`", text):
        assert (PAGE.parents[2] / (module.replace(".", "/") + ".py")).exists(), module
