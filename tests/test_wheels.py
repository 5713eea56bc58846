"""Wheels contain all files that users need."""

import subprocess
import tomllib
import zipfile
from pathlib import Path

import pytest
from hatchling.build import build_wheel

ROOT = Path(__file__).parent.parent
PURE = [ROOT, *sorted(file.parent for file in ROOT.glob("plugins/*/*/pyproject.toml"))]


@pytest.mark.parametrize("folder", PURE, ids=lambda folder: folder.name if folder != ROOT else "core")
def test_a_wheel_holds_everything_that_git_does(folder, tmp_path, monkeypatch):
    monkeypatch.chdir(folder)  # where a build backend is called (PEP 517)
    wheel = build_wheel(str(tmp_path))
    packed = set(zipfile.ZipFile(tmp_path / wheel).namelist())
    project = tomllib.loads((folder / "pyproject.toml").read_text())
    (package,) = project["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]
    listed = subprocess.run(["git", "ls-files", package], cwd=folder, check=True, capture_output=True, text=True)
    assert set(listed.stdout.split()) <= packed
    for group in project["project"].get("entry-points", {}).values():
        for target in group.values():
            module = target.partition(":")[0].replace(".", "/")
            assert {f"{module}.py", f"{module}/__init__.py"} & packed


def test_every_distribution_is_a_member_of_the_workspace_and_installed_by_pip_too():
    members = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["uv"]["workspace"]["members"]
    folders = {str(file.parent.relative_to(ROOT)) for file in ROOT.glob("plugins/*/*/pyproject.toml")} | {"native"}
    assert set(members) == folders
    lines = (ROOT / "requirements.txt").read_text().splitlines()
    assert {line.removeprefix("-e ./") for line in lines if line.startswith("-e ./")} == folders
