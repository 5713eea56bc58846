"""Plugins that `mrpbench new-plugin` of the last release wrote work with this one, or a line says what to change.

`tests/data/scaffolded-0.2.0` holds what it wrote of each kind. They are found here as pip would leave them.
"""

import importlib
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from mrpbench_core.cli.check import make
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins import installed
from mrpbench_core.plugins.kinds import GONE, HOOKS, RENAMED, singular
from mrpbench_core.testing import failed_checks, suite_for

WRITTEN = sorted((Path(__file__).parents[1] / "data/scaffolded-0.2.0").iterdir())
KINDS = {folder.name: folder.name.removeprefix("last_").replace("program", "planner") for folder in WRITTEN}
WORKING = [folder for folder in WRITTEN if KINDS[folder.name] not in GONE]
OPTIONS = {
    "last_scenario": ["robots=3"],
    "last_program": [f"binary={WRITTEN[0].parent}/last_program/tests/stand_in.py"],
}
"""Required options."""


def offered(folder):
    """The distribution's name, and its one entry point: group, name and value."""
    project = tomllib.loads((folder / "pyproject.toml").read_text())["project"]
    ((group, names),) = project["entry-points"].items()
    ((name, value),) = names.items()
    return project["name"], group, name, value


def install(folder, site):
    """Copy the package and its metadata; bounds of the core's version, which pip respects, are left out."""
    distribution, group, name, value = offered(folder)
    (package,) = folder.glob("mrpbench_*")
    shutil.copytree(package, site / package.name)
    metadata = site / f"{package.name}-0.1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {distribution}\nVersion: 0.1.0\n")
    (metadata / "entry_points.txt").write_text(f"[{group}]\n{name} = {value}\n")


@pytest.fixture
def found(tmp_path, monkeypatch):
    """Return a function that installs a plugin in this process, and returns its name with the kind."""
    site = tmp_path / "site"
    site.mkdir()
    monkeypatch.syspath_prepend(str(site))

    def make(folder):
        install(folder, site)
        installed.refresh()
        return f"{KINDS[folder.name]}:{folder.name}"

    yield make
    monkeypatch.undo()
    for name in [name for name in sys.modules if "_last_" in name.partition(".")[0]]:
        del sys.modules[name]
    installed.refresh()


@pytest.mark.parametrize("folder", WORKING, ids=lambda folder: folder.name)
def test_a_plugin_of_the_last_release_passes_the_checks_and_its_own_tests(folder, found, monkeypatch, capsys):
    name = found(folder)
    monkeypatch.syspath_prepend(str(folder / "tests"))
    test = importlib.import_module(f"test_{folder.name}")
    (suite,) = (each() for each in vars(test).values() if isinstance(each, type) and each.__module__ == test.__name__)
    assert not failed_checks(suite)
    (provider,) = (each for each in installed.installed() if each.name == folder.name)
    assert provider.problem is None
    kind = singular(provider.group.rpartition(".")[2])
    assert (provider.advice is not None) == (kind in RENAMED)
    if provider.group != HOOKS:
        component = make(name, OPTIONS.get(folder.name, []))
        assert type(component) is type(suite.make())
        assert not failed_checks(suite_for(component))
    capsys.readouterr()


def test_a_plan_filter_is_refused_with_the_option_that_replaces_the_kind(found):
    (folder,) = (folder for folder in WRITTEN if KINDS[folder.name] in GONE)
    with pytest.raises(InputError) as refused:
        make(found(folder), [])
    assert str(refused.value) == (
        "plan_filter 'last_plan_filter' of mrpbench-plan-filters-last-plan-filter 0.1.0 is of a kind that is an option"
        " now: write `plan_filter: mrp_bench_stairs` without a plugin"
    )


def test_a_bounded_planner_whose_factor_is_only_an_option_is_told_what_to_add(found, tmp_path):
    name = found(next(folder for folder in WORKING if folder.name == "last_planner"))
    (module,) = (tmp_path / "site").glob("mrpbench_planners_last_planner/last_planner.py")
    text = module.read_text()
    bounded = text.replace("Promise.CONFLICT_FREE,", "Promise.CONFLICT_FREE, Promise.BOUNDED,")
    assert bounded != text
    module.write_text(bounded)
    failed = failed_checks(suite_for(make(name, [])))
    told = "planner: LastPlanner promises `bounded`, so it must override `suboptimality`"
    assert failed["declares features and promises"] == told


def test_the_commands_know_them(tmp_path):
    site = tmp_path / "site"
    site.mkdir()
    for folder in WRITTEN:
        install(folder, site)
    environment = os.environ | {"PYTHONPATH": str(site), "COLUMNS": "200"}

    def run(*words, cwd=tmp_path):
        command = [sys.executable, "-m", *words]
        return subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True)

    listed = run("mrpbench_core.cli.main", "plugins")
    rows = [line.split(maxsplit=4) for line in listed.stdout.splitlines() if " last_" in line]
    assert {name for _, name, *_ in rows} == set(KINDS)
    assert [name for _, name, _, _, *problem in rows if problem] == ["last_plan_filter"]
    assert listed.stderr.count("which the next release does not read: it is now mrpbench.formats") == 2
    done = run("mrpbench_core.cli.main", "check", "exporter:last_exporter")
    assert done.returncode == 0, done.stdout + done.stderr
    own = run("pytest", "-q", "-p", "no:cacheprovider", str(WRITTEN[0].parent / "last_planner"), cwd=site)
    assert " passed" in own.stdout
