"""`mrpbench completion`: a shell completes what the commands declare."""

import shutil
import subprocess

import pytest

from mrpbench_core.cli.main import COMMANDS

ASK = """
source /dev/stdin
COMP_WORDS=("$@") COMP_CWORD=$(($#-1))
_mrpbench
echo "${COMPREPLY[@]}"
"""


@pytest.fixture
def offered(mrpbench):
    """Return a function that gives what bash offers for the last of some words."""
    if shutil.which("bash") is None:
        pytest.skip("no bash")
    code, script, _ = mrpbench("completion")
    assert code == 0

    def ask(*words):
        done = subprocess.run(["bash", "-uc", ASK, "bash", *words], input=script, capture_output=True, text=True)
        assert not done.stderr
        return done.stdout.split()

    return ask


def test_commands_options_and_values_are_offered(offered):
    assert {*COMMANDS, "compare", "view", "publish"} <= {*offered("mrpbench", "")}
    assert offered("mrpbench", "view", "--g") == ["--gif"]
    assert offered("mrpbench", "re") == ["report"]
    assert offered("mrpbench", "run", "--re") == ["--rerun"]
    assert offered("mrpbench", "run", "study.yaml", "--rerun", "") == ["failed", "changed", "all"]
    assert offered("mrpbench", "new-plugin", "planner", "mine", "--na") == ["--native"]


def test_names_of_files_are_left_to_the_shell(offered):
    assert offered("mrpbench", "run", "") == []
    assert offered("mrpbench", "run", "st") == []
    assert offered("mrpbench", "report", "results", "--html", "") == []
