"""No command imports a plugin in its own process: a module that does anything there is that plugin's error, by name."""

import os
import subprocess
import sys

import pytest

MODULES = {
    "ends": "import os; os._exit(3)",
    "crashes": "import ctypes; ctypes.string_at(0)",
}
KINDS = ("worlds", "roadmaps", "planners", "formats", "executors", "metrics")
STUDY = """\
name: tiny
world: {plugin: movingai, file: tiny.map}
roadmap: grid
scenario: {plugin: random, robots: 1}
assigner: identity
planner: prioritized
simulator: kinematic
metrics: [execution]
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory, tiny_map):
    """A folder with a run of a planner and metric that are planted later, and with planted plugins of all kinds."""
    folder = tmp_path_factory.mktemp("planted")
    (folder / "tiny.map").write_text(tiny_map)
    (folder / "study.yaml").write_text(STUDY)
    done = mrpbench(folder, "run", "study.yaml", "--out", "out", site=None)
    assert done.returncode == 0, done.stderr
    for file in (folder / "out" / "runs").iterdir():
        file.write_text(file.read_text().replace("prioritized", "planted").replace('"execution.', '"planted.'))
    for file in (folder / "out" / "invocations").iterdir():
        file.write_text("{}\n")
    for name, code in MODULES.items():
        info = folder / name / "acme_planted-1.0.dist-info"
        info.mkdir(parents=True)
        (folder / name / "acme_planted.py").write_text(code)
        (info / "METADATA").write_text("Metadata-Version: 2.1\nName: acme-planted\nVersion: 1.0\n")
        groups = (f"[mrpbench.{kind}]\nplanted = acme_planted:Planted\n" for kind in KINDS)
        (info / "entry_points.txt").write_text("".join(groups))
    return folder


def mrpbench(folder, *words, site):
    path = {} if site is None else {"PYTHONPATH": str(folder / site)}
    return subprocess.run(
        [sys.executable, "-m", "mrpbench_core.cli.main", *words],
        capture_output=True,
        text=True,
        cwd=folder,
        env=os.environ | path,
        timeout=100,
    )


COMMANDS = {
    "run": "run study.yaml planner=planted --out none",
    "executor": "run study.yaml --executor planted --out none",
    "scenario": "scenario study.yaml roadmap=planted --write a.yaml",
    "world": "world planted",
    "export": "export out --to planted",
    "analyze": "analyze study.yaml --format planted",
}


@pytest.mark.parametrize("words", COMMANDS.values(), ids=COMMANDS)
def test_a_command_that_needs_the_plugin_ends_with_one_line_that_names_it(folder, words):
    done = mrpbench(folder, *words.split(), site="ends")
    assert done.returncode == 2
    assert "acme-planted 1.0" in done.stderr
    assert "ended with exit code 3" in done.stderr
    assert done.stderr.count("\n") == 1


def test_the_line_says_that_the_module_crashed(folder):
    done = mrpbench(folder, "export", "out", "--to", "planted", site="crashes")
    (line,) = done.stderr.splitlines()
    assert done.returncode == 2
    assert "acme-planted 1.0" in line
    assert "SIGSEGV" in line


@pytest.mark.parametrize("words", ["view out --out a.html", "report out --html b.html", "compare out out"])
def test_a_command_that_can_do_without_the_plugin_says_what_lacks(folder, words):
    done = mrpbench(folder, *words.split(), site="ends")
    assert done.returncode in (0, 2) if words.startswith("compare") else done.returncode == 0
    assert all("acme-planted 1.0" in line for line in done.stderr.splitlines() if "planted" in line)
    assert "acme-planted 1.0" in done.stderr


@pytest.mark.parametrize("words", ["plugins", "init new", "new-plugin planner mine"])
def test_a_command_that_only_lists_plugins_imports_none(folder, words):
    done = mrpbench(folder, *words.split(), site="ends")
    assert (done.returncode, done.stderr) == (0, "")
