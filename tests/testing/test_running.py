"""Suites run under pytest and without it."""

import subprocess
import sys

from mrpbench_core.testing import ComponentConformance, Skip, require, run_checks

SUITE = """
import attrs
from mrpbench_core.builtin.assigners.identity import Identity
from mrpbench_core.testing import AssignerConformance, require

class TestMine(AssignerConformance):
    def make(self):
        return Identity()

    def test_something_of_mine(self):
        require(2 < 1, "two is not less than one")
"""


class Outcomes(ComponentConformance):
    """One check of each outcome, after those of all components."""

    def make(self):
        raise OSError("there is none")

    def test_holds(self):
        require(True, "never said")

    def test_fails(self):
        require([], "nothing there")

    def test_does_not_apply(self):
        raise Skip("not today")

    def test_breaks(self):
        raise ZeroDivisionError("by zero")


def test_each_check_has_an_outcome_and_a_reason():
    found = {check.name: (check.outcome, check.reason) for check in run_checks(Outcomes())}
    assert found["holds"] == ("ok", "")
    assert found["fails"] == ("failed", "nothing there")
    assert found["does not apply"] == ("skipped", "not today")
    assert found["breaks"][1].startswith("raises ZeroDivisionError: by zero (")
    assert "test_running.py:" in found["breaks"][1]
    assert found["survives pickling"][0] == "failed"
    assert list(found)[-4:] == ["holds", "fails", "does not apply", "breaks"]


def test_pytest_collects_a_suite(tmp_path):
    (tmp_path / "test_mine.py").write_text(SUITE)
    (tmp_path / "pytest.ini").write_text("[pytest]\n")
    command = [sys.executable, "-m", "pytest", "-q", "-rs", "-p", "no:cacheprovider", "test_mine.py"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=100)
    assert done.returncode == 1, done.stdout
    assert "two is not less than one" in done.stdout
    assert "it does not read costs" in done.stdout
    assert "1 failed" in done.stdout
    assert "4 skipped" in done.stdout


def test_the_kit_needs_neither_pytest_nor_hypothesis():
    code = "import sys, mrpbench_core.testing as t; print(sorted({'pytest', 'hypothesis'} & sys.modules.keys()))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True)
    assert done.stdout.strip() == "[]"
