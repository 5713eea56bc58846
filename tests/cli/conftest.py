"""Runs the command line in this process, and programs in an environment of its own."""

import os
import subprocess
import sys
import sysconfig

import pytest

from mrpbench_core.cli.main import main

MAP = "type octile\nheight 3\nwidth 3\nmap\n...\n...\n...\n"
STUDY = """\
name: tiny
world: {plugin: movingai, file: tiny.map}
roadmap: grid
scenario: {plugin: random, robots: 2}
assigner: identity
planner: example
simulator: none
metrics: []
matrix:
  seed: 0..1
"""


@pytest.fixture(scope="session")
def tiny_map():
    """Return nine free cells as a MovingAI map."""
    return MAP


@pytest.fixture(scope="session")
def tiny_study():
    """Return a study of two robots on it, once for each of two seeds."""
    return STUDY


@pytest.fixture
def mrpbench(tmp_path, monkeypatch, capsys):
    """Return a function that runs a command in a folder with a tiny study and gives exit code, output and errors."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tiny.map").write_text(MAP)
    (tmp_path / "tiny.yaml").write_text(STUDY)

    def invoke(*words):
        try:
            code = main([str(word) for word in words])
        except SystemExit as end:
            code = end.code
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return invoke


@pytest.fixture(scope="module", autouse=True)
def _kept(kept_workers):
    """Studies of a module share their worker processes."""


@pytest.fixture(scope="session")
def environment(tmp_path_factory):
    """Return a function that runs a program of a new virtual environment with pip, which sees all that is installed."""
    folder = tmp_path_factory.mktemp("environment")
    subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    paths = {"base": str(folder), "platbase": str(folder)}
    own = sysconfig.get_path("purelib", scheme="venv", vars=paths)
    here = sysconfig.get_path("purelib")
    (folder / own / "here.pth").write_text(f"import site; site.addsitedir({here!r})\n")
    (folder / "bin/mrpbench").write_text(
        f"#!{folder}/bin/python\nimport sys\nfrom mrpbench_core.cli.main import main\nsys.exit(main())\n"
    )
    (folder / "bin/mrpbench").chmod(0o755)
    path = f"{folder}/bin:{sysconfig.get_path('scripts')}:{os.environ['PATH']}"

    def run(*words, cwd, ok=True, timeout=100):
        done = subprocess.run(
            words,
            cwd=cwd,
            env={**os.environ, "PATH": path, "VIRTUAL_ENV": str(folder)},
            capture_output=True,
            text=True,
            timeout=timeout,
        )
        assert not ok or done.returncode == 0, done.stdout + done.stderr
        return done

    return run
