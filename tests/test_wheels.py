"""Wheels contain all files that users need."""

import subprocess
import tarfile
import tomllib
import zipfile
from pathlib import Path

import pytest
from hatchling.build import build_sdist, build_wheel

pytestmark = pytest.mark.filterwarnings("ignore:.*is shallow:UserWarning")  # versions come from tags

ROOT = Path(__file__).parent.parent
PURE = [ROOT, *sorted(file.parent for file in ROOT.glob("plugins/**/pyproject.toml"))]


@pytest.mark.parametrize("folder", PURE, ids=lambda folder: folder.name if folder != ROOT else "core")
def test_a_wheel_holds_everything_that_git_does(folder, tmp_path, monkeypatch):
    monkeypatch.chdir(folder)  # where a build backend is called (PEP 517)
    wheel = build_wheel(str(tmp_path))
    packed = set(zipfile.ZipFile(tmp_path / wheel).namelist())
    project = tomllib.loads((folder / "pyproject.toml").read_text())
    for package in map(Path, project["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]):
        listed = subprocess.run(
            ["git", "ls-files", package.name], cwd=folder / package.parent, check=True, capture_output=True, text=True
        )
        assert set(listed.stdout.split()) <= packed
    for group in project["project"].get("entry-points", {}).values():
        for target in group.values():
            module = target.partition(":")[0].replace(".", "/")
            assert {f"{module}.py", f"{module}/__init__.py"} & packed


def test_every_distribution_is_a_member_of_the_workspace_and_installed_by_pip_too():
    members = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["uv"]["workspace"]["members"]
    folders = {str(folder.relative_to(ROOT)) for folder in PURE[1:]} | {"native"}
    assert set(members) == folders
    lines = (ROOT / "requirements.txt").read_text().splitlines()
    installed = (line.removeprefix("-e ./") for line in lines if line.startswith("-e ./"))
    assert {place.partition("[")[0] for place in installed} == folders


def test_every_package_is_in_one_distribution(tmp_path, monkeypatch):
    monkeypatch.chdir(ROOT / "plugins")
    with tarfile.open(tmp_path / build_sdist(str(tmp_path))) as archive:
        packed = {Path(name).parts[-2] for name in archive.getnames() if name.endswith("/py.typed")}
    owners = [packages(file) for file in ROOT.glob("plugins/**/pyproject.toml")]
    assert sorted(name for names in owners for name in names) == sorted(
        file.parent.name for file in ROOT.glob("plugins/**/py.typed")
    )
    assert packed == packages(ROOT / "plugins/pyproject.toml")


def packages(file):
    listed = tomllib.loads(file.read_text())["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]
    return {Path(name).name for name in listed}
