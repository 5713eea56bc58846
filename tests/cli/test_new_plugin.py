"""`mrpbench new-plugin`: what it writes installs, is found, passes its checks, and is gone when uninstalled."""

import contextlib
import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from hatchling.build import build_wheel

from mrpbench_core.cli.new_plugin import kinds

OPTIONS = {"scenario": ["robots=2"]}


def install(folder: Path, site: Path) -> None:
    """Put a built wheel on the path: what pip does, which an environment made by uv lacks."""
    with contextlib.chdir(folder):  # where a build backend is called (PEP 517)
        wheel = build_wheel(str(site.parent))
    zipfile.ZipFile(site.parent / wheel).extractall(site)


@pytest.fixture
def command(tmp_path):
    """Return a function that runs `mrpbench` in a process of its own, which sees what is installed in `site`."""

    def run(*words):
        environment = {**os.environ, "PYTHONPATH": str(tmp_path / "site"), "PYTHONDONTWRITEBYTECODE": "1"}
        return subprocess.run(
            [sys.executable, "-m", "mrpbench_core.cli.main", *words],
            cwd=tmp_path,
            env=environment,
            capture_output=True,
            text=True,
            timeout=100,
        )

    return run


@pytest.mark.parametrize("kind", kinds())
def test_a_new_plugin_works(kind, mrpbench, command, tmp_path):
    code, out, _ = mrpbench("new-plugin", kind, "acme-first")
    assert code == 0
    folder = tmp_path / f"mrpbench-{kind}s-acme-first"
    assert f"wrote {folder.name}" in out
    install(folder, tmp_path / "site")

    listed = json.loads(command("plugins", kind, "--json").stdout)
    (mine,) = [entry for entry in listed if entry["name"] == "acme_first"]
    assert mine["distribution"] == f"mrpbench-{kind}s-acme-first"
    assert mine["version"] == "0.1.0"
    assert mine["problem"] is None

    checked = command("check", f"{kind}:acme_first", *OPTIONS.get(kind, []))
    assert checked.returncode == 0, checked.stdout + checked.stderr
    assert " 0 failed" in checked.stdout


def test_an_uninstalled_plugin_is_gone(mrpbench, command, tmp_path):
    mrpbench("new-plugin", "metric", "acme-first")
    install(tmp_path / "mrpbench-metrics-acme-first", tmp_path / "site")
    assert "acme_first" in command("plugins", "metric").stdout
    shutil.rmtree(tmp_path / "site")
    assert "acme_first" not in command("plugins", "metric").stdout
    assert command("check", "metric:acme_first").returncode == 2


@pytest.mark.parametrize("kind", kinds())
def test_written_plugins_pass_the_linter(kind, mrpbench, tmp_path):
    mrpbench("new-plugin", kind, "neat", "--folder", "here/neat")
    folder = tmp_path / "here/neat"
    package = f"mrpbench_{kind}s_neat"
    assert {path.name for path in folder.iterdir()} == {".gitignore", "README.md", "pyproject.toml", package, "tests"}
    texts = [path.read_text() for path in folder.rglob("*") if path.is_file()]
    assert not [text for text in texts if "$" in text]
    root = Path(__file__).parents[2]
    ruff = [sys.executable, "-m", "ruff"]
    config = ["--config", str(root / "pyproject.toml"), "--no-cache"]
    checked = subprocess.run([*ruff, "check", *config, package], cwd=folder, capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout
    ordered = subprocess.run(
        [*ruff, "check", "--select", "I", *config, "."], cwd=folder, capture_output=True, text=True
    )
    assert ordered.returncode == 0, ordered.stdout
    formatted = subprocess.run([*ruff, "format", "--check", *config, "."], cwd=folder, capture_output=True, text=True)
    assert formatted.returncode == 0, formatted.stdout


def test_its_test_passes_in_pytest(mrpbench, tmp_path):
    mrpbench("new-plugin", "metric", "mine")
    folder = tmp_path / "mrpbench-metrics-mine"
    words = ["-m", "pytest", "-q", "-p", "no:cacheprovider"]
    environment = {**os.environ, "PYTHONPATH": str(folder)}
    done = subprocess.run([sys.executable, *words], cwd=folder, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    assert "passed" in done.stdout


def test_the_most_asked_kinds_have_templates():
    assert {"planner", "assigner", "controller", "metric", "dispatcher", "simulator", "scenario"} <= set(kinds())


def test_nothing_is_overwritten(mrpbench, tmp_path):
    (tmp_path / "mrpbench-planners-mine").mkdir()
    code, _, err = mrpbench("new-plugin", "planner", "mine")
    assert code == 2
    assert err == "mrpbench-planners-mine: exists already and is not overwritten\n"
    assert not list((tmp_path / "mrpbench-planners-mine").iterdir())


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["planer", "mine"], "there is no template for a 'planer' (there are assigner, "),
        (["planner", "Mine"], "'Mine' is not a name"),
        (["planner", "3d"], "'3d' is not a name"),
        (["planner", "../mine"], "'../mine' is not a name"),
        (["planner", "class"], "'class' is a keyword of Python"),
        (["planner", "path"], "the template already uses the name Path"),
        (["dispatcher", "adg"], "dispatcher 'adg' is installed already, by mrpbench-core"),
        (["planner"], "NAME"),
    ],
)
def test_mistakes_are_one_line(mrpbench, tmp_path, words, line):
    code, _, err = mrpbench("new-plugin", *words)
    assert code == 2
    assert line in err
    assert err.count("\n") == 1
    assert not list(tmp_path.glob("mrpbench-*"))
