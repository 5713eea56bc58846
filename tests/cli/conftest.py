"""Runs the command line in this process."""

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
