"""The folders in `examples` are plugins as others write them: they build, install and pass their checks."""

import tomllib
import zipfile
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest
from hatchling.build import build_wheel

from mrpbench_core.testing import run_checks, suite_for

FOLDERS = sorted((Path(__file__).parents[1] / "examples").iterdir())


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_an_example_builds_and_passes_the_checks_of_its_kind(folder, tmp_path, monkeypatch):
    monkeypatch.chdir(folder)
    with zipfile.ZipFile(tmp_path / build_wheel(str(tmp_path))) as wheel:
        wheel.extractall(tmp_path / "site")
    monkeypatch.syspath_prepend(str(tmp_path / "site"))
    project = tomllib.loads((folder / "pyproject.toml").read_text())["project"]
    ((group, entries),) = project["entry-points"].items()
    for name, target in entries.items():
        outcomes = list(run_checks(suite_for(EntryPoint(name, target, group).load()())))
        assert not [check for check in outcomes if check.outcome == "failed"]
