"""Properties of every command."""

import subprocess
import sys
from pathlib import Path

import pytest

from mrpbench_core.cli import info, main
from mrpbench_core.plugins.installed import providers
from mrpbench_core.plugins.kinds import COMMANDS

LIGHT = "import sys; from mrpbench_core.cli.main import main; main({words!r}); sys.exit('numpy' in sys.modules)"


@pytest.mark.parametrize("words", [["plugins"], ["plugins", "--json"], ["init"]])
def test_light_commands_import_neither_plugins_nor_numpy(tmp_path, words):
    command = [sys.executable, "-c", LIGHT.format(words=words)]
    assert subprocess.run(command, cwd=tmp_path, stdout=subprocess.DEVNULL).returncode == 0


def test_the_package_is_light():
    code = "import sys, mrpbench_core; sys.exit(any(name in sys.modules for name in ('numpy', 'attrs', 'yaml')))"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


@pytest.mark.parametrize("command", [*main.COMMANDS, *(provider.name for provider in providers(COMMANDS))])
def test_every_listed_command_has_help(mrpbench, command):
    code, output, errors = mrpbench(command, "--help")
    assert (code, errors) == (0, "")
    assert f"usage: mrpbench {command}" in output


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (["rum"], "no command is called 'rum' (did you mean 'run'?)"),
        (["run"], "mrpbench run: the following arguments are required"),
        (["run", "tiny.yaml", "--wrokers", "2"], "unrecognized arguments: --wrokers 2"),
        (["run", "seed=0"], "no configuration file is given"),
        (["run", "none.yaml"], "none.yaml: no such file"),
        (["run", "tiny.yaml", "planner.ordr=given"], "unknown option of 'example' (did you mean 'order'?)"),
        (["run", "tiny.yaml", "--workers", "0"], "workers: at least 1"),
        (["run", "tiny.yaml", "--executor-option", "x"], "--executor-option x: expected KEY=VALUE"),
        (["run", "tiny.yaml", "scenario.robots=99"], "99 robots"),
        (["report", "nowhere"], "nowhere: is not a results folder"),
        (["export", "nowhere:ab", "--to", "rosbag2"], "nowhere: is not a results folder"),
        (["plugins", "show", "exmple"], "no plugin is called 'exmple' (did you mean 'example'?)"),
        (
            ["plugins", "show", "teleport"],
            "no plugin is called 'teleport' (`mrpbench plugins` lists what is installed)",
        ),
        (["plugins", "wheel"], "no plugin has the kind 'wheel'"),
        (["init", "a/b"], "'a/b' is not a name"),
    ],
)
def test_a_mistake_is_one_line_and_exit_code_2(mrpbench, words, what):
    code, _, errors = mrpbench(*words)
    assert code == 2
    assert errors.count("\n") == 1
    assert what in errors
    assert "Traceback" not in errors


@pytest.mark.parametrize("command", ["report", "view", "analyze", "verify", "calibrate", "run"])
@pytest.mark.parametrize("name", ["loop", "x" * 5000], ids=["loop", "long"])
def test_a_path_that_cannot_be_followed_is_one_line_and_exit_code_2(mrpbench, monkeypatch, tmp_path, command, name):
    monkeypatch.chdir(tmp_path)
    Path("loop").symlink_to("loop")
    code, _, errors = mrpbench(command, name)
    assert (code, errors.count("\n")) == (2, 1)
    assert "internal error" not in errors


def test_a_defect_is_one_line_and_says_where_the_rest_is(mrpbench, monkeypatch, tmp_path):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)

    def fail(_):
        raise ZeroDivisionError("oops")

    monkeypatch.setattr(info, "run", fail)
    code, _, errors = mrpbench("info")
    (log,) = tmp_path.glob("mrpbench-*.txt")
    assert code == 1
    assert errors == f"mrpbench: internal error: ZeroDivisionError: oops (details in {log}; please report it)\n"
    assert "Traceback" in log.read_text()
    monkeypatch.setenv("MRPBENCH_TRACEBACK", "1")
    assert "Traceback" in mrpbench("info")[2]


def test_a_closed_pipe_is_not_an_error(tmp_path):
    command = f"{sys.executable} -m mrpbench_core.cli.main schema | head -1; echo ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("{\n0\n", "")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_output_that_finds_no_space_is_told_in_one_line():
    with Path("/dev/full").open("w") as full:
        command = [sys.executable, "-m", "mrpbench_core.cli.main", "plugins"]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True)
    assert (done.returncode, done.stderr) == (2, "cannot write: No space left on device\n")
