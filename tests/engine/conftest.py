"""A small study whose planners misbehave in every way that a planner can."""

import os
import shutil
import subprocess
import sys

import pytest

PLANNERS = '''
"""Planners that misbehave when asked to; otherwise they give up."""

import ctypes
import os
import subprocess
import sys
import time
from pathlib import Path

import attrs

from mrpbench_core.api import Planner, option
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus

GAVE_UP = PlanResult(status=PlanStatus.UNSOLVABLE)


@attrs.frozen(kw_only=True)
class Odd(Planner):
    """Does `does`, and then finds no plan."""

    does: str = option("nothing", help="what to do")
    marks: str = option("", help="folder for marks")

    def plan(self, problem, budget):
        getattr(self, "_" + self.does)()
        return GAVE_UP

    def _nothing(self):
        pass

    def _slow(self):
        time.sleep(0.15)

    def _hang(self):
        while True:
            time.sleep(1)

    def _hang_with_gil(self):
        number = 3 ** 3_000_000
        while True:
            number * number

    def _hang_with_helper(self):
        helper = subprocess.Popen(["sleep", "1000"])
        Path(self.marks, f"{os.getpid()}.{helper.pid}").touch()
        self._hang()

    def _leave_helper(self):
        helper = subprocess.Popen(["sleep", "1000"])
        Path(self.marks, f"{os.getpid()}.{helper.pid}").touch()

    def _exit(self):
        os._exit(7)

    def _kill_oneself(self):
        os.kill(os.getpid(), 9)

    def _system_exit(self):
        sys.exit("farewell")

    def _close_everything(self):
        os.closerange(3, 256)
        self._hang()

    def _segfault(self):
        ctypes.string_at(0)

    def _eat(self):
        kept = []
        while True:
            kept.append(b"x" * 50_000_000)

    def _eat_at_once(self):
        bytearray(1 << 46)

    def _raise(self):
        raise ValueError("no\\nway")

    def _print(self):
        print("from Python")
        os.write(1, b"from a descriptor\\n")
        ctypes.CDLL(None).puts(b"from C")
        subprocess.run(["echo", "from a program"], check=True)
'''

WORLD = "type octile\nheight 4\nwidth 4\nmap\n....\n....\n....\n....\n"


@pytest.fixture
def study(tmp_path, monkeypatch):
    """The least configuration, as a dict; its planner is `odd.py:Odd`. Its folder is the working directory."""
    (tmp_path / "odd.py").write_text(PLANNERS)
    (tmp_path / "small.map").write_text(WORLD)
    (tmp_path / "marks").mkdir()
    monkeypatch.chdir(tmp_path)
    return {
        "name": "odd",
        "world": {"plugin": "movingai", "file": "small.map"},
        "roadmap": "grid",
        "scenario": {"plugin": "random", "robots": 2},
        "assigner": "identity",
        "planner": {"plugin": "./odd.py:Odd", "marks": str(tmp_path / "marks")},
        "simulator": "none",
        "metrics": [],
        "limits": {"planning": 1.0, "wall": 30.0},
    }


@pytest.fixture
def command(tmp_path):
    """Return a function that runs `mrpbench` in a process of its own; distributions in `site/` count as installed."""

    def run(*words, **options):
        return subprocess.run(
            [sys.executable, "-m", "mrpbench_core.cli.main", *map(str, words)],
            capture_output=True,
            text=True,
            timeout=60,
            env=os.environ | {"PYTHONPATH": str(tmp_path / "site")},
            **options,
        )

    return run


@pytest.fixture
def publish(tmp_path):
    """Return a function that installs a distribution for `command`, as pip would leave it."""
    site = tmp_path / "site"
    site.mkdir()

    def make(name, entry_points, code, version="1.0"):
        module = name.replace("-", "_")
        (site / f"{module}.py").write_text(code)
        for old in site.glob(f"{module}-*.dist-info"):
            shutil.rmtree(old)
        folder = site / f"{module}-{version}.dist-info"
        folder.mkdir()
        (folder / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n")
        (folder / "entry_points.txt").write_text(entry_points)

    return make
