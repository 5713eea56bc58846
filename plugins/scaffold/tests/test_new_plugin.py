"""`mrpbench new-plugin`: what it writes installs, is found, passes its checks, and is gone when uninstalled."""

import importlib
import json
import subprocess
import sys
import tomllib
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest
from mrpbench_scaffold.kinds import kinds

from mrpbench_core.api import KINDS
from mrpbench_core.testing import SUITES, run_checks

ROOT = Path(__file__).parents[3]


@pytest.fixture
def folder(mrpbench, tmp_path):
    """Return a function that writes a new plugin and returns its folder."""

    def write(kind, name, *options):
        code, _, err = mrpbench("new-plugin", kind, name, "--folder", f"new/{name}", *options)
        assert code == 0, err
        return tmp_path / "new" / name

    return write


def test_every_kind_has_a_template():
    assert set(kinds()) == {*KINDS, *SUITES, "critic", "mppi_critic", "hook"}


@pytest.mark.parametrize(("kind", "options"), [*((kind, ()) for kind in kinds()), ("planner", ("--external",))])
def test_a_new_component_passes_the_checks_of_its_kind(kind, options, folder, monkeypatch, capsys):
    name = "_".join(["fresh", kind, *(option.removeprefix("--") for option in options)])
    written = folder(kind, name, *options)
    monkeypatch.syspath_prepend(str(written))
    monkeypatch.syspath_prepend(str(written / "tests"))
    project = tomllib.loads((written / "pyproject.toml").read_text())["project"]
    ((group, entries),) = project["entry-points"].items()
    offered = EntryPoint(name, entries[name], group).load()
    test = importlib.import_module(f"test_{name}")
    suite = next(each for each in vars(test).values() if isinstance(each, type) and each.__module__ == test.__name__)()
    assert suite.make() is offered or isinstance(suite.make(), offered)
    outcomes = list(run_checks(suite))
    assert not [check for check in outcomes if check.outcome == "failed"]
    assert sum(check.outcome == "ok" for check in outcomes) > len(outcomes) / 2
    capsys.readouterr()


def test_what_is_written_passes_linter_and_types(folder):
    folders = [folder(kind, f"neat-{kind}") for kind in kinds()] + [folder("planner", "neat_runs", "--external")]
    texts = [path.read_text() for written in folders for path in written.rglob("*") if path.is_file()]
    assert not [text for text in texts if "$" in text]
    packages = [str(package) for written in folders for package in written.glob("mrpbench_*")]
    tests = [str(test) for written in folders for test in written.glob("tests/*.py")]
    assert len(packages) == len(folders) <= len(tests)
    config = ["--config", str(ROOT / "pyproject.toml"), "--config", 'src = ["*"]', "--no-cache"]  # each is first party
    mypy = ["mypy", "--strict", "--cache-dir", str(ROOT / ".mypy_cache/new_plugins")]
    for tool in (
        ["ruff", "check", *config, *packages],
        ["ruff", "check", "--select", "I", *config, "."],
        ["ruff", "format", "--check", *config, "."],
        [*mypy, *packages, *tests],
    ):
        done = subprocess.run([sys.executable, "-m", *tool], cwd=folders[0].parent, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout


def test_a_new_distribution_is_found_checked_tested_and_gone_when_uninstalled(folder, environment, tmp_path):
    written = folder("metric", "acme")
    environment("pip", "install", "--quiet", "--no-deps", "--no-build-isolation", written, cwd=tmp_path)
    listed = json.loads(environment("mrpbench", "plugins", "metric", "--json", cwd=tmp_path).stdout)
    (mine,) = [entry for entry in listed if entry["name"] == "acme"]
    assert (mine["distribution"], mine["version"], mine["problem"]) == ("mrpbench-metrics-acme", "0.1.0", None)
    assert " 0 failed" in environment("mrpbench", "check", "metric:acme", cwd=tmp_path).stdout
    assert " passed" in environment("python", "-m", "pytest", "-q", "-p", "no:cacheprovider", cwd=written).stdout
    environment("pip", "uninstall", "--quiet", "--yes", "mrpbench-metrics-acme", cwd=tmp_path)
    assert environment("mrpbench", "check", "metric:acme", cwd=tmp_path, ok=False).returncode == 2


def test_what_to_do_next_is_printed(mrpbench):
    code, out, _ = mrpbench("new-plugin", "task_source", "acme-first")
    assert code == 0
    assert out.splitlines() == [
        "wrote mrpbench-task-sources-acme-first: a working task source. Next:",
        "  cd mrpbench-task-sources-acme-first",
        "  pip install -e .",
        "  mrpbench check task_source:acme_first",
    ]


def test_nothing_is_overwritten(mrpbench, tmp_path):
    (tmp_path / "mrpbench-planners-mine").mkdir()
    code, _, err = mrpbench("new-plugin", "planner", "mine")
    assert code == 2
    assert err == "mrpbench-planners-mine: exists already and is not overwritten\n"
    assert not list((tmp_path / "mrpbench-planners-mine").iterdir())


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["planer", "mine"], "there is no template for a 'planer' (did you mean 'planner'?)"),
        (["qqq", "mine"], "there is no template for a 'qqq' (there are planner, assigner, "),
        (["planner", "Mine"], "'Mine' is not a name"),
        (["planner", "3d"], "'3d' is not a name"),
        (["planner", "../mine"], "'../mine' is not a name"),
        (["planner", "class"], "'class' is a keyword of Python"),
        (["planner", "robot_path"], "the template already uses the name RobotPath"),
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
