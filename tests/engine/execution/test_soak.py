"""The first executions of the soak, and what the soak would say of a dispatcher that is wrong."""

import runpy
from pathlib import Path

import attrs
import pytest

from mrpbench_core.builtin.dispatchers.all_at_once import AllAtOnce
from mrpbench_core.builtin.dispatchers.timed import Timed, TimedSession

pytest.importorskip("mrpbench_planners_mapf")
SOAK = runpy.run_path(str(Path(__file__).with_name("soak_executions.py")))


def test_all_robots_arrive_in_the_first_executions(capsys):
    assert SOAK["run"](24, 1) == 0
    printed = capsys.readouterr().out
    assert "adg: drained" in printed
    assert "before situation" in printed


def test_robots_that_never_go_and_robots_that_meet_are_noticed(monkeypatch, capsys):
    class Holding(TimedSession):
        def update(self, now, view):
            return attrs.evolve(super().update(now, view), released=view.reached * 0)

    class Held(Timed):
        def start(self, problem, plan):
            return Holding(problem, plan)

    only, names = {"prioritized": SOAK["planners"]()["prioritized"]}, SOAK["run"].__globals__
    monkeypatch.setitem(names, "components", lambda kind: {"held": Held, "careless": AllAtOnce})
    monkeypatch.setitem(names, "planners", lambda: only)
    monkeypatch.setitem(names, "LIMIT", 20.0)
    assert SOAK["run"](40, 3) > 0
    printed = capsys.readouterr().out
    assert "held" in printed
    assert "robots do not arrive" in printed
    assert "robots meet" in printed
